#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>
#include <particles/sph/sph.h>
#include <particles/sph_mixture/sph_mixture.h>
#include <reference_fem/enthalpy/enthalpy.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/** Walls whose temperatures swing as often as runs have steps, or more often. */
namespace meltfront::verification::tests
{
  namespace
  {
    using cases::BoundaryKind;
    using cases::Side;
    using namespace test_support;

    /** A slab of solid whose lower wall swings between frost and heat. */
    cases::Scene slab_beside(BoundaryKind kind, double periods)
    {
      constexpr double end = 0.2;
      cases::Scene scene = slab(unit_material(), 1, -0.1, 0, end);
      cases::Boundary wall = varying_wall(
          [=](double t)
          { return 0.25 - 0.75 * std::cos(2 * std::numbers::pi * periods * t / end); });
      wall.kind = kind;
      wall.heat_transfer_coefficient = 20;
      set_boundary(scene, Side::x_min, wall);
      return scene;
    }

    double molten(const cases::Method &method, const cases::Scene &scene, int n)
    {
      return 1 - course_of(method, scene, n).solid.back();
    }

    TEST(SwingingWalls, AreNotTakenForConstantOnes)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::fixed_temperature, BoundaryKind::heat_transfer})
        for(const double periods : {25., 100.})
        {
          const cases::Scene scene = slab_beside(kind, periods);
          // Its nodes are as fine as its layers are thin.
          const double tracked = molten(*particles::make_rkpm_tracked(), scene, 40);
          // The wall at its coldest, which equal steps may see alone, melts nothing, at
          // its mean or its hottest a third more.
          EXPECT_GT(tracked, 0.1);
          for(const auto &method : {reference_fem::make_fem_enthalpy(),
                                    particles::make_sph(), particles::make_sph_mixture()})
            EXPECT_NEAR(molten(*method, scene, 160) / tracked, 1, 0.06)
                << method->name() << " " << periods << " " << int(kind);
        }
    }
  } // namespace
} // namespace meltfront::verification::tests
