#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <particles/front_tracking/line_sites.h>
#include <particles/front_tracking/tests/line_cases.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace meltfront::particles::front_tracking
{
  namespace
  {
    /** A stepper with what it says, and what it passed through. */
    struct Watched
    {
      Watched(const LineProblem &problem, const LineSettings &settings, double span = 120,
              double first_step = 1e-6, double largest_move = 0.5)
        : problem(problem)
        , stepper(problem, settings, {largest_move, first_step, span, 1e-14},
                  [this](double, const std::string &event) { notes.push_back(event); })
      {
      }

      void advance(double target)
      {
        stepper.advance(target,
                        [this]
                        {
                          const LineState &state = stepper.state();
                          for(const double value : state.temperature)
                          {
                            ASSERT_TRUE(std::isfinite(value));
                            lowest = std::min(lowest, value);
                            highest = std::max(highest, value);
                          }
                          fronts.push_back(state.fronts.empty() ? 0.
                                                                : state.fronts.front());
                        });
      }

      /** How often the front turned back by more than round-off. */
      int reversals() const
      {
        int result = 0;
        double direction = 0;
        for(std::size_t i = 1; i < fronts.size(); ++i)
        {
          const double move = fronts[i] - fronts[i - 1];
          if(std::abs(move) < 1e-9)
            continue;
          result += move * direction < 0;
          direction = move;
        }
        return result;
      }

      bool noted(const std::string &words) const
      {
        return std::ranges::any_of(notes, [&](const std::string &note)
                                   { return note.find(words) != std::string::npos; });
      }

      const LineProblem &problem;
      LineStepper stepper;
      std::vector<std::string> notes;
      std::vector<double> fronts;
      double lowest = 1e300, highest = -1e300;
    };

    LineProblem held_slab(const cases::Material &material, int n)
    {
      return unit_slab(
          material, n, [](double) { return hot; }, [](double) { return cold; });
    }

    /** Straight temperatures on both sides of a front. */
    LineState straight_state(const LineProblem &problem, double front)
    {
      LineState state;
      state.solid_first = false;
      state.fronts = {front};
      for(const double x : problem.nodes)
        state.temperature.push_back(x < front
                                        ? hot - (hot - 430) * x / front
                                        : 430 - (430 - cold) * (x - front) / (1 - front));
      return state;
    }

    constexpr double bar_front[][2]
        = {{0.01, 0.1109742}, {0.05, 0.1986270}, {0.1, 0.2556866},
           {0.2, 0.3204786},  {0.5, 0.3903320},  {1, 0.4096586}};

    TEST(Bar, FollowsThePublishedFront)
    {
      const LineProblem problem = held_slab(bar_material(), 160);
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
          const LineProblem problem = held_slab(bar_material(ratio, 70 / stefan), 40);
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
          const LineProblem problem = held_slab(bar_material(), 40);
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
        const LineProblem problem = held_slab(bar_material(), 40);
        LineSolver solver(problem, {2, 2.6, 0.1, scheme});
        const double steady = 70. / 170.;
        solver.restart(straight_state(problem, steady));
        for(int k = 1; k <= 10000; ++k)
          ASSERT_EQ(solver.step_to(0.01 * k), StepOutcome::accepted);
        EXPECT_NEAR(solver.state().fronts[0], steady, 1e-8);
      }
    }

    /** From a front at a place for a short while. */
    double front_from(double start, const LineSettings &settings = {})
    {
      const LineProblem problem = held_slab(bar_material(), 40);
      Watched run(problem, settings);
      run.stepper.start(straight_state(problem, start), {});
      run.advance(0.01);
      return run.stepper.state().fronts[0];
    }

    TEST(Front, OnANodeOrBesideOne)
    {
      for(const double absorption : {0., 0.1})
      {
        const LineSettings settings{2, 2.6, absorption, 2};
        const double on_node = front_from(0.1, settings);
        for(const double offset : {1e-12, 1e-12 / 40, 1e-9, 1e-7, 1e-5, 1e-4})
          for(const double sign : {-1., 1.})
            EXPECT_NEAR(front_from(0.1 + sign * offset, settings), on_node,
                        1e-9 + 1.5 * offset)
                << sign * offset << ' ' << absorption;
      }
    }

    TEST(Front, PassesByNodesAsCloseAsRoundOff)
    {
      // Steps that end 1e-12 spacings before, on, and behind nodes.
      const LineProblem problem = held_slab(bar_material(), 40);
      for(const double absorption : {0., 0.1})
        for(const double offset : {-1e-12, 0., 1e-12})
        {
          LineSolver solver(problem, {2, 2.6, absorption, 2});
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
      const LineProblem problem = held_slab(bar_material(2, 7), 40);
      LineSolver solver(problem, {});
      solver.restart(straight_state(problem, 0.06));
      EXPECT_EQ(solver.step_to(0.02), StepOutcome::too_far);
      EXPECT_EQ(solver.state().time, 0.);
      Watched coarse(problem, {}, 120, 1., 1.), fine(problem, {});
      for(Watched *run : {&coarse, &fine})
        run->stepper.start(straight_state(problem, 0.06), {});
      coarse.advance(0.02);
      fine.advance(0.02);
      EXPECT_GT(coarse.stepper.shortened(), 0);
      EXPECT_GT(coarse.stepper.state().fronts[0], 0.06 + 2 * problem.spacing);
      // Steps of a whole spacing from profiles that do not move with the front.
      EXPECT_NEAR(coarse.stepper.state().fronts[0], fine.stepper.state().fronts[0], 3e-2);
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
      LineProblem problem = held_slab(bar_material(), 40);
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
      double in = 0, last = wall_heat(problem, run.stepper.state()), time = 0;
      for(int k = 1; k <= 10; ++k)
        run.stepper.advance(0.006 * k,
                            [&]
                            {
                              const LineState &now = run.stepper.state();
                              const double heat = wall_heat(problem, now);
                              in += (now.time - time) * (heat + last) / 2;
                              last = heat;
                              time = now.time;
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
      LineProblem problem = held_slab(bar_material(), 30);
      problem.walls[0] = {cases::BoundaryKind::flux, [](double) { return 160.; }, 0};
      EXPECT_NEAR(resting_front(problem), 1 - 100. / 160, 1e-7);
      problem.walls[0]
          = {cases::BoundaryKind::heat_transfer, [](double) { return 550.; }, 2.};
      // 2 (550 - T) = (T - 430)/X = 100/(1 - X).
      const double front = resting_front(problem);
      const double wall = 430 + 100 * front / (1 - front);
      EXPECT_NEAR(2 * (550 - wall), 100 / (1 - front), 1e-5);
    }

    TEST(Walls, HeatReleasedInsideMovesTheRestingFront)
    {
      LineProblem problem = held_slab(bar_material(), 30);
      constexpr double release = 60;
      problem.heat_release = [](double, double) { return release; };
      const double x = resting_front(problem);
      const double liquid = -70 / x - release * x / 2;
      const double solid = 2 * (-50 / (1 - x) + release * (1 - x) / 4);
      EXPECT_NEAR(liquid, solid, 1e-5);
    }

    TEST(Warning, TellsOfAPhaseThatWouldAppearInside)
    {
      LineProblem problem = held_slab(bar_material(), 30);
      // Solid that is heated beyond melting between its front and its cold wall.
      problem.heat_release = [](double x, double) { return x > 0.5 ? 5e3 : 0.; };
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
        const LineProblem problem = unit_slab(
            material, 80, [](double) { return hot; },
            [&](double t) { return exact.temperature(1., t); });
        Watched run(problem, {}, 120, 1e-4);
        run.stepper.start(state_of(exact, problem, exact.time_of(0.06)), {});
        run.advance(exact.time_of(0.18));
        EXPECT_EQ(
            run.noted("thermal layer of the solid beside the front is not resolved"),
            warned)
            << ratio << ' ' << stefan;
        EXPECT_EQ(run.noted("V h/alpha = "), warned) << ratio << ' ' << stefan;
        EXPECT_EQ(run.noted("thermal layer of the liquid"), stefan > 1) << stefan;
      }
    }
  } // namespace
} // namespace meltfront::particles::front_tracking
