#include <cases/error.h>
#include <verification/measure/formulas/order_fit.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    const std::vector<double> halving{1. / 20, 1. / 40, 1. / 80, 1. / 160, 1. / 320};

    std::vector<double> errors_of_order(double order, double factor,
                                        std::vector<double> disturbance = {})
    {
      std::vector<double> errors;
      for(std::size_t i = 0; i < halving.size(); ++i)
        errors.push_back(factor * std::pow(halving[i], order)
                         * (disturbance.empty() ? 1 : disturbance[i]));
      return errors;
    }

    TEST(OrderFit, FindsTheExponentOfACleanSequence)
    {
      const OrderFit fit = fit_order(halving, errors_of_order(1.5, 0.3));
      EXPECT_NEAR(fit.order, 1.5, 1e-12);
      EXPECT_NEAR(fit.factor, 0.3, 1e-12);
      EXPECT_LT(fit.standard_error, 1e-12);
      EXPECT_EQ(fit.levels, 5);
      EXPECT_EQ(fit.verdict, OrderVerdict::clean);
      EXPECT_EQ(fit.text(), "h^1.50 +- 0.00");
      ASSERT_EQ(fit.pairwise.size(), 4u);
      for(const double rate : fit.pairwise)
        EXPECT_NEAR(rate, 1.5, 1e-12);
    }

    // An order that carried the refinement ratio into the logarithm would read 2 here.
    TEST(OrderFit, DoesNotDependOnTheRefinementRatioOrTheUnit)
    {
      std::vector<double> h, errors;
      for(const int n : {20, 30, 40, 50, 80})
      {
        h.push_back(1000. / n);
        errors.push_back(7e-3 * std::pow(1. / n, 1));
      }
      EXPECT_NEAR(fit_order(h, errors).order, 1, 1e-12);
    }

    // Monaghan, Huppert and Worster 2005, Table 1 against N, where the text says 1.7.
    TEST(OrderFit, FitsThePrintedTableOfThePaper)
    {
      const std::vector<double> h{1. / 20, 1. / 30, 1. / 40, 1. / 50};
      EXPECT_NEAR(fit_order(h, std::vector{0.01063, 0.00544, 0.00370, 0.00275}).order,
                  1.47, 5e-3);
      EXPECT_NEAR(fit_order(h, std::vector{0.0167, 0.00840, 0.00548, 0.00407}).order,
                  1.55, 5e-3);
    }

    TEST(OrderFit, GivesTheStandardErrorOfANoisySequence)
    {
      const std::vector<double> noise{1.05, 0.95, 1.05, 0.95, 1.05};
      const OrderFit fit = fit_order(halving, errors_of_order(1.5, 0.3, noise));
      EXPECT_NEAR(fit.order, 1.5, 0.03);
      EXPECT_EQ(fit.verdict, OrderVerdict::clean);
      // The noise is symmetric about the middle, so the slope is untouched and the
      // residuals are the noise about its mean.
      const double a = std::log(1.05), b = std::log(0.95), mean = (3 * a + 2 * b) / 5;
      const double squares = 3 * (a - mean) * (a - mean) + 2 * (b - mean) * (b - mean);
      EXPECT_NEAR(fit.standard_error, std::sqrt(squares / 3 / 10) / std::log(2.), 1e-12);
      // Table of Student's t: 3.182 for three degrees of freedom, 4.303 for two.
      EXPECT_NEAR(fit.confidence / fit.standard_error, 3.182, 5e-4);
      const std::vector<double> errors = errors_of_order(1.5, 0.3, noise);
      const OrderFit four
          = fit_order(std::span(halving).first(4), std::span(errors).first(4));
      EXPECT_NEAR(four.confidence / four.standard_error, 4.303, 5e-4);
      EXPECT_EQ(four.text(),
                fmt::format("h^{:.2f} +- {:.2f}", four.order, four.confidence));
    }

    TEST(OrderFit, TakesTheGeometricMeanOfSeeds)
    {
      const std::vector<double> h{0.1, 0.1, 0.05, 0.05, 0.025, 0.025, 0.0125, 0.0125};
      std::vector<double> errors;
      for(const double one : {1., 0.25, 0.0625, 0.015625})
      {
        errors.push_back(100 * one);
        errors.push_back(one / 100);
      }
      EXPECT_NEAR(fit_order(h, errors).order, 2, 1e-12);
      EXPECT_NEAR(fit_order(h, errors).factor, 100, 1e-9);
    }

    TEST(OrderFit, SaysThatASequenceStagnates)
    {
      std::vector<double> errors = errors_of_order(2, 1);
      for(double &error : errors)
        error += 1e-3;
      const OrderFit fit = fit_order(halving, errors);
      EXPECT_EQ(fit.verdict, OrderVerdict::stagnating);
      EXPECT_NE(fit.text().find("(stagnating)"), std::string::npos);
      EXPECT_EQ(fit_order(halving, std::vector(5, 0.1)).verdict,
                OrderVerdict::stagnating);
    }

    TEST(OrderFit, SaysThatASequenceOscillates)
    {
      // Pairwise rates from -3.9 to 6.5 about first order, as on a fixed grid.
      const OrderFit fit
          = fit_order(halving, errors_of_order(1, 1, {1, 0.02, 0.6, 0.013, 0.7}));
      EXPECT_EQ(fit.verdict, OrderVerdict::oscillating);
      EXPECT_GT(fit.standard_error, 0.3);
      // A staircase falls everywhere and still has no rate from pair to pair.
      EXPECT_EQ(fit_order(halving, std::vector{1., 0.9, 0.2, 0.18, 0.04}).verdict,
                OrderVerdict::oscillating);
    }

    TEST(OrderFit, RatesThatRiseDoNotOscillate)
    {
      EXPECT_EQ(fit_order(halving, std::vector{1., 0.3, 0.05, 4e-3, 2e-4}, 8).verdict,
                OrderVerdict::clean);
      EXPECT_EQ(fit_order(halving, std::vector{1., 0.05, 0.04, 1e-3, 2e-4}, 8).verdict,
                OrderVerdict::oscillating);
    }

    TEST(OrderFit, SaysThatASequenceDivergesOrIsTooFast)
    {
      EXPECT_EQ(fit_order(halving, errors_of_order(-1, 1)).verdict,
                OrderVerdict::diverging);
      EXPECT_EQ(fit_order(halving, errors_of_order(4, 1)).verdict,
                OrderVerdict::suspiciously_fast);
      EXPECT_EQ(fit_order(halving, errors_of_order(4, 1), 5).verdict,
                OrderVerdict::clean);
    }

    TEST(OrderFit, HasNoOrderForValuesThatAreNotFinite)
    {
      for(const double bad :
          {std::nan(""), std::numeric_limits<double>::infinity(), -1e-3})
      {
        std::vector<double> errors = errors_of_order(1, 1);
        errors[2] = bad;
        const OrderFit fit = fit_order(halving, errors);
        EXPECT_TRUE(std::isnan(fit.order));
        EXPECT_EQ(fit.verdict, OrderVerdict::not_finite);
        EXPECT_EQ(fit.text(), "none (contains NaN)");
      }
    }

    // A study whose end time equals its start time compares the initial state with
    // itself.
    TEST(OrderFit, HasNoOrderWhereNothingWasMeasured)
    {
      const OrderFit fit = fit_order(halving, std::vector(5, 0.));
      EXPECT_TRUE(std::isnan(fit.order));
      EXPECT_EQ(fit.verdict, OrderVerdict::zero_error);
      EXPECT_EQ(fit.text(), "none (zero error)");
    }

    TEST(OrderFit, WantsFourDifferentLevels)
    {
      const std::vector<double> errors = errors_of_order(1, 1);
      for(const int levels : {1, 2, 3})
      {
        const OrderFit fit = fit_order(std::span(halving).first(levels),
                                       std::span(errors).first(levels));
        EXPECT_EQ(fit.verdict, OrderVerdict::too_few_levels);
        EXPECT_EQ(std::isnan(fit.order), levels < 2);
        EXPECT_EQ(std::isnan(fit.standard_error), levels < 3);
      }
      const std::vector<double> same_h{0.1, 0.1, 0.1, 0.05};
      EXPECT_EQ(fit_order(same_h, std::vector{1., 1., 1., 0.5}).verdict,
                OrderVerdict::too_few_levels);
      EXPECT_EQ(fit_order({}, {}).text(), "none (too few levels)");
      EXPECT_THROW(fit_order(halving, std::vector(2, 1.)), cases::InputError);
    }

    TEST(OrderFit, DoesNotDependOnTheOrderOfItsInput)
    {
      const std::vector<double> h{1. / 80, 1. / 20, 1. / 160, 1. / 40};
      const std::vector<double> errors{2e-3, 9e-3, 1.1e-3, 5e-3};
      const std::vector<double> sorted_h{1. / 20, 1. / 40, 1. / 80, 1. / 160};
      const std::vector<double> sorted_errors{9e-3, 5e-3, 2e-3, 1.1e-3};
      EXPECT_EQ(fit_order(h, errors).order, fit_order(sorted_h, sorted_errors).order);
    }

    TEST(OrderFit, LeavesOutLevelsAtRoundOffAndSaysSo)
    {
      std::vector<double> h, errors;
      for(int level = 0; level < 8; ++level)
      {
        h.push_back(std::pow(2., -level));
        errors.push_back(std::max(std::pow(h.back(), 8), 3e-14));
      }
      EXPECT_NE(fit_order(h, errors, 8.5).verdict, OrderVerdict::clean);
      const OrderFit fit = fit_order(h, errors, 8.5, 1e-13);
      EXPECT_NEAR(fit.order, 8, 1e-12);
      EXPECT_EQ(fit.verdict, OrderVerdict::clean);
      EXPECT_EQ(fit.levels, 6);
      EXPECT_EQ(fit.left_out, 2);
      EXPECT_EQ(fit.text("dt"), "dt^8.00 +- 0.00 (2 levels at round-off left out)");
      const OrderFit few
          = fit_order(std::span(h).last(5), std::span(errors).last(5), 8.5, 1e-13);
      EXPECT_EQ(few.verdict, OrderVerdict::too_few_levels);
      EXPECT_EQ(few.remarks(), "too few levels; 2 levels at round-off left out");
    }

    TEST(OrderFit, TakesAZeroForRoundOffOnlyOnTheFinestLevels)
    {
      const std::vector<double> h{1, 0.5, 0.25, 0.125, 0.0625};
      const std::vector<double> fine{1e-2, 1e-3, 1e-4, 1e-5, 0};
      const std::vector<double> middle{1e-2, 1e-3, 0, 1e-5, 1e-6};
      const std::vector<double> nothing(5, 0.);
      EXPECT_EQ(fit_order(h, fine, 4, 1e-13).left_out, 1);
      EXPECT_EQ(fit_order(h, fine, 4, 1e-13).verdict, OrderVerdict::clean);
      EXPECT_EQ(fit_order(h, fine, 4).verdict, OrderVerdict::zero_error);
      EXPECT_EQ(fit_order(h, middle, 4, 1e-13).verdict, OrderVerdict::zero_error);
      EXPECT_EQ(fit_order(h, nothing, 4, 1e-13).verdict, OrderVerdict::zero_error);
    }
  } // namespace
} // namespace meltfront::verification
