// Distributions over disturbed starts. The targets are those of independent codes, with
// the tolerances of four standard errors at 200 runs; fewer runs have wider ones.

#include <particles/greenspan/tests/report_runs.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    constexpr double deviation = 1e-6;
    constexpr int threads = 2;

    /** Tolerance of so many runs for one that is stated for others. */
    double widened(double tolerance, int stated_for, int runs)
    {
      return tolerance * std::max(1., std::sqrt(double(stated_for) / runs));
    }

    double mean_solid(const std::vector<RunRecord> &records, long step, long interval)
    {
      return spread_of(records, [step, interval](const RunRecord &record)
                       { return double(record.solid.at(step / interval)); })
          .mean;
    }

    TEST(GreenspanExperiments, PrintedHeatMeltsNothing)
    {
      for(const auto &[experiment, runs] :
          {std::pair{triangle_slow(2), 12}, std::pair{triangle_fast(2), 24}})
        for(const RunRecord &record :
            run_ensemble(experiment, runs, deviation, 1, threads))
        {
          EXPECT_EQ(record.first_break, -1);
          EXPECT_EQ(record.first_fluid, -1);
          EXPECT_EQ(record.old_bonds, 63);
          EXPECT_EQ(record.least_solid, 28);
        }
    }

    TEST(GreenspanExperiments, SlowHeatMeltsTheTriangleInItsThirdStage)
    {
      const Experiment experiment = triangle_slow(-2);
      const int runs = 50;
      const auto records = run_ensemble(experiment, runs, deviation, 1, threads);
      for(const RunRecord &record : records)
      {
        EXPECT_GT(record.first_break, 80000);
        EXPECT_GE(record.first_fluid, record.first_break - experiment.interval);
      }
      EXPECT_NEAR(
          spread_of(records, [](const RunRecord &r) { return double(r.first_break); })
              .mean,
          82160, widened(250, 200, runs));
      EXPECT_NEAR(
          spread_of(records, [](const RunRecord &r) { return double(r.least_solid); })
              .mean,
          20.2, widened(0.5, 200, runs));
      EXPECT_NEAR(mean_solid(records, 100000, experiment.interval), 27.48,
                  widened(0.2, 200, runs));
      EXPECT_NEAR(spread_of(records, [](const RunRecord &r)
                            { return double(-r.lowest_x > r.highest_x); })
                      .mean,
                  0.72, widened(0.1, 200, runs));
      // Particle 23 is among the two that are fluid most often.
      const auto counts = final_fluid_counts(records, 28);
      EXPECT_LE(std::count_if(counts.begin(), counts.end(),
                              [&counts](int count) { return count > counts[23]; }),
                1);
    }

    TEST(GreenspanExperiments, FastHeatSplashesAndTheDropsComeBack)
    {
      const Experiment experiment = triangle_fast(-2);
      const auto records = run_ensemble(experiment, 200, deviation, 1, threads);
      for(const RunRecord &record : records)
        EXPECT_EQ(record.first_break, 1300);
      EXPECT_NEAR(mean_solid(records, 3000, experiment.interval), 19.8, 0.2);
      EXPECT_NEAR(mean_solid(records, 30000, experiment.interval), 27.30, 0.2);
      EXPECT_NEAR(spread_of(records, [](const RunRecord &r)
                            { return double(r.final_fluid.empty()); })
                      .mean,
                  0.56, 0.1);
    }

    TEST(GreenspanExperiments, UndisturbedFastHeatFollowsTheFigures)
    {
      const Experiment experiment = triangle_fast(-2);
      const RunRecord record = run(experiment);
      EXPECT_EQ(record.solid.at(2000 / experiment.interval), 22); // 19 to 23 and 25 fluid
      EXPECT_EQ(record.solid.at(5000 / experiment.interval), 24); // 19 23 25 28 fluid
      for(const long step : {13000, 15000, 20000, 25000, 30000})
        EXPECT_EQ(record.solid.at(step / experiment.interval), 28) << step;
    }

    TEST(GreenspanExperiments, HotBaseDissolvesTheRectangle)
    {
      const Experiment experiment = rectangle_on_hot_base();
      const int runs = 50;
      const auto records = run_ensemble(experiment, runs, deviation, 1, threads);
      EXPECT_NEAR(mean_solid(records, 30000, experiment.interval), 32,
                  widened(3, 150, runs));
      EXPECT_NEAR(mean_solid(records, 40000, experiment.interval), 8,
                  widened(2.5, 150, runs));
      EXPECT_NEAR(mean_solid(records, 50000, experiment.interval), 4.8,
                  widened(1.5, 150, runs));
      EXPECT_NEAR(
          spread_of(records, [](const RunRecord &r) { return double(r.all_fluid >= 0); })
              .mean,
          0.63, widened(0.12, 150, runs));
      // The corners break well below the 25 of the report.
      for(const int corner : {0, 1})
        EXPECT_NEAR(spread_of(records,
                              [corner](const RunRecord &r)
                              {
                                const auto &c = r.corners[corner];
                                return c.step < 0 ? NAN : c.temperature;
                              })
                        .mean,
                    corner == 0 ? 18.5 : 17.1, 4 * 3.8 / std::sqrt(runs));
    }

    TEST(GreenspanExperiments, EvenlyHotBaseIsVolatile)
    {
      const auto records
          = run_ensemble(rectangle_on_base(2.5), 20, deviation, 1, threads);
      for(const RunRecord &record : records)
        EXPECT_GT(record.all_fluid, 0);
      const Spread end
          = spread_of(records, [](const RunRecord &r) { return double(r.all_fluid); });
      EXPECT_NEAR(end.mean, 8800, 4 * 1170 / std::sqrt(20.) + 4 * 1170 / std::sqrt(40.));
    }

    TEST(GreenspanExperiments, UnheatedControlsStayWhole)
    {
      for(Experiment experiment : {triangle_unheated(), rectangle_unheated()})
      {
        const int bonds = experiment.start.size() == 28 ? 63 : 111;
        for(const RunRecord &record : run_ensemble(experiment, 2, deviation, 1, threads))
        {
          EXPECT_EQ(record.first_break, -1);
          EXPECT_EQ(record.first_fluid, -1);
          EXPECT_EQ(record.old_bonds, bonds);
        }
      }
    }

    TEST(GreenspanExperiments, RecordsDoNotDependOnThreads)
    {
      Experiment experiment = triangle_fast(-2);
      experiment.steps = 5000;
      const auto one = run_ensemble(experiment, 5, deviation, 3, 1),
                 two = run_ensemble(experiment, 5, deviation, 3, 2);
      ASSERT_EQ(one.size(), two.size());
      for(std::size_t i = 0; i < one.size(); ++i)
      {
        EXPECT_EQ(one[i].solid, two[i].solid);
        EXPECT_EQ(one[i].lowest_x, two[i].lowest_x);
        EXPECT_EQ(one[i].kinetic_energy, two[i].kinetic_energy);
      }
      EXPECT_NE(one[0].lowest_x, one[1].lowest_x);
      experiment.parameters.force.cutoff = 1; // fails in every thread
      EXPECT_ANY_THROW(run_ensemble(experiment, 3, deviation, 1, 2));
    }
  } // namespace
} // namespace meltfront::particles::greenspan
