#include <cases/error.h>
#include <reference_fem/cut/tests/cut_support.h>
#include <reference_fem/enthalpy/enthalpy.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    Material material_between_walls()
    {
      Material material = normalised_material();
      material.melting_temperature = 0;
      material.latent_heat = 1.4;
      material.solid.conductivity = 2;
      material.solid.specific_heat_capacity = 0.7;
      material.liquid.specific_heat_capacity = 1.3;
      return material;
    }

    /** Solid and liquid side by side in a box, at the melting temperature where they
     * meet.
     */
    Scene two_phases(double end)
    {
      Scene scene = box(material_between_walls(), 2, {0, 0, 0}, {1, 1.2, 0}, 0, end);
      scene.initial.temperature = {"oblique",
                                   [](const Position &p, double)
                                   {
                                     const double value = p[0] + 0.1 * p[1] - 0.5;
                                     return value < 0 ? 0.3 * value : 0.5 * value;
                                   },
                                   false};
      return scene;
    }

    void hold_wall(Scene &scene, Side side, double temperature)
    {
      set_boundary(scene, side,
                   {.kind = BoundaryKind::fixed_temperature,
                    .value = Field::uniform(temperature)});
    }

    void exchange(Scene &scene, Side side, double coefficient, double ambient)
    {
      set_boundary(scene, side,
                   {.kind = BoundaryKind::heat_transfer,
                    .value = Field::uniform(ambient),
                    .heat_transfer_coefficient = coefficient});
    }

    /** Held against the enthalpy method on cells of a third of the size. */
    void expect_agreement(const Scene &scene, int n, double share_of_domain)
    {
      const Course sharp = run_cut(scene, n, {{"scheme", "conservative"}});
      const Course enthalpy = course_of(*make_fem_enthalpy(), scene, 3 * n);
      EXPECT_LE(sharp.worst_budget_defect(), 1e-11);
      EXPECT_NEAR(sharp.solid.back(), enthalpy.solid.back(), share_of_domain * 1.2)
          << "n = " << n;
      EXPECT_GT(std::abs(enthalpy.solid.back() - enthalpy.solid.front()), 0.02 * 1.2);
    }

    // A rim's polygon, which has the domain's area, is longer than the rim.
    TEST(Walls, RimsGiveWhatTheyAreGiven)
    {
      Scene scene = ball(material_between_walls(), 2, 0.5, 0, 0.02);
      scene.domain.shape = DomainShape::shell;
      scene.domain.inner_radius = 0.2;
      scene.initial.temperature = {
          "ring", [](const Position &p, double) { return 0.35 - std::hypot(p[0], p[1]); },
          false};
      set_boundary(scene, Side::inner,
                   {.kind = BoundaryKind::flux, .value = Field::uniform(1.5)});
      set_boundary(scene, Side::outer,
                   {.kind = BoundaryKind::flux, .value = Field::uniform(-0.7)});
      const double given = 2 * std::numbers::pi * (0.2 * 1.5 - 0.5 * 0.7) * 0.02;
      for(const int n : {16, 24})
        EXPECT_NEAR(run_cut(scene, n, {{"scheme", "conservative"}}).heat.boundary, given,
                    1e-12);
    }

    TEST(Walls, AHeldWallThatBothPhasesLieAtJumps)
    {
      Scene scene = two_phases(0.05);
      hold_wall(scene, Side::y_min, -1);
      for(const int n : {20, 30})
        expect_agreement(scene, n, 2e-3);
    }

    TEST(Walls, ALayerRunsFromAFrontAlongAWallThatExchangesHeat)
    {
      Scene scene = two_phases(0.1);
      exchange(scene, Side::y_min, 9.5, 0.75);
      for(const int n : {20, 30})
        expect_agreement(scene, n, 2e-3);
    }

    TEST(Walls, ALayerOnOneWallMakesNoFrontOnAnother)
    {
      Scene scene = box(material_between_walls(), 2, {0, 0, 0}, {1, 1.2, 0}, 0.25, 0.1);
      hold_wall(scene, Side::x_min, -1);
      exchange(scene, Side::y_min, 6, -1.3);
      for(const int n : {24, 32})
        expect_agreement(scene, n, 2e-3);
    }

    // The layer of a jump is thinner than a cell at first: made in short steps of second
    // order temperatures passed the wall's by a fifth of it, and such runs failed.
    TEST(Walls, AHeldRimThatJumpsBesideLiquidIsFollowed)
    {
      Material material = normalised_material();
      material.melting_temperature = 0;
      material.latent_heat = 1.5;
      material.liquid.conductivity = 0.6;
      material.liquid.specific_heat_capacity = 1.3;
      Scene scene = ball(material, 2, 1, 0, 0.2);
      scene.initial.temperature
          = {"about a disk of solid",
             [](const Position &p, double)
             { return 0.4 * std::max(std::hypot(p[0], p[1]) - 0.5, 0.); },
             false};
      scene.initial.front = {
          "disk", [](const Position &p, double) { return std::hypot(p[0], p[1]) - 0.5; },
          false};
      Boundary rim
          = varying_wall([](double t) { return t < 0.07   ? 0.6
                                               : t < 0.13 ? 1.2
                                                          : 0.5; });
      rim.value.breakpoints = {0.07, 0.13};
      set_boundary(scene, Side::outer, rim);
      constexpr double by_fitted_elements = 0.51645028; // n = 16 and 32 agree in it
      for(const int n : {16, 24, 32})
      {
        const Course course = run_cut(scene, n, {{"scheme", "conservative"}});
        EXPECT_NEAR(course.solid.back(), by_fitted_elements, 0.5 / (n * n)) << n;
        EXPECT_LE(course.worst_budget_defect(), 1e-11) << n;
      }
    }

    // A front sets out from a corner in which a cold and a warm wall meet. What lies at a
    // wall beside the front's foot was held at the wall's temperature, also where that is
    // the other phase's; what was handed over had a foot warmer than all walls.
    TEST(Walls, AFrontSetsOutFromACornerOfAColdAndAWarmWall)
    {
      Scene scene = box(material_between_walls(), 2, {0, 0, 0}, {1, 1.2, 0}, 0.2, 0.1);
      hold_wall(scene, Side::x_min, -1);
      hold_wall(scene, Side::y_min, 0.7);
      for(const int n : {16, 24, 32})
        expect_agreement(scene, n, 4e-3);
    }

    // Two disks of liquid, and a wall that melts a layer up to a cold wall. What the
    // layer's foot beside the corner was handed over was shown 0.2 of the span above all
    // walls.
    TEST(Walls, AWallThatMeltsUpToAColdCornerKeepsToItsBounds)
    {
      Material material = normalised_material();
      material.melting_temperature = 0;
      material.latent_heat = 0.3035;
      material.liquid.specific_heat_capacity = 1.288;
      Scene scene = box(material, 2, {0, 0, 0}, {1, 1, 0}, 0, 0.01586);
      const auto level = [](const Position &p)
      {
        return std::min(std::hypot(p[0] - 0.2255, p[1] - 0.4285) - 0.1222,
                        std::hypot(p[0] - 0.7619, p[1] - 0.4045) - 0.1383);
      };
      scene.initial.temperature
          = {"two disks", [=](const Position &p, double) { return -1.91 * level(p); },
             false};
      scene.initial.front
          = {"disks", [=](const Position &p, double) { return -level(p); }, false};
      constexpr double warm = 0.924, cold = -0.94;
      hold_wall(scene, Side::x_min, -0.483);
      hold_wall(scene, Side::x_max, warm);
      hold_wall(scene, Side::y_max, -0.244);
      set_boundary(scene, Side::y_min,
                   {.kind = BoundaryKind::fixed_temperature,
                    .value = {"wave",
                              [](const Position &p, double)
                              { return -0.64 + 0.3 * std::cos(3.1416 * p[0]); },
                              false}});
      constexpr double by_enthalpy = 0.8303; // n = 80, 160: 0.8312, 0.8306
      for(const int n : {16, 20})
      {
        const Course course = run_cut(scene, n, {{"scheme", "conservative"}});
        const double allowed = 0.04 * std::pow(20. / n, 1.5) * (warm - cold);
        EXPECT_LE(*std::ranges::max_element(course.highest), warm + allowed) << n;
        EXPECT_GE(*std::ranges::min_element(course.lowest), -1.2 - allowed) << n;
        EXPECT_NEAR(course.solid.back(), by_enthalpy, 5e-3) << n;
        EXPECT_LE(course.worst_budget_defect(), 1e-11) << n;
      }
    }

    // The foot of the front runs along a wall by half of it in a 25th of the steps. Held
    // at the melting temperature wherever a front ended at a wall, the liquid behind it
    // was colder than that, and the run ended by its bounds.
    TEST(Walls, AFootThatRunsAlongAHeldWallIsFollowed)
    {
      Material material = material_between_walls();
      material.latent_heat = 1.3;
      Scene scene = box(material, 2, {0, 0, 0}, {1, 1, 0}, 0, 0.01);
      scene.initial.temperature = {
          "across", [](const Position &p, double) { return 0.5 * (p[0] - 0.3); }, false};
      Boundary wall{.kind = BoundaryKind::fixed_temperature,
                    .value = {"runs",
                              [](const Position &p, double t) {
                                return 0.5 * (p[0] - 0.3 - 0.5 * std::min(t / 0.004, 1.));
                              },
                              false}};
      wall.value.breakpoints = {0.004};
      set_boundary(scene, Side::y_min, wall);
      const Course sharp = run_cut(scene, 40, {{"scheme", "conservative"}});
      const Course enthalpy = course_of(*make_fem_enthalpy(), scene, 120);
      EXPECT_NEAR(sharp.solid.back(), enthalpy.solid.back(), 2e-3);
      EXPECT_LE(sharp.worst_budget_defect(), 1e-11);
    }

    // The outer wall freezes, then melts a layer a sixth of a cell thick: it used to go
    // on in steps of a ten-thousandth of the run.
    TEST(Walls, ALayerThatGetsNowhereIsRefused)
    {
      Material material = normalised_material();
      material.melting_temperature = 0;
      material.latent_heat = 1.2;
      material.solid.conductivity = 1.6;
      material.solid.specific_heat_capacity = 0.7;
      material.liquid.conductivity = 0.9;
      material.liquid.specific_heat_capacity = 1.2;
      Scene scene = ball(material, 2, 1.5, 0.1, 0.15);
      scene.symmetry = Symmetry::cylindrical;
      scene.domain.shape = DomainShape::shell;
      scene.domain.inner_radius = 0.5;
      set_boundary(scene, Side::inner,
                   varying_wall([](double t) { return t > 0.05 ? -1.5 : -1.; }));
      Boundary outer = varying_wall([](double t) { return -1.2 * std::sin(30 * t); });
      outer.kind = BoundaryKind::flux;
      set_boundary(scene, Side::outer, outer);
      try
      {
        run_cut(scene, 40,
                {{"scheme", "conservative"}, {"fewest_steps", "25"}, {"passes", "4"}});
        FAIL();
      }
      catch(const Refusal &refusal)
      {
        EXPECT_NE(std::string(refusal.what()).find("steps in a row"), std::string::npos)
            << refusal.what();
      }
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
