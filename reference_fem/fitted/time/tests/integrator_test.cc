#include <reference_fem/fitted/time/integrator.h>
#include <reference_fem/fitted/time/tests/toy_problems.h>

#include <gtest/gtest.h>

#include <vector>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    IntegrationOptions options_of(const Scheme scheme,
                                  const unsigned int exact_size = 400)
    {
      IntegrationOptions options;
      options.scheme = scheme;
      options.largest_exact_size = exact_size;
      return options;
    }

    double error_after(const FiveRows &problem, const Scheme scheme, const int n_steps,
                       const unsigned int exact_size = 400)
    {
      Integrator integrator(problem, options_of(scheme, exact_size));
      integrator.start(0, problem.exact(0));
      double worst = 0;
      EXPECT_TRUE(integrator.advance_to(1, 1. / n_steps,
                                        [&](const AcceptedStep &step)
                                        {
                                          // Of the second half: at one time errors may
                                          // happen to cancel.
                                          dealii::Vector<double> error = step.u;
                                          error -= problem.exact(step.clock);
                                          if(step.clock >= 0.5)
                                            worst = std::max(worst, error.linfty_norm());
                                          return true;
                                        }));
      EXPECT_EQ(integrator.cost().steps, n_steps);
      return worst;
    }

    double fitted_order(const std::vector<int> &n, const std::vector<double> &errors)
    {
      double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
      for(std::size_t i = 0; i < n.size(); ++i)
      {
        mean_x += std::log(n[i]) / n.size();
        mean_y += std::log(errors[i]) / n.size();
      }
      for(std::size_t i = 0; i < n.size(); ++i)
      {
        xy += (std::log(n[i]) - mean_x) * (std::log(errors[i]) - mean_y);
        xx += (std::log(n[i]) - mean_x) * (std::log(n[i]) - mean_x);
      }
      return -xy / xx;
    }

    struct Expected
    {
      Scheme scheme;
      double order;
      int n_coarsest;
    };

    class Order : public testing::TestWithParam<Expected>
    {
    };

    TEST_P(Order, IsThatOfTheScheme)
    {
      const FiveRows problem(2);
      std::vector<int> n;
      std::vector<double> errors;
      for(int level = 0; level < 4; ++level)
      {
        n.push_back(GetParam().n_coarsest << level);
        errors.push_back(error_after(problem, GetParam().scheme, n.back()));
        RecordProperty("error_" + std::to_string(n.back()),
                       std::to_string(errors.back()));
      }
      EXPECT_NEAR(fitted_order(n, errors), GetParam().order, 0.2)
          << errors[0] << " " << errors[1] << " " << errors[2] << " " << errors[3];
    }

    INSTANTIATE_TEST_SUITE_P(Schemes, Order,
                             testing::Values(Expected{Scheme::bdf2, 2, 80},
                                             Expected{Scheme::bdf3, 3, 40},
                                             Expected{Scheme::bdf4, 4, 40},
                                             Expected{Scheme::radau3, 3, 20},
                                             Expected{Scheme::radau5, 5, 6}));

    class EveryScheme : public testing::TestWithParam<Scheme>
    {
    };

    TEST_P(EveryScheme, KeepsALinearInvariantAndConstraints)
    {
      const FiveRows problem(20);
      for(const unsigned int exact_size : {400u, 0u})
      {
        Integrator integrator(problem, options_of(GetParam(), exact_size));
        integrator.start(0, problem.exact(0));
        double drift = 0, defect = 0;
        integrator.advance_to(
            1, 0.02,
            [&](const AcceptedStep &step)
            {
              drift = std::max(drift, std::abs(step.u[3] * step.u[1] - 1));
              defect = std::max(defect,
                                std::abs(step.u[2] - step.u[0] * step.u[1] * step.u[1]));
              return true;
            });
        EXPECT_LE(drift, 1e-13);
        EXPECT_LE(defect, 1e-13);
      }
    }

    TEST_P(EveryScheme, IsAccurateWhereStiffnessWouldStopExplicitSchemes)
    {
      EXPECT_LE(error_after(FiveRows(1e8), GetParam(), 50), 1e-3);
    }

    TEST_P(EveryScheme, SolvesTheSameEquationsWithFrozenJacobians)
    {
      const Conduction problem(61);
      dealii::Vector<double> initial(problem.size()), states[2];
      initial = 1.;
      for(const bool exact : {false, true})
      {
        Integrator integrator(problem, options_of(GetParam(), exact ? 400 : 0));
        integrator.start(0, initial);
        integrator.advance_to(0.5, 0.00625);
        states[exact] = integrator.state();
        // The source is switched on in the first step.
        EXPECT_LE(integrator.cost().most_iterations, 7) << exact;
        EXPECT_LE(integrator.cost().iterations, 6 * integrator.cost().steps) << exact;
        if(!exact)
        {
          // Steps this short are easy enough for factors to be kept.
          EXPECT_LT(integrator.cost().factorisations, integrator.cost().steps);
        }
      }
      states[0] -= states[1];
      EXPECT_LE(states[0].linfty_norm(), 1e-12);
    }

    TEST_P(EveryScheme, GoesOnAfterAStopAsIfThereHadBeenNone)
    {
      const FiveRows problem(2);
      Integrator whole(problem, options_of(GetParam())),
          parts(problem, options_of(GetParam()));
      whole.start(0, problem.exact(0));
      parts.start(0, problem.exact(0));
      whole.advance_to(1, 0.0625);
      EXPECT_FALSE(parts.advance_to(
          1, 0.0625, [](const AcceptedStep &step) { return step.number < 8; }));
      EXPECT_EQ(parts.clock(), 0.5);
      EXPECT_TRUE(parts.advance_to(1, 0.0625));
      EXPECT_EQ(parts.clock(), 1.);
      for(unsigned int i = 0; i < problem.size(); ++i)
        EXPECT_NEAR(parts.state()[i], whole.state()[i], 1e-13);
    }

    INSTANTIATE_TEST_SUITE_P(Schemes, EveryScheme,
                             testing::Values(Scheme::bdf2, Scheme::bdf3, Scheme::bdf4,
                                             Scheme::radau3, Scheme::radau5));

    TEST(StepControl, MeetsItsToleranceWithShortStepsOnlyWhereTheyAreNeeded)
    {
      FiveRows problem(1);
      problem.g = [](double t) { return std::tanh(40 * (t - 0.5)); };
      problem.g_rate
          = [](double t) { return 40 / std::pow(std::cosh(40 * (t - 0.5)), 2); };
      for(const Scheme scheme : {Scheme::radau3, Scheme::radau5})
        for(const double tolerance : {1e-5, 1e-7, 1e-9})
        {
          IntegrationOptions options = options_of(scheme);
          options.tolerance = tolerance;
          Integrator integrator(problem, options);
          integrator.start(0, problem.exact(0));
          double shortest = 1, longest = 0, worst = 0;
          ASSERT_TRUE(integrator.advance_to(1, 1e-3,
                                            [&](const AcceptedStep &step)
                                            {
                                              shortest = std::min(shortest, step.size);
                                              longest = std::max(longest, step.size);
                                              dealii::Vector<double> error = step.u;
                                              error -= problem.exact(step.clock);
                                              worst
                                                  = std::max(worst, error.linfty_norm());
                                              return true;
                                            }));
          EXPECT_EQ(integrator.clock(), 1.);
          EXPECT_LE(worst, 20 * tolerance);
          EXPECT_GE(longest, 10 * shortest);
          EXPECT_GT(integrator.proposed_step(), 0.);
        }
    }

    TEST(StepControl, ForgivesAFirstStepThatIsFarTooLong)
    {
      const FiveRows problem(100);
      IntegrationOptions options;
      options.tolerance = 1e-8;
      Integrator integrator(problem, options);
      integrator.start(0, problem.exact(0));
      integrator.advance_to(1, 1);
      EXPECT_GT(integrator.cost().repeated, 0);
      dealii::Vector<double> error = integrator.state();
      error -= problem.exact(1);
      EXPECT_LE(error.linfty_norm(), 1e-7);
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted
