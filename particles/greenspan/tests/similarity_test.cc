#include <cases/error.h>
#include <cases/exact/planar_neumann.h>
#include <particles/greenspan/bar/similarity.h>
#include <particles/greenspan/calibration/calibration.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    Substance constant_substance(double density)
    {
      Substance substance;
      substance.melting_temperature = 45;
      substance.latent_heat = 29;
      substance.solid = {{density, 0}, {110, 0}, {2.5, 0}};
      substance.liquid = {{density, 0}, {20, 0}, {4.3, 0}};
      return substance;
    }

    /** Oracle: Neumann's solution, whose front is 2 lambda sqrt(a t). */
    double neumann_slope(const Substance &substance, double wall, double initial)
    {
      const auto phase = [](const ContinuumPhase &phase)
      {
        return cases::PhaseProperties{phase.conductivity.at_melting,
                                      phase.heat_capacity.at_melting,
                                      phase.density.at_melting};
      };
      cases::Material material;
      material.solid = phase(substance.solid);
      material.liquid = phase(substance.liquid);
      material.latent_heat = substance.latent_heat;
      material.melting_temperature = substance.melting_temperature;
      const cases::PlanarNeumann exact(material, wall, initial);
      const double mass = substance.liquid.density.at_melting * exact.front(1);
      return mass * mass;
    }

    TEST(GreenspanSimilarity, IsNeumannsSolutionWherePropertiesAreConstant)
    {
      for(const double density : {1., 0.85})
        for(const double initial : {30., 42., 45.})
        {
          const Substance substance = constant_substance(density);
          const double exact = neumann_slope(substance, 60, initial);
          EXPECT_NEAR(melt_half_space(substance, 60, initial).slope, exact, 2e-5 * exact)
              << density << " " << initial;
        }
    }

    /** In the mass coordinate only density times conductivity counts. */
    TEST(GreenspanSimilarity, ExpansionDropsOut)
    {
      const Substance one = constant_substance(1);
      Substance other = one;
      other.liquid.density.at_melting = 0.5;
      other.liquid.conductivity.at_melting *= 2;
      EXPECT_NEAR(melt_half_space(other, 60, 42).slope,
                  melt_half_space(one, 60, 42).slope, 1e-12);
    }

    // What has flowed through the wall is in the profile: 2 q sqrt(t) = sqrt(t) times the
    // integral of the enthalpy over eta.
    TEST(GreenspanSimilarity, HeatIsBalancedWherePropertiesDependOnTemperature)
    {
      Substance substance = constant_substance(0.9);
      substance.liquid = {{0.86, -0.008}, {20, 0.3}, {4.2, 0.03}};
      substance.solid = {{0.92, -0.002}, {110, -1.5}, {2.5, 0.02}};
      const double wall = 60, initial = 40;
      const SimilaritySolution solution = melt_half_space(substance, wall, initial);
      const double front = std::sqrt(solution.slope);
      const auto enthalpy = [&](double t, bool molten)
      {
        const auto stored = [](const LinearProperty &c, double from, double to)
        { return c.at_melting * (to - from) + c.slope * (to * to - from * from) / 2; };
        const double excess = t - substance.melting_temperature;
        const double cold = initial - substance.melting_temperature;
        return molten ? stored(substance.solid.heat_capacity, cold, 0)
                            + substance.latent_heat
                            + stored(substance.liquid.heat_capacity, 0, excess)
                      : stored(substance.solid.heat_capacity, cold, excess);
      };
      double heat = 0;
      const auto &eta = solution.coordinate;
      for(std::size_t k = 1; k < eta.size(); ++k)
      {
        const bool molten = (eta[k - 1] + eta[k]) / 2 < front;
        heat += (eta[k] - eta[k - 1])
                * (enthalpy(solution.temperature[k - 1], molten)
                   + enthalpy(solution.temperature[k], molten))
                / 2;
      }
      // One-sided difference of third order at the wall.
      const auto &t = solution.temperature;
      const double h = eta[1] - eta[0];
      const double gradient = (-11 * t[0] + 18 * t[1] - 9 * t[2] + 2 * t[3]) / (6 * h);
      const double flux
          = -substance.liquid.mass_conductivity(wall - substance.melting_temperature)
            * gradient;
      EXPECT_NEAR(2 * flux, heat, 1e-5 * heat);
    }

    TEST(GreenspanSimilarity, BadInputIsRefused)
    {
      const Substance substance = constant_substance(1);
      EXPECT_THROW(melt_half_space(substance, 44, 40), cases::InputError);
      EXPECT_THROW(melt_half_space(substance, 60, 46), cases::InputError);
      Substance vanishing = substance;
      vanishing.liquid.conductivity.slope = -2;
      EXPECT_THROW(melt_half_space(vanishing, 60, 40), cases::InputError);
      Substance cold = substance;
      cold.latent_heat = -1;
      EXPECT_THROW(melt_half_space(cold, 60, 40), cases::InputError);
    }

    TEST(GreenspanSimilarity, PolynomialsAndMeans)
    {
      const auto fit = fit_polynomial({-1, 0, 2, 3}, {3, 1, 9, 19}, 2);
      EXPECT_NEAR(fit[0], 1, 1e-13);
      EXPECT_NEAR(fit[1], 0, 1e-13);
      EXPECT_NEAR(fit[2], 2, 1e-13);
      EXPECT_THROW(fit_polynomial({1, 2}, {1, 2}, 2), cases::InputError);
      const Measured mean = measured({1, 2, 3, 6});
      EXPECT_DOUBLE_EQ(mean.value, 3);
      EXPECT_NEAR(mean.error, std::sqrt(14. / 3 / 4), 1e-14);
    }
  } // namespace
} // namespace meltfront::particles::greenspan
