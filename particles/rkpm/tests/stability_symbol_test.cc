#include <cases/error.h>
#include <particles/rkpm/stability_symbol.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::rkpm
{
  namespace
  {
    MomentSettings frozen(KernelShape kernel, int dimension, int order)
    {
      return {Variant::derivative_free, kernel, dimension, order};
    }

    struct Window
    {
      KernelShape kernel;
      double line;   ///< largest alpha in 1D, order 2, steps of 0.2
      double plane;  ///< in 2D, order 2, steps of 0.25
      double fourth; ///< in 2D, order 4, steps of 0.25
    };

    // Found by an independent program on the same steps of alpha. Its figures are those
    // of ratios that round to 0.05: four of them lie between 0.045 and 0.05, see below.
    constexpr double rounds_to_limit = 0.045;
    constexpr Window table[] = {{KernelShape::hat, 2.1, 1.75, 2.25},
                                {KernelShape::epanechnikov, 2.1, 1.5, 2.25},
                                {KernelShape::biweight, 2.3, 1.75, 2.25},
                                {KernelShape::cosine, 2.5, 2.0, 2.25},
                                {KernelShape::cubic_spline, 3.1, 2.5, 3.0},
                                {KernelShape::efg_quartic, 2.9, 2.25, 2.75},
                                {KernelShape::wendland_c2, 3.5, 2.5, 3.25},
                                {KernelShape::gaussian_3, 4.1, 3.0, 3.75},
                                {KernelShape::quintic_spline, 3.9, 3.0, 3.5},
                                {KernelShape::wendland_c4, 4.1, 3.0, 3.75},
                                {KernelShape::wendland_c6, 4.5, 3.25, 4.0}};

    TEST(StabilitySymbol, LargestAlphasOnALine)
    {
      for(const Window &row : table)
        EXPECT_NEAR(
            largest_stable_alpha(frozen(row.kernel, 1, 2), 1.1, 0.2, rounds_to_limit),
            row.line, 1e-9)
            << kernel_name(row.kernel);
    }

    TEST(StabilitySymbol, LargestAlphasInThePlane)
    {
      for(const Window &row : table)
        EXPECT_NEAR(
            largest_stable_alpha(frozen(row.kernel, 2, 2), 1.25, 0.25, rounds_to_limit),
            row.plane, 1e-9)
            << kernel_name(row.kernel);
    }

    TEST(StabilitySymbol, LargestAlphasInThePlaneOfFourthOrder)
    {
      for(const Window &row : table)
        EXPECT_NEAR(
            largest_stable_alpha(frozen(row.kernel, 2, 4), 2.25, 0.25, rounds_to_limit),
            row.fourth, 1e-9)
            << kernel_name(row.kernel);
    }

    TEST(StabilitySymbol, FourOfTheTableLieJustBelowTheLimit)
    {
      struct Marginal
      {
        KernelShape kernel;
        int dimension, order;
        double alpha, step;
      };
      const Marginal marginal[] = {{KernelShape::wendland_c4, 1, 2, 4.1, 0.2},
                                   {KernelShape::cubic_spline, 2, 2, 2.5, 0.25},
                                   {KernelShape::gaussian_3, 2, 4, 3.75, 0.25},
                                   {KernelShape::wendland_c4, 2, 4, 3.75, 0.25}};
      for(const Marginal &m : marginal)
      {
        const MomentSettings settings = frozen(m.kernel, m.dimension, m.order);
        EXPECT_GT(stability_ratio(settings, m.alpha), rounds_to_limit);
        EXPECT_LT(stability_ratio(settings, m.alpha), least_stable_ratio);
        EXPECT_GT(stability_ratio(settings, m.alpha - m.step), least_stable_ratio);
      }
      // Computed apart with 30 digits, at theta = pi.
      EXPECT_NEAR(stability_ratio(frozen(KernelShape::wendland_c4, 1, 2), 4.1),
                  0.045574578, 1e-9);
      EXPECT_NEAR(stability_ratio(frozen(KernelShape::wendland_c4, 1, 2), 3.9),
                  0.076914551, 1e-9);
    }

    // Three particles on a line make the 3-point formula, whatever the kernel.
    TEST(StabilitySymbol, ThreePointFormulaIsTheReference)
    {
      for(const KernelShape kernel : {KernelShape::hat, KernelShape::wendland_c6})
        EXPECT_NEAR(stability_ratio(frozen(kernel, 1, 2), 1.7), 1, 1e-9);
    }

    // Five nearly equal weights: S(theta) of (2, -1, -2, -1, 2)/7 vanishes at
    // cos theta = -3/4. A flat kernel comes close to it.
    TEST(StabilitySymbol, FlatKernelsHaveASpuriousMode)
    {
      EXPECT_LT(stability_ratio(frozen(KernelShape::epanechnikov, 1, 2), 2.9), 0);
      EXPECT_LT(stability_ratio(frozen(KernelShape::epanechnikov, 2, 2), 2.9), 0);
      EXPECT_GT(stability_ratio(frozen(KernelShape::wendland_c4, 1, 2), 2.9),
                least_stable_ratio);
    }

    TEST(StabilitySymbol, InSpaceTheWindowIsNarrower)
    {
      const double plane
          = largest_stable_alpha(frozen(KernelShape::wendland_c4, 2, 2), 1.5, 0.25);
      const double space
          = largest_stable_alpha(frozen(KernelShape::wendland_c4, 3, 2), 1.5, 0.25);
      EXPECT_GT(space, 1.5);
      EXPECT_LE(space, plane);
    }

    TEST(StabilitySymbol, FormsOfAFamilyShareTheirSymbol)
    {
      for(const double alpha : {2.5, 3.5})
      {
        MomentSettings settings{Variant::derivative_free, KernelShape::quintic_spline, 2,
                                2};
        const double free = stability_ratio(settings, alpha);
        settings.variant = Variant::fixed_point;
        EXPECT_NEAR(stability_ratio(settings, alpha), free, 1e-9);
        settings.variant = Variant::point_collocation;
        const double collocation = stability_ratio(settings, alpha);
        settings.variant = Variant::moving;
        EXPECT_NEAR(stability_ratio(settings, alpha), collocation, 1e-9);
        EXPECT_GT(std::abs(collocation - free), 1e-3);
      }
    }

    TEST(StabilitySymbol, VerdictNamesBothFigures)
    {
      const MomentSettings settings = frozen(KernelShape::hat, 2, 2);
      EXPECT_NO_THROW(require_stability(settings, 1.6));
      EXPECT_THROW(require_stability(settings, 3), cases::Refusal);
      EXPECT_THROW(require_stability(settings, 1.1), cases::Refusal); // too few
      EXPECT_THROW(stability_ratio(settings, -1), cases::InputError);
      const StabilityVerdict verdict = judge_stability(settings, 3);
      EXPECT_FALSE(verdict.safe);
      EXPECT_GT(verdict.largest_alpha, 1.5);
      EXPECT_NE(verdict.sentence.find("hat"), std::string::npos);
      EXPECT_NE(verdict.sentence.find(fmt::format("{:.3g}", verdict.ratio)),
                std::string::npos);
      EXPECT_NE(verdict.sentence.find(fmt::format("{:.4g}", verdict.largest_alpha)),
                std::string::npos);
    }
  } // namespace
} // namespace meltfront::particles::rkpm
