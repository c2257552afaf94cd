#include <particles/alloy/tests/alloy_scenes.h>
#include <particles/sph_mixture/mixture_flow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    using cases::Scene;

    struct Kind
    {
      const char *conductivity;
      double eutectic;
      bool curved, one_conductivity, uniform;
    };

    constexpr double no_eutectic = -std::numeric_limits<double>::infinity();
    constexpr Kind kinds[] = {{"integral", no_eutectic, false, false, false},
                              {"integral", -17.7, false, false, false},
                              {"integral", -17.7, false, false, true},
                              {"integral", -17.7, false, true, false},
                              {"arithmetic", -17.7, false, false, false},
                              {"harmonic", no_eutectic, false, false, false},
                              {"arithmetic", -17.7, true, false, false}};

    Scene scene_of(const Kind &kind)
    {
      Scene scene = nitrate_slab(1000);
      cases::Solute &salt = scene.alloy->solutes[0];
      scene.alloy->eutectic_temperature = kind.eutectic;
      if(kind.one_conductivity)
        scene.material.solid.conductivity = scene.material.liquid.conductivity;
      if(kind.curved)
      {
        salt.liquidus_slope = 0;
        salt.liquidus_curve = cases::liquidus_through(
            {{0, 0}, {0.1, -4}, {0.2, -9}, {0.3, -13}, {0.5, -22}}, 0);
        salt.largest_concentration = 0.5;
      }
      return scene;
    }

    // Products with the derivative against differences of the flows, at states that mix
    // solid, mush and liquid particles away from the kinks.
    TEST(MixtureDerivative, TheDerivativeOfTheFlows)
    {
      for(const cases::BoundaryKind wall :
          {cases::BoundaryKind::fixed_temperature, cases::BoundaryKind::heat_transfer,
           cases::BoundaryKind::radiation})
        for(const Kind &kind : kinds)
        {
          Scene scene = scene_of(kind);
          cases::Boundary &cold = *scene.boundaries[0];
          cold.kind = wall;
          cold.heat_transfer_coefficient = 300;
          cold.emission_coefficient = 4e-6;
          cold.absolute_zero = -273.15;
          const AlloySubstance substance(scene, "test");
          cases::Resolution resolution;
          resolution.n = 40;
          resolution.options = cases::Options(cases::options_of(MixtureParameters()));
          resolution.options.set("conductivity", kind.conductivity);
          const MixtureParameters parameters
              = resolve_mixture_parameters(scene, resolution);
          const Discretisation dis(scene, parameters.sph);
          MixtureFlow flows(dis, substance, cases::effects_called_for(scene), parameters,
                            kind.uniform);
          flows.prepare_step(10, 20);
          const std::size_t n = dis.particles.size(), size = flows.padded_size();
          std::mt19937_64 random(5);
          std::uniform_real_distribution<double> of_enthalpy(-60000, 420000),
              of_content(0.02, 0.3), of_change(-1000, 1000);
          std::vector<double> start(size, 0.), change(size, 0.), content(size, 0.14),
              state, low(size), high(size), product(size);
          for(std::size_t a = 0; a < n; ++a)
          {
            start[a] = of_enthalpy(random);
            change[a] = of_change(random);
            if(!kind.uniform)
              content[a] = of_content(random);
          }
          const std::vector<std::span<const double>> composition{content};
          const auto flow = [&](double along, std::vector<double> &result)
          {
            state = start;
            for(std::size_t a = 0; a < n; ++a)
              state[a] += along * change[a];
            flows.follow({std::span(state).first(n), composition});
            flows.heat(1, result);
          };
          constexpr double step = 1e-3;
          flow(step, high);
          flow(-step, low);
          flow(0, product);
          flows.linearise(1, {std::span(state).first(n), composition});
          flows.apply_derivative(change, product);
          double largest = 0;
          for(std::size_t a = 0; a < n; ++a)
            largest = std::max(largest, std::abs(product[a]));
          ASSERT_GT(largest, 0);
          for(std::size_t a = 0; a < n; ++a)
            EXPECT_NEAR(product[a], (high[a] - low[a]) / (2 * step), 1e-5 * largest)
                << kind.conductivity << " " << kind.eutectic << " " << a;
          for(const std::size_t a : {std::size_t(0), n / 3, n - 1})
          {
            std::vector<double> unit(size, 0.);
            unit[a] = 1;
            flows.apply_derivative(unit, product);
            EXPECT_NEAR(product[a], flows.derivative_diagonal()[a],
                        1e-12 * std::abs(product[a]));
          }
        }
    }

    // Kinks lie where the phase diagram changes its slope.
    TEST(MixtureDerivative, BranchesAreThoseOfThePhaseDiagram)
    {
      for(const Kind &kind : kinds)
      {
        const AlloySubstance substance(scene_of(kind), "test");
        for(const double content : {0., 0.02, 0.14, 0.3, 0.45})
        {
          const EquilibriumBranches branches = find_branches(substance, content, 0);
          for(double h = -60000; h < 420000; h += 1234.5)
          {
            const auto at = [&](double enthalpy)
            { return substance.diagram.equilibrium(enthalpy, content); };
            const cases::PhaseState state = at(h);
            const EquilibriumSlopes slopes
                = find_slopes(substance, branches, h, state.temperature,
                              state.liquid_fraction, content);
            const double step = 0.5;
            bool near_kink = false;
            for(const double kink : {branches.solid, branches.eutectic, branches.liquid})
              near_kink = near_kink || std::abs(h - kink) < 2 * step;
            if(near_kink)
              continue;
            const cases::PhaseState above = at(h + step), below = at(h - step);
            EXPECT_NEAR(slopes.temperature,
                        (above.temperature - below.temperature) / (2 * step), 2e-8)
                << content << " " << h;
            EXPECT_NEAR(slopes.liquid_fraction,
                        (above.liquid_fraction - below.liquid_fraction) / (2 * step),
                        2e-9)
                << content << " " << h;
          }
        }
      }
    }
  } // namespace
} // namespace meltfront::particles::testing
