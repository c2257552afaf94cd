// Walls that exchange heat with their surroundings, by heat transfer or radiation.

#include <cases/error.h>
#include <cases/exact/mushy_layer.h>
#include <cases/exact/one_phase_start.h>
#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace meltfront::particles::testing
{
  namespace
  {
    using cases::Boundary, cases::BoundaryKind, cases::Field, cases::Position,
        cases::Scene;

    const auto mixture = make_sph_mixture();

    /** Surroundings that let a flux in at a temperature of the wall, which has a heat
     * transfer coefficient or radiates as strongly. */
    Boundary surroundings(BoundaryKind kind, double coefficient, double absolute_zero,
                          double at_wall, const std::function<double(double)> &flux)
    {
      Boundary wall;
      wall.kind = kind;
      wall.heat_transfer_coefficient = coefficient;
      wall.absolute_zero = absolute_zero;
      const double absolute = at_wall - absolute_zero;
      wall.emission_coefficient = coefficient / (4 * std::pow(absolute, 3));
      wall.value = {"", [=](const Position &, double time)
                    {
                      if(kind == BoundaryKind::heat_transfer)
                        return at_wall + flux(time) / coefficient;
                      return absolute_zero
                             + std::pow(std::pow(absolute, 4)
                                            + flux(time) / wall.emission_coefficient,
                                        0.25);
                    }};
      return wall;
    }

    Boundary steady_surroundings(BoundaryKind kind, double ambient, double coefficient,
                                 double absolute_zero)
    {
      Boundary wall = surroundings(kind, coefficient, absolute_zero, ambient,
                                   [](double) { return 0.; });
      wall.value = Field::uniform(ambient);
      return wall;
    }

    /** A pure substance above its melting point that freezes from one end, the other
     * insulated; solved by the oracle from one phase on. */
    Problem pure_slab(BoundaryKind kind)
    {
      cases::Material material = unit_material();
      material.solid.conductivity = 2;
      const double end = 0.15, ambient = -2, zero = -6;
      Problem problem;
      const Boundary wall = steady_surroundings(kind, ambient, 4, zero);
      problem.scene = slab(material, 1, 0.5, end, wall, Boundary());
      cases::OracleProblem oracle;
      oracle.material = material;
      oracle.end_time = end;
      oracle.initial_temperature = [](double) { return 0.5; };
      oracle.solid_at_origin = false;
      oracle.inner_wall
          = {kind, [=](double) { return ambient; }, wall.heat_transfer_coefficient,
             wall.emission_coefficient, zero};
      problem.exact = cases::solve_from_one_phase(oracle);
      return problem;
    }

    // Its fronts are those of `sph` with the same rule, whose order is 1.4 as well where
    // walls hold a temperature.
    TEST(MixtureWalls, FreezeAPureSubstance)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::heat_transfer, BoundaryKind::radiation})
      {
        const Problem problem = pure_slab(kind);
        const double end = problem.scene.end_time;
        const double front = problem.exact->front(end);
        std::vector<double> spacings, errors;
        for(const int n : {20, 40, 80, 160})
        {
          const AlloyOutcome outcome = run(*mixture, problem.scene, n, {}, 1);
          const Outcome sph = run(*make_sph(), problem, n);
          double sum = 0;
          int count = 0;
          for(std::size_t i = 0; i < outcome.times.size(); ++i)
            if(const double at = problem.exact->front(outcome.times[i]); at > 0.02)
            {
              sum += std::pow(outcome.solids[i] - at, 2);
              ++count;
            }
          ASSERT_GT(count, 100);
          spacings.push_back(1. / n);
          errors.push_back(std::sqrt(sum / count));
          EXPECT_LE(outcome.heat_defect, 1e-12);
          EXPECT_NEAR(outcome.solid, front, 0.3 / n);
          EXPECT_NEAR(outcome.solid, sph.front_end, 0.3 / n);
          // What came in is what the slab has lost.
          EXPECT_NEAR(outcome.heat.boundary, problem.exact->heat_content(0, 1, end) - 1.5,
                      0.3 / n);
        }
        EXPECT_GT(fitted_order(spacings, errors), 1.2);
        EXPECT_LT(errors.back(), 4e-4);
      }
    }

    /** Brine as it freezes against surroundings that take just the heat which keeps its
     * wall at -16.5: from 3 h 40 min on it is the mushy layer. */
    Scene nitrate_before(BoundaryKind kind, double diffusivity = 0)
    {
      Scene scene = nitrate_slab(91800, diffusivity);
      scene.start_time = 13200;
      const auto layer = std::make_shared<const cases::MushyLayer>(
          scene.material, *scene.alloy, std::vector<double>{nitrate_concentration}, -16.5,
          14.7);
      const double taken = layer->wall_heat(1); // grows as the root of time
      scene.boundaries[0]
          = surroundings(kind, 30, -273.15, -16.5,
                         [taken](double t) { return taken / (2 * std::sqrt(t)); });
      start_from(scene, layer);
      scene.initial.concentration = {{"", [layer](const Position &p, double t)
                                      { return layer->concentration(p[0], t); }}};
      return scene;
    }

    TEST(MixtureWalls, KeepTheMushyLayer)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::heat_transfer, BoundaryKind::radiation})
        for(const char *conductivity : {"integral", "arithmetic", "harmonic"})
        {
          std::vector<double> spacings, errors;
          for(const int n : {30, 60, 120, 240})
          {
            const Scene scene = nitrate_before(kind);
            const AlloyOutcome outcome
                = run(*mixture, scene, n, {{"conductivity", conductivity}});
            const MushErrors found = compare(outcome, nitrate_layer(), scene.end_time);
            spacings.push_back(outcome.description.spacing);
            errors.push_back(found.temperature);
            EXPECT_LE(outcome.heat_defect, 1e-12);
            EXPECT_LE(outcome.solute_defect, 1e-12);
          }
          EXPECT_GT(fitted_order(spacings, errors), 1.5) << conductivity;
        }
    }

    double largest_difference(const AlloyOutcome &a, const AlloyOutcome &b)
    {
      double largest = 0;
      for(std::size_t i = 0; i < a.temperature.size(); ++i)
        largest = std::max(largest, std::abs(a.temperature[i] - b.temperature[i]));
      return largest;
    }

    Scene nitrate_against(const Boundary &wall, double end_time = 13200)
    {
      Scene scene = nitrate_slab(end_time);
      scene.boundaries[0] = wall;
      return scene;
    }

    // Strong exchange holds the wall at the ambient temperature, none insulates it: for a
    // mush, below the eutectic temperature and for a pure substance.
    TEST(MixtureWalls, HaveTheirLimits)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::heat_transfer, BoundaryKind::radiation})
        for(const double ambient : {-16.5, -30.})
        {
          const auto with = [&](const Boundary &wall, bool pure)
          {
            Scene scene = nitrate_against(wall);
            scene.alloy->eutectic_temperature = -17.7;
            if(pure)
              scene.alloy.reset(), scene.initial.concentration.clear();
            return run(*mixture, scene, 40, {}, 1);
          };
          const auto exchanging = [&](double coefficient)
          { return steady_surroundings(kind, ambient, coefficient, -273.15); };
          for(const bool pure : {false, true})
          {
            const AlloyOutcome held = with(fixed_wall(ambient), pure);
            const AlloyOutcome strong = with(exchanging(1e9), pure);
            EXPECT_LT(largest_difference(held, strong), 1e-4) << ambient << pure;
            EXPECT_NEAR(strong.heat.boundary / held.heat.boundary, 1, 1e-6);
            EXPECT_LE(strong.heat_defect, 1e-12);
            EXPECT_GE(strong.lowest, ambient);
            const AlloyOutcome closed = with(Boundary(), pure);
            EXPECT_LT(largest_difference(closed, with(exchanging(1e-9), pure)), 1e-6);
          }
        }
    }

    // What a wall of any strength does keeps within the explicit step: temperatures stay
    // between the start's and the surroundings', which swing.
    TEST(MixtureWalls, KeepTheMaximumPrinciple)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::heat_transfer, BoundaryKind::radiation})
        for(const double coefficient : {3., 300., 1e5})
          for(const char *scheme : {"euler", "rkl2", "backward-euler"})
            for(const char *conductivity : {"integral", "arithmetic", "harmonic"})
            {
              Boundary wall = steady_surroundings(kind, -25, coefficient, -273.15);
              wall.value = {"", [](const Position &, double t)
                            { return -5 - 20 * std::cos(t / 300); }};
              Scene scene = nitrate_against(wall, 6000);
              scene.alloy->eutectic_temperature = -17.7;
              const AlloyOutcome outcome = run(*mixture, scene, 24,
                                               {{"time_scheme", scheme},
                                                {"step_factor", "1"},
                                                {"conductivity", conductivity}},
                                               1);
              EXPECT_GE(outcome.lowest, -25) << scheme << coefficient;
              EXPECT_LE(outcome.highest, 15 + 1e-9) << scheme << coefficient;
              EXPECT_LE(outcome.heat_defect, 1e-12) << scheme << coefficient;
              EXPECT_EQ(outcome.cost.capped_steps, 0) << scheme << coefficient;
            }
    }

    // Steps sixty times as long find the same mush.
    TEST(MixtureWalls, TakeImplicitSteps)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::heat_transfer, BoundaryKind::radiation})
      {
        const Scene scene = nitrate_before(kind, 6.8e-7 / nitrate_density);
        const AlloyOutcome fine = run(*mixture, scene, 60, {{"time_scheme", "euler"}});
        const AlloyOutcome coarse
            = run(*mixture, scene, 60,
                  {{"time_scheme", "crank-nicolson"}, {"step_factor", "60"}}, 1);
        EXPECT_LT(10 * coarse.cost.steps, fine.cost.steps);
        EXPECT_LT(largest_difference(fine, coarse), 0.02);
        EXPECT_LE(coarse.heat_defect, 1e-13);
        EXPECT_EQ(coarse.cost.capped_steps, 0);
      }
    }

    TEST(MixtureWalls, NeedParticlesThatAreNotOnThem)
    {
      const Scene scene = nitrate_against(
          steady_surroundings(BoundaryKind::heat_transfer, -16.5, 30, -273.15));
      EXPECT_THROW(run(*mixture, scene, 30, {{"layout", "edge"}}), cases::Refusal);
      EXPECT_THROW(run(*make_sph_two_population(), scene, 30), cases::Refusal);
    }
  } // namespace
} // namespace meltfront::particles::testing
