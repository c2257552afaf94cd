#include <verification/run/front_frame.h>
#include <verification/run/heat_observer.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <numbers>

// What is measured where the front is no function of one coordinate, or is tracked.

namespace meltfront::verification
{
  namespace
  {
    using tests::State;

    constexpr double pi = std::numbers::pi;

    cases::Case disk_case()
    {
      cases::Case c;
      c.scene = tests::scene_of(cases::DomainShape::ball, 2, cases::Symmetry::none);
      c.scene.name = "disk";
      c.scene.domain.radius = 1;
      c.scene.boundaries[static_cast<std::size_t>(cases::Side::outer)] = cases::Boundary{
          cases::BoundaryKind::fixed_temperature, cases::Field::uniform(1), false};
      c.scene.initial.temperature = {"cone", [](const cases::Position &p, double)
                                     { return std::hypot(p[0], p[1]) - 0.5; }};
      c.text = "disk";
      return c;
    }

    /** One site that is solid by a share of the disk, and tracked points on a circle. */
    struct DiskState : State
    {
      std::vector<double> x, y;

      DiskState(double volume, double radius, int points)
      {
        positions[0] = {0.1, 0.2};
        positions[1] = {0, 0};
        weights = {pi / 2, pi / 2};
        temperature = {-0.4, 0.3};
        solid_fraction = {volume / (pi / 2), 0};
        for(int i = 0; i < points; ++i)
        {
          x.push_back(radius * std::cos(2 * pi * i / points));
          y.push_back(radius * std::sin(2 * pi * i / points));
        }
      }

      const cases::Snapshot &view_at(long step, double time)
      {
        view(2, time);
        snapshot.step = step;
        snapshot.front[0] = x;
        snapshot.front[1] = y;
        return snapshot;
      }
    };

    using OverTime = std::function<double(double)>;

    /** @return how many snapshots were taken */
    int drive(
        cases::Observer &observer, int steps, const OverTime &volume,
        const OverTime &radius = [](double) { return 0.3; }, int points = 8)
    {
      cases::RunDescription description;
      description.spacing = 0.25; // of two sites for all the disk
      observer.begin(description);
      int taken = 0;
      for(int step = 0; step <= steps; ++step)
      {
        const double time = static_cast<double>(step) / steps;
        if(!observer.wants(step, time) && step > 0 && step < steps)
          continue;
        DiskState state(volume(time), radius(time), points);
        observer.observe(state.view_at(step, time));
        ++taken;
      }
      return taken;
    }

    double growing(double time)
    {
      return 0.3 + 0.4 * std::sin(time);
    }

    TEST(SolidVolumeOverTime, IsMeasuredAtIntermediateTimesFromTheStepsAroundThem)
    {
      cases::Case c = disk_case();
      c.measurement.samples = 50;
      c.measurement.intermediate_times = {0.3333, 0.5, 1};
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      const int taken = drive(observer, 1000, growing);
      EXPECT_LT(taken, 51 + 30);
      const auto values = observer.quantities();
      EXPECT_NEAR(values.at("solid_volume_1"), growing(0.3333), 1e-13)
          << "with samples of 0.02 alone: 3e-10";
      EXPECT_NEAR(values.at("solid_volume_2"), growing(0.5), 1e-15) << "a step hits it";
      EXPECT_NEAR(values.at("solid_volume_3"), growing(1), 1e-15);
      EXPECT_TRUE(std::isnan(values.at("solid_volume_4")));
      EXPECT_EQ(values.at("solid_volume_3"), values.at("solid_volume_end"));
      EXPECT_EQ(observer.series().time.size(), 51u)
          << "intermediate times add nothing to the series";
      EXPECT_NEAR(observer.series().solid_volume.back(), growing(1), 1e-15);
    }

    TEST(Events, LookAtEveryStepUntilTheyHaveHappened)
    {
      cases::Case c = disk_case();
      c.measurement.samples = 50;
      c.measurement.events = {cases::TimedEvent::half_frozen};
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      // The first of two equal sites freezes until t = 0.8.
      const int taken = drive(observer, 1000,
                              [](double time)
                              { return pi / 2 * std::clamp(time / 0.8005, 1e-6, 1.); });
      const auto values = observer.quantities();
      EXPECT_NEAR(values.at("half_frozen"), 0.8005, 1e-3);
      EXPECT_TRUE(std::isnan(values.at("all_frozen"))) << "not asked for";
      EXPECT_TRUE(std::isnan(values.at("mirror_asymmetry"))) << "not asked for";
      EXPECT_GE(taken, 802) << "every step up to the event";
      EXPECT_LE(taken, 802 + 12) << "samples after it";
      EXPECT_EQ(observer.series().time.size(), 51u) << "events add nothing to the series";
    }

    TEST(Events, MirrorSymmetryIsMeasuredWhereAskedFor)
    {
      cases::Case c = disk_case();
      for(const int direction : {0, 1})
      {
        c.measurement.mirror = direction;
        HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
        drive(observer, 100, growing);
        const double asymmetry = observer.quantities().at("mirror_asymmetry");
        if(direction == 0)
          EXPECT_TRUE(std::isnan(asymmetry)) << "both sites lie right of the origin";
        else
          EXPECT_EQ(asymmetry, 0) << "each site is its own image";
      }
    }

    TEST(SolidVolumeOverTime, TellsHowFarItFellBackOfItsNetChange)
    {
      const cases::Case c = disk_case();
      HeatObserver monotone(c, c.scene, "fake", tests::fake_capabilities());
      drive(monotone, 100, growing);
      EXPECT_EQ(monotone.quantities().at("solid_volume_backsteps"), 0);
      HeatObserver dented(c, c.scene, "fake", tests::fake_capabilities());
      drive(dented, 100,
            [](double time) { return 0.2 + 0.5 * time - (time == 0.5) * 0.1; });
      EXPECT_NEAR(dented.quantities().at("solid_volume_backsteps"), (0.1 - 0.005) / 0.5,
                  1e-12);
      HeatObserver melting(c, c.scene, "fake", tests::fake_capabilities());
      drive(melting, 100, [](double time) { return 0.8 - 0.5 * time; });
      EXPECT_EQ(melting.quantities().at("solid_volume_backsteps"), 0);
      HeatObserver standing(c, c.scene, "fake", tests::fake_capabilities());
      drive(standing, 100, [](double) { return 0.5; });
      EXPECT_TRUE(std::isnan(standing.quantities().at("solid_volume_backsteps")));
    }

    TEST(TrackedFront, IsHeldAgainstTheExactOne)
    {
      cases::Case c = disk_case();
      c.exact = std::make_shared<tests::LinearProfile>(cases::Symmetry::cylindrical);
      const auto exact = [](double time) { return 0.5 * std::sqrt(time); };
      const auto volume
          = [&](double time) { return pi * std::max(1e-12, exact(time) * exact(time)); };
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 200, volume,
            [&](double time) { return exact(time) + (time < 0.5 ? 1e-3 : -2e-3); });
      const auto values = observer.quantities();
      EXPECT_NEAR(values.at("front_points_rms"), std::sqrt((49 * 1e-6 + 51 * 4e-6) / 100),
                  1e-12);
      EXPECT_NEAR(values.at("front_points_max"), 2e-3, 1e-12);
      EXPECT_NEAR(values.at("roundness_end"), 0, 1e-15);
      EXPECT_NEAR(values.at("front_rms"), 0, 1e-12);
      HeatObserver untracked(c, c.scene, "fake", tests::fake_capabilities());
      drive(untracked, 200, volume, exact, 0);
      for(const char *name : {"front_points_rms", "front_points_max", "roundness_end"})
        EXPECT_TRUE(std::isnan(untracked.quantities().at(name))) << name;
      EXPECT_TRUE(untracked.frames().empty());
    }

    TEST(TrackedFront, IsKeptAtIntermediateTimesAndTheEnd)
    {
      cases::Case c = disk_case();
      c.measurement.intermediate_times = {0.25, 0.5, 1};
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(
          observer, 40, growing, [](double time) { return 0.2 + 0.1 * time; }, 1000);
      const auto &frames = observer.frames();
      ASSERT_EQ(frames.size(), 3u);
      EXPECT_EQ(frames[0].time, 0.25);
      EXPECT_EQ(frames[2].time, 1);
      EXPECT_EQ(frames[1].x.size(), 400u);
      for(std::size_t i = 0; i < 400; ++i)
        EXPECT_NEAR(std::hypot(frames[1].x[i], frames[1].y[i]), 0.25, 1e-15);
    }

    TEST(TrackedFront, ShowsTheLayerOfABallNearestItsMiddle)
    {
      State state;
      state.temperature = {0};
      cases::Snapshot snapshot = state.view(3, 1);
      const std::vector<double> x{1, 2, 3, 4}, y{0, 0, 0, 0}, z{0.1, -0.11, 0.5, 0.1};
      snapshot.front = {x, y, z};
      std::vector<FrontFrame> frames;
      add_front_frame(snapshot, 0.1, frames);
      ASSERT_EQ(frames.size(), 1u);
      EXPECT_EQ(frames[0].x, (std::vector<double>{1, 2, 4}));
    }

    TEST(TemperatureOvershoot, IsMeasuredAndBoundedByWhatTheMethodDeclares)
    {
      const cases::Case c = disk_case(); // between -0.5 and 1
      const auto run_with = [&](double highest, int points)
      {
        cases::Capabilities capabilities = tests::fake_capabilities();
        capabilities.overshoot = {.at_twenty = 0.1, .order = 0};
        HeatObserver observer(c, c.scene, "fake", capabilities);
        cases::RunDescription description;
        description.spacing = 0.1;
        observer.begin(description);
        for(int step = 0; step <= 100; ++step)
        {
          DiskState state(0.5, 0.3, points);
          state.snapshot.obeys_maximum_principle = points == 0;
          if(step == 50)
            state.temperature[1] = highest;
          observer.observe(state.view_at(step, step / 100.));
        }
        return observer.quantities().at("temperature_overshoot");
      };
      EXPECT_EQ(run_with(0.9, 0), 0);
      EXPECT_THROW(run_with(1.01, 0), cases::NumericalError);
      EXPECT_NEAR(run_with(1.03, 8), 0.03 / 1.5, 1e-3);
      EXPECT_THROW(run_with(1.2, 8), cases::NumericalError);
    }

    TEST(FrontModeEnd, IsMeasuredWhereTheCaseAsksForIt)
    {
      cases::Case c = disk_case();
      HeatObserver unasked(c, c.scene, "fake", tests::fake_capabilities());
      drive(unasked, 100, growing);
      EXPECT_TRUE(std::isnan(unasked.quantities().at("front_mode_end")));
      c.measurement.front_mode = 1;
      HeatObserver observer(c, c.scene, "fake", tests::fake_capabilities());
      drive(observer, 100, growing);
      // All solid lies at one site at phi = 0.
      EXPECT_NEAR(observer.quantities().at("front_mode_end"), std::sqrt(growing(1) / pi),
                  1e-14);
    }
  } // namespace
} // namespace meltfront::verification
