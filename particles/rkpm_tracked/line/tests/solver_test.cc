#include <particles/rkpm_tracked/line/tests/cases.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Runs of n = coarsest, twice, four and eight times that. */
    std::vector<MeltingResult>
    joint_refinement(MeltingRun run, double steps_per_node = 0.5, int coarsest = 40)
    {
      std::vector<MeltingResult> results;
      for(int n = coarsest; n <= 8 * coarsest; n *= 2)
      {
        run.n = n;
        run.steps = static_cast<int>(steps_per_node * n);
        results.push_back(melt(run));
      }
      return results;
    }

    std::vector<double> front_errors(const std::vector<MeltingResult> &results)
    {
      std::vector<double> errors;
      for(const MeltingResult &result : results)
        errors.push_back(result.front_error);
      return errors;
    }

    std::vector<double> temperature_errors(const std::vector<MeltingResult> &results)
    {
      std::vector<double> errors;
      for(const MeltingResult &result : results)
        errors.push_back(result.temperature_error);
      return errors;
    }

    MeltingRun standard_run()
    {
      MeltingRun run;
      run.exact = neumann(run.material);
      return run;
    }

    // Figures of an independent program with the same scheme.
    TEST(Melting, SpaceAndTimeTogetherBdf2)
    {
      const std::vector<MeltingResult> results = joint_refinement(standard_run());
      const double printed[] = {2.4e-4, 2.3e-5, 4.8e-6, 9.5e-7};
      for(std::size_t i = 0; i < results.size(); ++i)
        EXPECT_LT(std::abs(results[i].front_error), 2 * printed[i]);
      EXPECT_GT(std::abs(results[0].front_error), printed[0] / 2);
      EXPECT_GE(fitted_order(front_errors(results)), 2.);
      EXPECT_GE(fitted_order(temperature_errors(results)), 2.);
      EXPECT_LE(results[0].temperature_error, 2 * 8.5e-2);
      EXPECT_LE(results[3].temperature_error, 2 * 3.4e-4);
    }

    TEST(Melting, SpaceAndTimeTogetherBackwardEuler)
    {
      MeltingRun run = standard_run();
      run.time_order = 1;
      const double order = fitted_order(front_errors(joint_refinement(run)));
      EXPECT_GE(order, 0.95);
      EXPECT_LE(order, 1.1);
    }

    TEST(Melting, SpaceAndTimeTogetherBdf3)
    {
      for(const int basis : {2, 3})
      {
        MeltingRun run = standard_run();
        run.time_order = 3;
        run.basis_order = basis;
        const std::vector<MeltingResult> results = joint_refinement(run);
        EXPECT_GE(fitted_order(front_errors(results)), 2.);
        EXPECT_LE(std::abs(results[3].front_error), 2 * 5.9e-6);
      }
    }

    /** Order in time: 20 to 160 steps against 640. */
    double order_in_time(int time_order)
    {
      MeltingRun run = standard_run();
      run.n = 80;
      run.time_order = time_order;
      run.steps = 640;
      const double reference = melt(run).front;
      std::vector<double> errors;
      for(const int steps : {20, 40, 80, 160})
      {
        run.steps = steps;
        errors.push_back(melt(run).front - reference);
      }
      return fitted_order(errors);
    }

    TEST(Melting, OrdersInTime)
    {
      const double euler = order_in_time(1), bdf2 = order_in_time(2),
                   bdf3 = order_in_time(3);
      EXPECT_GE(euler, 0.9);
      EXPECT_LE(euler, 1.3);
      EXPECT_GE(bdf2, 1.9);
      EXPECT_LE(bdf2, 2.4);
      EXPECT_GE(bdf3, 2.8);
    }

    /** Order in space: 40 to 320 intervals with many steps of BDF3. */
    double order_in_space(int basis_order, double jitter)
    {
      MeltingRun run = standard_run();
      run.time_order = 3;
      run.steps = 1000;
      run.basis_order = basis_order;
      run.jitter = jitter;
      std::vector<double> errors;
      for(const int n : {40, 80, 160, 320})
      {
        run.n = n;
        errors.push_back(melt(run).front_error);
      }
      return fitted_order(errors);
    }

    TEST(Melting, OrdersInSpace)
    {
      EXPECT_GE(order_in_space(2, 0), 1.7);
      EXPECT_GE(order_in_space(3, 0), 1.7);
      EXPECT_GE(order_in_space(4, 0), 3.5);
    }

    TEST(Melting, OrdersInSpaceOnPerturbedNodes)
    {
      EXPECT_GE(order_in_space(2, 0.2), 1.7);
      EXPECT_GE(order_in_space(3, 0.2), 1.7);
      EXPECT_GE(order_in_space(4, 0.2), 3.5);
    }

    TEST(Melting, OpenWallSolutionHasThePrintedConstants)
    {
      const double ratio[] = {0.5, 0.9, 1, 1.04, 1.1, 1.5, 2};
      const double lambda[] = {0.5140508258, 0.3745126550, 0.3543133690, 0.3471021412,
                               0.3370661955, 0.2869387599, 0.2474969765};
      for(int i = 0; i < 7; ++i)
        EXPECT_NEAR(neumann_with_open_wall(bar_material(2, 110, ratio[i])).front(1.) / 2,
                    lambda[i], 1e-10);
    }

    TEST(Melting, DensityJumpWithMovingLiquid)
    {
      // Independent figures at n = 80 and 160 with n steps; none are known of 2.
      struct Known
      {
        double ratio, coarse, fine;
      };
      for(const auto &[ratio, coarse, fine] : {Known{0.5, 2.2e-4, 5.4e-5},
                                               {0.9, 7.8e-5, 2e-5},
                                               {1.04, 5.8e-5, 1.5e-5},
                                               {1.1, 5.1e-5, 1.3e-5},
                                               {1.5, 2e-5, 5.1e-6},
                                               {2, 2e-5, 5e-6}})
      {
        MeltingRun run;
        run.material = bar_material(2, 110, ratio);
        run.exact = neumann_with_open_wall(run.material);
        const std::vector<MeltingResult> results = joint_refinement(run, 1, 80);
        EXPECT_GE(fitted_order(front_errors(results)), 1.8) << ratio;
        EXPECT_LE(std::abs(results[0].front_error), 2 * coarse) << ratio;
        EXPECT_LE(std::abs(results[1].front_error), 2 * fine) << ratio;
        RecordProperty("density_ratio_" + std::to_string(ratio),
                       std::to_string(results[3].front_error * 1e6) + "e-6");
      }
    }

    TEST(Melting, DensityJumpWithASolidThatIsPushed)
    {
      for(const double ratio : {0.5, 1.1, 2.})
      {
        MeltingRun run;
        run.material = bar_material(2, 110, ratio);
        run.exact = neumann(run.material);
        run.displaced = Displaced::solid;
        const std::vector<MeltingResult> results = joint_refinement(run, 1, 80);
        EXPECT_GE(fitted_order(front_errors(results)), 1.8) << ratio;
        EXPECT_LE(std::abs(results[1].front_error), 4e-5) << ratio;
      }
    }

    TEST(Melting, NodesNearTheFrontDoNoHarm)
    {
      // From none absorbed to all nearer than half a spacing.
      for(const double interpolation_distance : {0., 0.05, 0.1, 0.25, 0.5})
      {
        MeltingRun run = standard_run();
        run.n = 80;
        run.steps = 80;
        run.interpolation_distance = interpolation_distance;
        EXPECT_LE(std::abs(melt(run).front_error), 1.3e-4) << interpolation_distance;
      }
    }

    TEST(Melting, StefanNumbersAndConductivityRatios)
    {
      for(const double ratio : {1., 1e3})
        for(const double stefan : {0.01, 0.1, 1., 10.})
        {
          MeltingRun run;
          run.material = bar_material(ratio, 70 / stefan);
          run.exact = neumann(run.material);
          run.n = 80;
          run.steps = 80;
          EXPECT_LE(std::abs(melt(run).front_error), 3.2e-4) << ratio << ' ' << stefan;
          run.time_order = 1;
          EXPECT_LE(std::abs(melt(run).front_error), 1.6e-3) << ratio << ' ' << stefan;
        }
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
