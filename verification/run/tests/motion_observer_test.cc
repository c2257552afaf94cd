#include <cases/reported_scalars.h>
#include <cases/shape.h>
#include <cases/velocity_field.h>
#include <verification/judge/criteria.h>
#include <verification/record/json_values.h>
#include <verification/run/motion_observer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Two particles that part from each other; the second melts at t = 5. */
    cases::Case solid_case(std::vector<double> intermediate_times)
    {
      cases::Case c;
      c.scene.name = "two-particles";
      c.scene.problem = cases::ProblemKind::particle_solid;
      c.scene.end_time = 10;
      c.scene.particle_solid = cases::ParticleSolid();
      c.measurement.intermediate_times = std::move(intermediate_times);
      return c;
    }

    void run(MotionObserver &observer, int steps)
    {
      observer.begin({});
      for(int step = 0; step <= steps; ++step)
      {
        const double time = 10. * step / steps;
        if(step > 0 && step < steps && !observer.wants(step, time))
          continue;
        const std::vector<double> x{-1. / 3 * time, 1. / 3 * time}, y{0, 1},
            velocity{-1, 1}, solid{1, time < 5 ? 1. : 0.};
        cases::Snapshot snapshot;
        snapshot.step = step;
        snapshot.time = time;
        snapshot.dimension = 2;
        snapshot.positions = {x, y};
        snapshot.velocity = {velocity, velocity};
        snapshot.solid_fraction = solid;
        observer.observe(snapshot);
      }
      observer.require_end();
    }

    RunRecord record_of(const MotionObserver &observer)
    {
      RunRecord record;
      record.status = RunStatus::finished;
      observer.keep_course(record);
      observer.keep_results(record);
      return record;
    }
  } // namespace

  TEST(MotionObserver, CountsSolidParticlesAtIntermediateTimes)
  {
    const cases::Case c = solid_case({4, 6});
    MotionObserver observer(c, c.scene, "fake");
    run(observer, 1000);
    observer.report("least_solid", 1);
    const RunRecord record = record_of(observer);
    EXPECT_EQ(record.quantities.at("solid_1"), 2);
    EXPECT_EQ(record.quantities.at("solid_2"), 1);
    EXPECT_EQ(record.quantities.at("solid_end"), 1);
    EXPECT_EQ(record.quantities.at("least_solid"), 1);
    ASSERT_EQ(record.particle_frames.size(), 4u); // start, intermediate times, end
    EXPECT_EQ(record.particle_frames[1].step, 400);
    EXPECT_NEAR(record.particle_frames[1].x[1], 4. / 3, 1e-4); // five digits are kept
    EXPECT_EQ(record.particle_frames[1].y[0], 0);
    EXPECT_TRUE(record.animation.empty());
    EXPECT_EQ(record.series.time.size(), record.series.solid_volume.size());
  }

  TEST(MotionObserver, AnimatesWhereThingsHappen)
  {
    const cases::Case c = solid_case({8, 9});
    MotionObserver observer(c, c.scene, "fake", nullptr, true);
    run(observer, 1000);
    const RunRecord record = record_of(observer);
    EXPECT_EQ(record.animation.size(), 61u);
    EXPECT_EQ(record.animation.front().step, 0);
    EXPECT_EQ(record.animation.back().step, 1000);
    EXPECT_EQ(std::ranges::count_if(record.animation, [](const ParticleFrame &frame)
                                    { return frame.time < 8; }),
              12);
    for(std::size_t i = 1; i < record.animation.size(); ++i)
      EXPECT_GT(record.animation[i].step, record.animation[i - 1].step);
  }

  TEST(MotionObserver, FewStepsGiveFewPictures)
  {
    const cases::Case c = solid_case({});
    MotionObserver observer(c, c.scene, "fake", nullptr, true);
    run(observer, 7);
    EXPECT_EQ(record_of(observer).animation.size(), 8u);
  }

  TEST(MotionObserver, MeasuresAnAdvectedInterface)
  {
    cases::Case c;
    c.scene.problem = cases::ProblemKind::interface_advection;
    c.scene.domain.shape = cases::DomainShape::box;
    c.scene.domain.dimension = 2;
    c.scene.domain.upper = {1, 1, 0};
    const auto plane = std::make_shared<cases::HalfSpace>(0.2);
    c.scene.interface = cases::InterfaceAdvection{
        plane, std::make_shared<cases::RigidMotion>(cases::Position{0.5, 0, 0}, 0,
                                                    cases::Position{})};
    c.measurement.intermediate_times = {0.5};
    MotionObserver observer(c, c.scene, "fake");
    cases::RunDescription description;
    description.spacing = 0.1;
    observer.begin(description);
    for(const double time : {0., 0.5, 1.})
    {
      cases::Snapshot snapshot;
      snapshot.step = std::lround(2 * time);
      snapshot.time = time;
      snapshot.dimension = 2;
      // It lags behind by a tenth of the way.
      snapshot.level_set
          = [&](const cases::Position &p) { return 0.2 + 0.45 * time - p[0]; };
      observer.observe(snapshot);
    }
    const RunRecord record = record_of(observer);
    EXPECT_NEAR(record.quantities.at("front_l1_1"), 0.25, 0.06);
    EXPECT_NEAR(record.quantities.at("front_l1_end"), 0.5, 0.06);
    EXPECT_LT(record.quantities.at("volume_error_end"), 0);
    EXPECT_EQ(record.quantities.at("shape_extra_end"), 0);
    EXPECT_TRUE(std::isnan(record.quantities.at("curvature_rms_end")));
    EXPECT_NEAR(record.series.solid_volume.back(), 0.65, 0.011);
    for(const auto &[name, value] : record.quantities)
      EXPECT_NO_THROW(require_quantity(name));
  }
} // namespace meltfront::verification
