#include <particles/rkpm_tracked/tests/watched_run.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    constexpr double bar_front[][2]
        = {{0.01, 0.1109742}, {0.05, 0.1986270}, {0.1, 0.2556866},
           {0.2, 0.3204786},  {0.5, 0.3903320},  {1, 0.4096586}};

    TEST(Bar, FollowsThePublishedFront)
    {
      const LineProblem problem = dirichlet_slab(bar_material(), 160);
      Watched run(problem, {});
      run.stepper.start(straight_state(problem, 0.06), {});
      double time = 0;
      for(const auto &[mark, front] : bar_front)
      {
        while(time < mark - 1e-12)
          run.advance(time = std::min(mark, time + 1. / 160));
        EXPECT_NEAR(run.stepper.state().fronts[0], front, 1e-4) << mark;
      }
      EXPECT_EQ(run.reversals(), 0);
      EXPECT_LE(run.highest, hot + 1e-6);
      EXPECT_GE(run.lowest, cold - 1e-6);
    }

    TEST(LongTime, AllCombinationsReachTheSteadyFront)
    {
      for(const double ratio : {1e-3, 1e-2, 0.1, 2., 10., 100., 1e3})
        for(const double stefan : {0.01, 0.636, 10.})
        {
          const LineProblem problem
              = dirichlet_slab(bar_material(ratio, 70 / stefan), 40);
          Watched run(problem, {2, 2.6, 0.1, 1}, 120, 1e-6, 1.);
          run.stepper.start(straight_state(problem, 0.06), {});
          run.advance(1e6);
          const double steady = 70. / (70. + 50. * ratio);
          EXPECT_NEAR(run.stepper.state().fronts[0], steady, 1e-6)
              << ratio << ' ' << stefan;
          EXPECT_EQ(run.reversals(), 0) << ratio << ' ' << stefan;
          EXPECT_LE(run.highest, hot + 1e-6) << ratio << ' ' << stefan;
          EXPECT_GE(run.lowest, cold - 1e-6) << ratio << ' ' << stefan;
        }
    }

    TEST(LongTime, HigherOrdersReachTheSteadyFront)
    {
      for(const int basis : {2, 3, 4})
        for(const int scheme : {2, 3})
        {
          const LineProblem problem = dirichlet_slab(bar_material(), 40);
          Watched run(problem, {basis, default_dilation(basis), 0.1, scheme});
          run.stepper.start(straight_state(problem, 0.06), {});
          run.advance(1e3);
          EXPECT_NEAR(run.stepper.state().fronts[0], 70. / 170., 1e-6)
              << basis << ' ' << scheme;
        }
    }

    TEST(Steady, HoldsForTenThousandSteps)
    {
      for(const int scheme : {1, 2, 3})
      {
        const LineProblem problem = dirichlet_slab(bar_material(), 40);
        LineSolver solver(problem, {2, 2.6, 0.1, scheme});
        const double steady = 70. / 170.;
        solver.restart(straight_state(problem, steady));
        for(int k = 1; k <= 10000; ++k)
          ASSERT_EQ(solver.step_to(0.01 * k), StepOutcome::accepted);
        EXPECT_NEAR(solver.state().fronts[0], steady, 1e-8);
      }
    }

    /** Where a front comes to rest. */
    double resting_front(const LineProblem &problem)
    {
      Watched run(problem, {}, 120, 1e-5);
      run.stepper.start(straight_state(problem, 0.3), {});
      for(int k = 1; k <= 50; ++k)
        run.advance(20. * k);
      return run.stepper.state().fronts.at(0);
    }

    TEST(Walls, FluxAndExchangeOfHeatHoldTheFront)
    {
      // The solid lets q = 2 (430 - 380)/(1 - X) through; so must the wall.
      LineProblem problem = dirichlet_slab(bar_material(), 30);
      problem.walls[0] = {.kind = cases::BoundaryKind::flux,
                          .value = [](double) { return 160.; },
                          .value_after = [](double) { return 160.; },
                          .mean_flux = [](double, double) { return 160.; }};
      EXPECT_NEAR(resting_front(problem), 1 - 100. / 160, 1e-7);
      problem.walls[0] = {.kind = cases::BoundaryKind::heat_transfer,
                          .value = [](double) { return 550.; },
                          .value_after = [](double) { return 550.; },
                          .law = {.kind = cases::BoundaryKind::heat_transfer,
                                  .value = {},
                                  .heat_transfer_coefficient = 2}};
      // 2 (550 - T) = (T - 430)/X = 100/(1 - X).
      const double front = resting_front(problem);
      const double wall = 430 + 100 * front / (1 - front);
      EXPECT_NEAR(2 * (550 - wall), 100 / (1 - front), 1e-5);
    }

    TEST(Walls, RadiationHoldsTheFront)
    {
      LineProblem problem = dirichlet_slab(bar_material(), 30);
      problem.walls[0] = {.kind = cases::BoundaryKind::radiation,
                          .value = [](double) { return 550.; },
                          .value_after = [](double) { return 550.; },
                          .law = {.kind = cases::BoundaryKind::radiation,
                                  .value = {},
                                  .emission_coefficient = 4e-9,
                                  .absolute_zero = 0}};
      // 4e-9 (550^4 - T^4) = (T - 430)/X = 100/(1 - X).
      const double front = resting_front(problem);
      const double wall = 430 + 100 * front / (1 - front);
      EXPECT_NEAR(4e-9 * (std::pow(550, 4) - std::pow(wall, 4)), 100 / (1 - front), 1e-5);
    }

    TEST(Walls, VolumetricSourceMovesTheRestingFront)
    {
      LineProblem problem = dirichlet_slab(bar_material(), 30);
      constexpr double release = 60;
      problem.volumetric_source = [](double, double) { return release; };
      const double x = resting_front(problem);
      const double liquid = -70 / x - release * x / 2;
      const double solid = 2 * (-50 / (1 - x) + release * (1 - x) / 4);
      EXPECT_NEAR(liquid, solid, 1e-5);
    }

    /** Heat is released up to a place just within the solid or the liquid: the heat
     * counts that no node sees. */
    TEST(Walls, ReleaseThatEndsBesideTheFrontMovesIt)
    {
      LineProblem problem = dirichlet_slab(bar_material(), 30);
      constexpr double release = 60;
      for(const double end : {0.427, 0.433, 0.44, 0.46})
      {
        problem.volumetric_source
            = [end](double x, double) { return x < end ? release : 0; };
        const double x = resting_front(problem);
        ASSERT_LT(std::abs(x - end), 1. / 30);
        // In the liquid, then in the solid, where the heat is released up to the place.
        const double left = std::min(x, end), right = std::max(end - x, 0.);
        const double liquid = (-70 - release * left * left / 2) / x;
        const double solid
            = 2 * (-50 + release / 2 * (right * (1 - x) - right * right / 2)) / (1 - x);
        EXPECT_NEAR(liquid, solid, 1e-5) << end << ' ' << x;
      }
    }

    TEST(Warning, TellsOfAPhaseThatWouldAppearInside)
    {
      LineProblem problem = dirichlet_slab(bar_material(), 30);
      // Solid that is heated beyond melting between its front and its cold wall.
      problem.volumetric_source = [](double x, double) { return x > 0.5 ? 5e3 : 0.; };
      Watched run(problem, {}, 120, 1e-5);
      run.stepper.start(straight_state(problem, 0.2), {});
      run.advance(0.05);
      EXPECT_TRUE(run.noted("solid is superheated by"));
    }

    TEST(Warning, TellsOfALayerThatIsNotResolved)
    {
      struct Expectation
      {
        double ratio, stefan;
        bool warned;
      };
      for(const auto &[ratio, stefan, warned] :
          {Expectation{1e-3, 0.01, true}, {1e-3, 10, true}, {2, 0.636, false}})
      {
        const cases::Material material = bar_material(ratio, 70 / stefan);
        const ExactLine exact = neumann(material);
        LineProblem problem = unit_slab(
            material, 80, [](double) { return hot; },
            [&](double t) { return exact.temperature(1., t); });
        // With balances the front's speed varies as nodes pass through a layer that is
        // not resolved.
        problem.form = Form::collocation;
        Watched run(problem, {}, 120, 1e-4);
        run.stepper.start(state_of(exact, problem, exact.time_of(0.06)), {});
        run.advance(exact.time_of(0.18));
        EXPECT_EQ(
            run.noted("thermal layer of the solid beside the front is not resolved"),
            warned)
            << ratio << ' ' << stefan;
        EXPECT_EQ(run.noted("V h/alpha = "), warned) << ratio << ' ' << stefan;
        // The front is fastest at the start: X = 2 lambda sqrt(alpha t).
        const double peclet
            = 0.06 / (2 * exact.time_of(0.06)) / 80 / material.liquid.diffusivity();
        EXPECT_EQ(run.noted("thermal layer of the liquid"), peclet > 0.5) << peclet;
      }
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
