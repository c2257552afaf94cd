#include <cases/exact/oracle.h>
#include <particles/front_tracking/line_sites.h>
#include <particles/front_tracking/tests/line_cases.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
      const double between = front_from(0.1 + 1e-6);
      for(const double offset : {0., 1e-12, -1e-12, 1e-12 / 40, 1e-9, -1e-9, 1e-4, -1e-4})
        for(const double absorption : {0., 0.1})
          EXPECT_NEAR(front_from(0.1 + offset, {2, 2.6, absorption, 2}), between,
                      2 * std::abs(offset) + 2e-4)
              << offset << ' ' << absorption;
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
      EXPECT_NEAR(coarse.stepper.state().fronts[0], fine.stepper.state().fronts[0], 5e-3);
    }

    /** A wall that is cold, then warm: the front goes out and comes back. */
    TEST(Front, TurnsBackAsTheOracleDoes)
    {
      cases::Material material;
      const auto wall
          = [](double t) { return -1 + 0.49 * (1 + std::tanh((t - 0.03) / 0.0015)); };
      cases::OracleProblem exact;
      exact.material = material;
      exact.inner_wall = {cases::BoundaryKind::fixed_temperature, wall};
      exact.outer_wall
          = {cases::BoundaryKind::fixed_temperature, [](double) { return 1.; }};
      exact.end_time = 0.09;
      exact.initial_front = 0.06;
      exact.initial_temperature
          = [](double x) { return x < 0.06 ? x / 0.06 - 1 : (x - 0.06) / 0.94; };
      const cases::SpectralOracle oracle(exact);
      std::vector<double> errors;
      for(const int n : {40, 80, 160})
      {
        const LineProblem problem
            = unit_slab(material, n, wall, [](double) { return 1.; });
        Watched run(problem, {}, 2, 1e-7);
        LineState state;
        state.solid_first = true;
        state.fronts = {0.06};
        for(const double x : problem.nodes)
          state.temperature.push_back(exact.initial_temperature(x));
        run.stepper.start(state, {});
        for(int k = 1; k <= n; ++k)
          run.advance(0.09 * k / n);
        EXPECT_EQ(run.reversals(), 1);
        errors.push_back(run.stepper.state().fronts[0] - oracle.front(0.09));
        RecordProperty("reversal_error_" + std::to_string(n),
                       std::to_string(errors.back() * 1e6) + "e-6");
      }
      EXPECT_LE(std::abs(errors[2]), 1e-4);
      EXPECT_GE(fitted_order(errors), 1.5);
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
      EXPECT_GE(fitted_order(errors), 0.9);
      EXPECT_LE(std::abs(errors[0]), 3e-3);
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
      run.advance(20.);
      EXPECT_TRUE(run.stepper.state().fronts.empty());
      EXPECT_TRUE(run.stepper.state().solid_first);
      EXPECT_TRUE(run.noted("liquid vanished"));
      EXPECT_NEAR(run.stepper.state().temperature[0], cold, 1e-6);
    }

    /** Heat in the slab at the end, and what came in on the way. */
    struct Balance
    {
      double defect = 0, latent = 0;
    };

    Balance thin_liquid(int n, Watched *&run, const LineProblem &problem)
    {
      static_cast<void>(n);
      LineState state;
      state.solid_first = true;
      state.fronts = {0.4, 0.6};
      for(const double x : problem.nodes)
        state.temperature.push_back(x < 0.4   ? -0.5 * (0.4 - x) / 0.4
                                    : x > 0.6 ? -0.5 * (x - 0.6) / 0.4
                                              : 0.4 * (x - 0.4) * (0.6 - x));
      run->stepper.start(state, {});
      const double before = heat_of(problem, state).total();
      Balance result;
      result.latent = heat_of(problem, state).latent;
      double in = 0, last = wall_heat(problem, run->stepper.state()), time = 0;
      run->stepper.advance(0.6,
                           [&]
                           {
                             const LineState &now = run->stepper.state();
                             const double heat = wall_heat(problem, now);
                             in += (now.time - time) * (heat + last) / 2;
                             last = heat;
                             time = now.time;
                             for(const double value : now.temperature)
                               ASSERT_TRUE(std::isfinite(value));
                           });
      result.defect = heat_of(problem, run->stepper.state()).total() - before - in;
      return result;
    }

    TEST(Fronts, TwoThatMeetLeaveOnePhase)
    {
      for(const int n : {40, 80})
      {
        cases::Material material;
        material.solid.conductivity = 2;
        const auto wall = [](double) { return -0.5; };
        const LineProblem problem = unit_slab(material, n, wall, wall);
        Watched watched(problem, {}, 1, 1e-6);
        Watched *run = &watched;
        const Balance balance = thin_liquid(n, run, problem);
        EXPECT_TRUE(watched.stepper.state().fronts.empty());
        EXPECT_TRUE(watched.noted("liquid between two fronts that met vanished at 0.5"));
        EXPECT_LE(std::abs(balance.defect), 5e-3 * balance.latent);
        // Both halves alike.
        const LineState &state = watched.stepper.state();
        for(std::size_t i = 0; i < state.temperature.size(); ++i)
          EXPECT_NEAR(state.temperature[i],
                      state.temperature[state.temperature.size() - 1 - i], 1e-8);
        RecordProperty("merging_defect_" + std::to_string(n),
                       std::to_string(balance.defect / balance.latent));
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

    TEST(Warning, TellsOfALayerThatIsNotResolved)
    {
      for(const double stefan : {0.01, 10.})
      {
        const cases::Material material = bar_material(1e-3, 70 / stefan);
        const ExactLine exact = neumann(material);
        const LineProblem problem = unit_slab(
            material, 80, [](double) { return hot; },
            [&](double t) { return exact.temperature(1., t); });
        Watched run(problem, {}, 120, 1e-4);
        run.stepper.start(state_of(exact, problem, exact.time_of(0.06)), {});
        run.advance(exact.time_of(0.18));
        // V h/alpha of the solid is 0.05 at the start for the small Stefan number.
        EXPECT_EQ(
            run.noted("thermal layer of the solid beside the front is not resolved"),
            stefan > 1)
            << stefan;
        EXPECT_EQ(run.noted("V h/alpha = "), stefan > 1) << stefan;
        EXPECT_FALSE(run.noted("of the liquid"));
      }
    }
  } // namespace
} // namespace meltfront::particles::front_tracking
