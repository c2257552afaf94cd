#include <verification/run/end_profile.h>
#include <verification/run/heat_observer.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    using tests::State;

    /** Drive an observer through a run of `steps` steps whose front is given over time.
     */
    void drive(cases::Observer &observer, int steps,
               const std::function<double(double)> &front, double end_time = 1,
               const std::function<void(State &, int)> &disturb = {})
    {
      constexpr int n = 50;
      cases::RunDescription description;
      description.spacing = 1. / n;
      description.smoothing_length = 1.2 / n;
      observer.begin(description);
      double initial_heat = 0;
      for(int step = 0; step <= steps; ++step)
      {
        const double time = end_time * step / steps;
        const bool wanted = observer.wants(step, time);
        if(!wanted && step > 0 && step < steps)
          continue;
        State state = tests::slab_state(n, front(time));
        state.book(initial_heat);
        if(step == 0)
        {
          initial_heat = state.snapshot.heat.boundary;
          state.book(initial_heat);
        }
        state.snapshot.step = step;
        if(disturb)
          disturb(state, step);
        observer.observe(state.view(1, time));
      }
    }

    double exact_front(double time)
    {
      return 0.5 * std::sqrt(time);
    }

    TEST(HeatObserver, MeasuresAKnownErrorOfTheFront)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      // 1e-3 too far in the first half, 2e-3 short in the second.
      drive(observer, 200,
            [](double time)
            { return time == 0 ? 0 : exact_front(time) + (time < 0.5 ? 1e-3 : -2e-3); });
      observer.require_end();
      const auto values = observer.quantities();
      // 100 samples after the initial state: 49 before t = 0.5.
      EXPECT_EQ(observer.series().time.size(), 101u);
      EXPECT_NEAR(values.at("front_rms"), std::sqrt((49 * 1e-6 + 51 * 4e-6) / 100),
                  1e-12);
      EXPECT_NEAR(values.at("front_rms_relative"), values.at("front_rms") / 0.5, 1e-12);
      EXPECT_NEAR(values.at("front_max"), 2e-3, 1e-12);
      EXPECT_NEAR(values.at("front_end"), 2e-3, 1e-12);
      EXPECT_NEAR(values.at("front_end_relative"), 4e-3, 1e-12);
      EXPECT_NEAR(values.at("front_late_max_relative"), 4e-3, 1e-12);
      EXPECT_NEAR(values.at("front_end_position"), 0.498, 1e-12);
      EXPECT_NEAR(values.at("front_isotherm_rms"), values.at("front_rms"), 1e-9);
      EXPECT_EQ(values.at("budget_defect"), 0);
      EXPECT_TRUE(std::isnan(values.at("front_floor")));
    }

    TEST(HeatObserver, TakesTheLateErrorFromTheSecondHalfOnly)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 200,
            [](double time) { return exact_front(time) + (time < 0.49 ? 1e-2 : 1e-4); });
      EXPECT_NEAR(observer.quantities().at("front_late_max_relative"), 2e-4, 1e-12);
      EXPECT_NEAR(observer.quantities().at("front_max"), 1e-2, 1e-12);
    }

    TEST(HeatObserver, FollowsThePapersTwoErrors)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 200, exact_front);
      // Cells of 0.02, h = 0.024: what the readings must be at each sampled time.
      double squares_ice = 0, squares_loss = 0;
      int frozen = 0;
      for(int sample = 1; sample <= 100; ++sample)
      {
        const double front = exact_front(sample / 100.) * 50;
        const int full = static_cast<int>(std::floor(front + 1e-12));
        if(full == 0)
          continue;
        const int lost = front - full > 0.25 ? full + 1 : full;
        const double ice = (full - 0.5) / 50 + 0.012 - front / 50;
        const double loss = (lost - 0.5) / 50 - front / 50;
        squares_ice += ice * ice;
        squares_loss += loss * loss;
        ++frozen;
      }
      EXPECT_NEAR(observer.quantities().at("front_max_ice_rms"),
                  std::sqrt(squares_ice / frozen), 1e-9);
      EXPECT_NEAR(observer.quantities().at("front_heat_loss_rms"),
                  std::sqrt(squares_loss / frozen), 1e-9);
    }

    TEST(HeatObserver, MeasuresTheTemperatureAtTheEnd)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 100, exact_front, 1,
            [](State &state, int step)
            {
              if(step != 100)
                return;
              state.temperature[10] += 0.05;
              state.book(state.snapshot.heat.initial);
            });
      // |T_exact - T_m| reaches 0.49 at the last cell.
      EXPECT_NEAR(observer.quantities().at("temperature_max"), 0.05 / 0.49, 1e-12);
      EXPECT_GT(observer.quantities().at("temperature_l2"), 0);
      EXPECT_EQ(observer.profile().time, 1);
      EXPECT_EQ(observer.profile().temperature.size(), 50u);
      EXPECT_NEAR(observer.profile().temperature_exact[10], 0.21 - 0.5, 1e-12);
    }

    TEST(HeatObserver, SamplesEveryStepOrOnTheClockOfRoots)
    {
      cases::Case c = tests::slab_case("slab");
      c.measurement.samples = 0;
      HeatObserver every(c, c.scene, "fake", tests::fake_capabilities());
      // Off at one step only, which is none of the 200 that the series keeps.
      drive(every, 1000,
            [](double time) { return exact_front(time) + (time == 0.503 ? 0.01 : 0); });
      EXPECT_NEAR(every.quantities().at("front_rms"), 0.01 / std::sqrt(1000.), 1e-12);
      EXPECT_EQ(every.series().time.size(), 201u);
      EXPECT_EQ(every.series().front_exact.size(), 201u);
      EXPECT_EQ(every.series().time.back(), 1);

      c.measurement.samples = 50;
      c.measurement.square_root_clock = true;
      HeatObserver roots(c, c.scene, "fake", tests::fake_capabilities());
      drive(roots, 100000, exact_front);
      ASSERT_EQ(roots.series().time.size(), 51u);
      for(int i = 0; i <= 50; ++i)
        EXPECT_NEAR(std::sqrt(roots.series().time[i]), i / 50., 1e-3);
    }

    TEST(HeatObserver, TellsBeforehandTheTimesThatItWants)
    {
      cases::Case c = tests::slab_case("slab");
      c.measurement.intermediate_times = {0.333, 0.5, 1};
      c.measurement.samples = 50;
      for(const bool roots : {false, true})
      {
        c.measurement.square_root_clock = roots;
        const auto times
            = HeatObserver(c, c.scene, "fake", tests::fake_capabilities()).wanted_times();
        // One of the intermediate times is a sample on the clock of t, and the last the
        // end.
        ASSERT_EQ(times.size(), roots ? 53u : 52u);
        EXPECT_TRUE(std::ranges::is_sorted(times));
        EXPECT_EQ(times.front(), 0);
        EXPECT_EQ(times.back(), 1);
        EXPECT_NE(std::ranges::find(times, 0.333), times.end());
        EXPECT_DOUBLE_EQ(times[1], roots ? 1. / 2500 : 0.02);
      }
    }

    TEST(HeatObserver, TakesEveryStepThereIsWhenTheyAreFew)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 7, exact_front);
      EXPECT_EQ(observer.series().time.size(), 8u);
      observer.require_end();
    }

    TEST(HeatObserver, MeasuresHowFarAFrontFallsBack)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver monotone(c, c.scene, "fake", tests::fake_capabilities());
      drive(monotone, 100, exact_front);
      EXPECT_EQ(monotone.quantities().at("front_backsteps"), 0);
      HeatObserver wobbling(c, c.scene, "fake", tests::fake_capabilities());
      drive(wobbling, 100,
            [](double time) { return exact_front(time) - (time == 0.5) * 0.1; });
      EXPECT_NEAR(wobbling.quantities().at("front_backsteps"),
                  exact_front(0.49) - exact_front(0.5) + 0.1, 1e-12);
      const auto retreat = [](double time) { return 0.5 - 0.1 * time; };
      HeatObserver astray(c, c.scene, "fake", tests::fake_capabilities());
      drive(astray, 100, retreat);
      EXPECT_NEAR(astray.quantities().at("front_backsteps"), 0.1, 1e-12)
          << "the exact front advances";
      cases::Case unknown = c;
      unknown.exact = nullptr;
      HeatObserver melting(unknown, unknown.scene, "fake", tests::fake_capabilities());
      drive(melting, 100, retreat);
      EXPECT_EQ(melting.quantities().at("front_backsteps"), 0);
    }

    TEST(HeatObserver, GivesNoMeanOfFewerThanFiftyTimes)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver few(c, c.scene, "fake", tests::fake_capabilities());
      drive(few, 49, exact_front);
      EXPECT_TRUE(std::isnan(few.quantities().at("front_rms")));
      EXPECT_NEAR(few.quantities().at("front_end"), 0, 1e-15);
      HeatObserver enough(c, c.scene, "fake", tests::fake_capabilities());
      drive(enough, 50, exact_front);
      EXPECT_NEAR(enough.quantities().at("front_rms"), 0, 1e-15);
    }

    TEST(HeatObserver, LeavesUndefinedWhatNeedsAnExactSolution)
    {
      cases::Case c = tests::slab_case("slab");
      c.exact = nullptr;
      c.measurement.front_floor = 3e-5;
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 100, exact_front);
      const auto values = observer.quantities();
      for(const char *name : {"front_rms", "front_end", "front_max", "temperature_l2",
                              "front_late_max_relative", "front_max_ice_rms"})
        EXPECT_TRUE(std::isnan(values.at(name))) << name;
      EXPECT_NEAR(values.at("front_end_position"), 0.5, 1e-12);
      EXPECT_EQ(values.at("front_floor"), 3e-5);
      EXPECT_TRUE(observer.series().front_exact.empty());
      EXPECT_TRUE(observer.profile().temperature_exact.empty());
    }

    long failing_step(const std::function<void(State &, int)> &disturb)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      try
      {
        drive(observer, 100, exact_front, 1, disturb);
      }
      catch(const cases::NumericalError &error)
      {
        EXPECT_EQ(error.method, "fake");
        return error.step;
      }
      return -1;
    }

    TEST(HeatObserver, StopsARunThatBreaksABound)
    {
      const auto at_step_30 = [](const std::function<void(State &)> &change)
      {
        return [change](State &state, int step)
        {
          if(step == 30)
            change(state);
        };
      };
      EXPECT_EQ(
          failing_step(at_step_30([](State &s) { s.temperature[3] = std::nan(""); })),
          30);
      EXPECT_EQ(failing_step(at_step_30([](State &s) { s.temperature[3] = 1.001; })), 30);
      EXPECT_EQ(failing_step(at_step_30([](State &s) { s.temperature[3] = -1.001; })),
                30);
      EXPECT_EQ(
          failing_step(at_step_30([](State &s) { s.solid_fraction[3] = std::nan(""); })),
          30);
      EXPECT_EQ(failing_step(
                    at_step_30([](State &s) { s.snapshot.heat.stored = std::nan(""); })),
                30);
      EXPECT_EQ(failing_step(at_step_30(
                    [](State &s)
                    {
                      s.temperature[3] = -0.5;
                      s.book(s.snapshot.heat.initial);
                    })),
                -1);
    }

    TEST(HeatObserver, KeepsTheWorstBudget)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 100, exact_front, 1,
            [](State &state, int step)
            {
              cases::HeatBudget &heat = state.snapshot.heat;
              const double scale
                  = std::max({std::abs(heat.stored) + std::abs(heat.latent), heat.initial,
                              std::abs(heat.boundary)});
              heat.boundary += step == 40 ? 1e-6 * scale : 0;
            });
      EXPECT_NEAR(observer.quantities().at("budget_defect"), 1e-6, 1e-11);
    }

    // Such a study reports the order of whatever the initial state was made with.
    TEST(HeatObserver, RefusesARunThatEndsWhenItStarts)
    {
      cases::Case c = tests::slab_case("slab");
      c.scene.end_time = c.scene.start_time;
      EXPECT_THROW(HeatObserver(c, c.scene, "fake", tests::fake_capabilities()),
                   cases::InputError);
      c.scene.end_time = 1;
      c.measurement.samples = 20;
      EXPECT_THROW(HeatObserver(c, c.scene, "fake", tests::fake_capabilities()),
                   cases::InputError);
    }

    TEST(HeatObserver, NoticesARunThatDoesNotReachItsEnd)
    {
      const cases::Case c = tests::slab_case("slab");
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 100, exact_front, 0.99);
      EXPECT_THROW(observer.require_end(), cases::NumericalError);
      EXPECT_TRUE(std::isnan(observer.quantities().at("front_end")));
    }

    TEST(HeatObserver, HandsASecondObserverWhatItWants)
    {
      class EveryTenth : public cases::Observer
      {
      public:
        void begin(const cases::RunDescription &) override
        {
          ++begun;
        }
        bool wants(long step, double) override
        {
          return step % 10 == 5;
        }
        void observe(const cases::Snapshot &snapshot) override
        {
          steps.push_back(snapshot.step);
        }
        int begun = 0;
        std::vector<long> steps;
      } second;
      cases::Case c = tests::slab_case("slab");
      c.measurement.samples = 50;
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities(), &second);
      drive(observer, 100, exact_front);
      EXPECT_EQ(second.begun, 1);
      EXPECT_EQ(second.steps,
                (std::vector<long>{0, 5, 15, 25, 35, 45, 55, 65, 75, 85, 95, 100}));
      EXPECT_EQ(observer.series().time.size(), 51u) << "its own samples stay its own";
    }

    TEST(EndProfile, ThinsOutWithoutHoles)
    {
      State state;
      for(int k = 0; k < 3; ++k)
        for(int j = 0; j < 200; ++j)
          for(int i = 0; i < 200; ++i)
          {
            state.positions[0].push_back((i + 0.5) / 200);
            state.positions[1].push_back((j + 0.5) / 200);
            state.positions[2].push_back((k - 1) / 200.);
            state.temperature.push_back(i);
            state.solid_fraction.push_back(0);
          }
      state.weights.assign(state.temperature.size(), 1);
      const cases::Snapshot &snapshot = state.view(3, 1);
      const RunProfile profile
          = make_end_profile(snapshot, state.positions[0], nullptr, 1. / 200);
      EXPECT_EQ(profile.coordinate.size(), 600u);
      EXPECT_EQ(profile.coordinate.front(), 0.5 / 200);
      EXPECT_EQ(profile.coordinate.back(), 199.5 / 200);
      EXPECT_TRUE(std::ranges::is_sorted(profile.coordinate));
      EXPECT_LE(profile.picture_x.size(), 6000u);
      EXPECT_GT(profile.picture_x.size(), 3000u);
      // Every tenth of the plane has its share.
      std::set<std::pair<int, int>> tenths;
      for(std::size_t i = 0; i < profile.picture_x.size(); ++i)
        tenths.emplace(static_cast<int>(10 * profile.picture_x[i]),
                       static_cast<int>(10 * profile.picture_y[i]));
      EXPECT_EQ(tenths.size(), 100u);
    }
  } // namespace
} // namespace meltfront::verification
