#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <particles/rkpm_tracked/line/sites.h>
#include <particles/rkpm_tracked/tests/watched_run.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** From a front at a place for a short while. */
    double front_from(double start, const LineSettings &settings = {})
    {
      const LineProblem problem = dirichlet_slab(bar_material(), 40);
      Watched run(problem, settings);
      run.stepper.start(straight_state(problem, start), {});
      run.advance(0.01);
      return run.stepper.state().fronts[0];
    }

    TEST(Front, OnANodeOrBesideOne)
    {
      for(const double interpolation_distance : {0., 0.1})
      {
        const LineSettings settings{2, 2.6, interpolation_distance, 2};
        const double on_node = front_from(0.1, settings);
        for(const double offset : {1e-12, 1e-12 / 40, 1e-9, 1e-7, 1e-5, 1e-4})
          for(const double sign : {-1., 1.})
            EXPECT_NEAR(front_from(0.1 + sign * offset, settings), on_node,
                        1e-9 + 1.5 * offset)
                << sign * offset << ' ' << interpolation_distance;
      }
    }

    TEST(Front, PassesByNodesAsCloseAsRoundOff)
    {
      // Steps that end 1e-12 spacings before, on, and behind nodes.
      const LineProblem problem = dirichlet_slab(bar_material(), 40);
      for(const double interpolation_distance : {0., 0.1})
        for(const double offset : {-1e-12, 0., 1e-12})
        {
          LineSolver solver(problem, {2, 2.6, interpolation_distance, 2});
          LineState state = straight_state(problem, 0.1 + offset * problem.spacing);
          solver.restart(state);
          for(int k = 1; k <= 40; ++k)
            ASSERT_EQ(solver.step_to(1e-4 * k), StepOutcome::accepted);
          for(const double value : solver.state().temperature)
            EXPECT_TRUE(value <= hot + 1e-6 && value >= cold - 1e-6);
          EXPECT_NEAR(solver.state().fronts[0], 0.1159, 2e-4);
        }
    }

    TEST(Front, StepsThatWouldPassTwoNodesAreCutShort)
    {
      // At rest until its wall becomes hotter: the speed of before tells nothing.
      const LineProblem problem = unit_slab(
          bar_material(2, 7), 40, [](double) { return 2000.; },
          [](double) { return cold; });
      const double start = 70. / 170.;
      LineSolver solver(problem, {});
      solver.restart(straight_state(problem, start));
      EXPECT_EQ(solver.step_to(0.05), StepOutcome::too_far);
      EXPECT_EQ(solver.state().time, 0.);
      Watched coarse(problem, {}, 1620, 1., 1.), fine(problem, {}, 1620);
      for(Watched *run : {&coarse, &fine})
        run->stepper.start(straight_state(problem, start), {});
      coarse.advance(0.05);
      fine.advance(0.05);
      EXPECT_GT(coarse.stepper.shortened(), 0);
      EXPECT_GT(fine.stepper.state().fronts[0], start + 2 * problem.spacing);
      EXPECT_NEAR(coarse.stepper.state().fronts[0], fine.stepper.state().fronts[0], 2e-2);
    }

    /** A wall that is cold, then warm: the front goes out and comes back. */
    TEST(Front, TurnsBackAsTheOracleDoes)
    {
      const cases::Material material;
      const auto wall
          = [](double t) { return -1 + 0.49 * (1 + std::tanh((t - 0.03) / 0.0015)); };
      cases::OracleProblem exact;
      exact.material = material;
      exact.inner_wall = {cases::BoundaryKind::fixed_temperature, wall};
      exact.outer_wall
          = {cases::BoundaryKind::fixed_temperature, [](double) { return 1.; }};
      exact.start_time = 0.005;
      exact.end_time = 0.09;
      exact.start = std::make_shared<const cases::PlanarNeumann>(material, -1., 1.);
      const cases::SpectralOracle oracle(exact);
      std::vector<double> errors;
      for(const int n : {40, 80, 160, 320})
      {
        const LineProblem problem
            = unit_slab(material, n, wall, [](double) { return 1.; });
        Watched run(problem, {}, 2, 1e-6);
        LineState state;
        state.solid_first = true;
        state.time = exact.start_time;
        state.fronts = {oracle.front(state.time)};
        for(const double x : problem.nodes)
          state.temperature.push_back(oracle.temperature(x, state.time));
        run.stepper.start(state, {});
        double squares = 0;
        for(int k = 1; k <= 2 * n; ++k)
        {
          const double time = 0.005 + 0.085 * k / (2 * n);
          run.advance(time);
          const double error = run.stepper.state().fronts[0] - oracle.front(time);
          squares += error * error;
        }
        EXPECT_EQ(run.reversals(), 1);
        errors.push_back(std::sqrt(squares / (2 * n)));
        RecordProperty("reversal_error_" + std::to_string(n),
                       std::to_string(errors.back() * 1e6) + "e-6");
      }
      EXPECT_LE(errors[2], 1e-4);
      EXPECT_GE(fitted_order(errors), 1.8);
    }

    TEST(Phase, AppearsAtAHotWall)
    {
      // Quasi-steady start in cold solid; Neumann's front is the truth.
      const ExactLine exact = neumann(bar_material());
      std::vector<double> errors;
      for(const int n : {40, 80, 160, 320})
      {
        const LineProblem problem = unit_slab(
            bar_material(), n, [](double) { return hot; },
            [&](double t) { return t > 0 ? exact.temperature(1., t) : cold; });
        Watched run(problem, {});
        LineState state;
        state.solid_first = true;
        state.temperature.assign(problem.nodes.size(), cold);
        state.temperature[0] = hot;
        run.stepper.start(state, {});
        EXPECT_TRUE(run.noted("liquid appeared at the lower wall"));
        run.advance(exact.time_of(0.18));
        errors.push_back(run.stepper.state().fronts[0] - 0.18);
        RecordProperty("start_error_" + std::to_string(n),
                       std::to_string(errors.back() * 1e6) + "e-6");
      }
      EXPECT_GE(fitted_order(errors), 1.5);
      EXPECT_LE(std::abs(errors[0]), 2.7e-3);
    }

    TEST(Phase, VanishesAtAnInsulatedWall)
    {
      // A little liquid beside an insulated wall freezes from the cold side.
      LineProblem problem = dirichlet_slab(bar_material(), 40);
      problem.walls[0] = {};
      Watched run(problem, {});
      LineState state = straight_state(problem, 0.06);
      for(std::size_t i = 0; problem.nodes[i] < 0.06; ++i)
        state.temperature[i] = 431;
      run.stepper.start(state, {});
      for(int k = 1; k <= 60; ++k)
        run.advance(k);
      EXPECT_TRUE(run.stepper.state().fronts.empty());
      EXPECT_TRUE(run.stepper.state().solid_first);
      EXPECT_TRUE(run.noted("liquid vanished"));
      EXPECT_NEAR(run.stepper.state().temperature[0], cold, 1e-6);
    }

    /** Liquid between two solids that freezes: what heat is missing at the end, over the
     * latent heat. */
    double freeze_between(Watched &run)
    {
      const LineProblem &problem = run.problem;
      LineState state;
      state.solid_first = true;
      state.fronts = {0.4, 0.6};
      for(const double x : problem.nodes)
        state.temperature.push_back(x < 0.4   ? -0.5 * (0.4 - x) / 0.4
                                    : x > 0.6 ? -0.5 * (x - 0.6) / 0.4
                                              : 0.4 * (x - 0.4) * (0.6 - x));
      run.stepper.start(state, {});
      const LineHeat before = heat_of(problem, state);
      double in = 0;
      for(int k = 1; k <= 10; ++k)
        run.stepper.advance(
            0.006 * k,
            [&](const LineState &begin)
            {
              const LineState &now = run.stepper.state();
              in += (now.time - begin.time)
                    * (wall_heat(problem, begin) + wall_heat(problem, now)) / 2;
            });
      return (heat_of(problem, run.stepper.state()).total() - before.total() - in)
             / before.latent;
    }

    TEST(Fronts, TwoThatMeetLeaveOnePhase)
    {
      for(const int n : {39, 40, 80})
      {
        cases::Material material;
        material.solid.conductivity = 2;
        const auto wall = [](double) { return -0.5; };
        const LineProblem problem = unit_slab(material, n, wall, wall);
        Watched run(problem, {}, 1, 1e-6);
        const double missing = freeze_between(run);
        EXPECT_TRUE(run.stepper.state().fronts.empty());
        EXPECT_TRUE(run.noted("liquid between two fronts that met vanished at 0.5 m"));
        EXPECT_LE(std::abs(missing), 1e-3) << n;
        // Both halves alike.
        const LineState &state = run.stepper.state();
        for(std::size_t i = 0; i < state.temperature.size(); ++i)
          EXPECT_NEAR(state.temperature[i],
                      state.temperature[state.temperature.size() - 1 - i], 1e-8);
        RecordProperty("merging_missing_heat_" + std::to_string(n),
                       std::to_string(missing * 1e6) + "e-6");
      }
    }

    TEST(Wall, ThatCoolsBringsASecondFront)
    {
      // The liquid's own wall freezes while solid lies beyond: two fronts, which meet.
      LineProblem problem = unit_slab(
          bar_material(), 80, [](double t) { return t < 0.02 ? hot : 400.; },
          [](double) { return cold; });
      Watched run(problem, {});
      run.stepper.start(straight_state(problem, 0.06), {});
      run.advance(0.03);
      EXPECT_TRUE(run.noted("solid appeared at the lower wall"));
      EXPECT_EQ(run.stepper.state().fronts.size(), 2U);
      run.advance(2.);
      EXPECT_TRUE(run.stepper.state().fronts.empty());
      EXPECT_TRUE(run.noted("liquid between two fronts that met vanished"));
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
