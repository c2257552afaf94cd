#include <particles/alloy/solute_diffusion.h>
#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/table.h>
#include <particles/sph_mixture/mixture_conduction.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    /** A square of brine between -16.5 and 14.7 degrees, whose salt diffuses. */
    cases::Scene brine()
    {
      cases::Scene scene;
      scene.domain.shape = cases::DomainShape::box;
      scene.domain.dimension = 2;
      scene.domain.upper = {0.5, 0.5, 0};
      for(auto &boundary : scene.boundaries)
        boundary = cases::Boundary{};
      scene.boundaries[0] = cases::Boundary{cases::BoundaryKind::fixed_temperature,
                                            cases::Field::uniform(-16.5), false};
      scene.material.solid = {2.408, 2006, 1097};
      scene.material.liquid = {0.498, 4180, 1097};
      scene.material.latent_heat = 334400;
      scene.alloy = cases::Alloy{};
      cases::Solute salt;
      salt.name = "salt";
      salt.liquidus_slope = 42.28;
      salt.diffusivity = 6.2e-10;
      scene.alloy->solutes.push_back(salt);
      scene.alloy->crystal_density = 917;
      scene.initial.temperature = cases::Field::uniform(14.7);
      scene.initial.concentration = {cases::Field::uniform(0.14)};
      scene.end_time = 1;
      return scene;
    }

    cases::Resolution resolution_of(int n)
    {
      cases::Resolution resolution;
      resolution.n = n;
      resolution.options = cases::Options(cases::options_of(MixtureParameters()));
      return resolution;
    }

    /** Particles of it, half of them mush, and what flows between them. */
    struct Brine
    {
      Brine(int n, MeanConductivity mean)
        : scene(brine())
        , substance(scene, "benchmark")
        , parameters(resolve_mixture_parameters(scene, resolution_of(n)))
        , dis(scene, parameters.sph)
        , rows(dis, true)
        , heat(rows.rows.padded_rows())
        , solute(heat.size())
        , conduction(substance, mean, false, dis.particles.size(), heat.size())
        , diffusion(dis, parameters.sph, substance, rows.rows)
      {
        std::vector<double> enthalpy(heat.size(), 0.), content(heat.size(), 0.);
        for(std::size_t a = 0; a < dis.particles.size(); ++a)
        {
          const double x = dis.particles.position[0][a];
          enthalpy[a] = 100000 + 560000 * x;
          content[a] = 0.14 + 0.02 * std::sin(40 * x);
        }
        const std::vector<std::span<const double>> composition{content};
        conduction.follow(enthalpy, composition, 1);
        diffusion.follow(conduction.liquid_fraction(), conduction.depressions(),
                         composition);
      }

      PassSize size(int fields) const
      {
        PassSize size;
        size.particles = static_cast<double>(dis.particles.size());
        size.items = static_cast<double>(fields * rows.rows.interactions());
        return size;
      }

      cases::Scene scene;
      AlloySubstance substance;
      MixtureParameters parameters;
      Discretisation dis;
      ConductionRows rows;
      std::vector<double> heat, solute;
      MixtureConduction conduction;
      SoluteDiffusion diffusion;
    };

    void one_after_the_other(benchmark::State &state, int n, MeanConductivity mean)
    {
      Brine brine(n, mean);
      for(auto _ : state)
      {
        brine.conduction.conduct(brine.rows.rows, brine.heat, 1);
        brine.diffusion.flow(0, brine.rows.rows, brine.solute, 1);
        benchmark::ClobberMemory();
      }
      set_size(state, brine.size(2), "interaction");
    }

    void together(benchmark::State &state, int n, MeanConductivity mean)
    {
      Brine brine(n, mean);
      for(auto _ : state)
      {
        brine.conduction.with_pair(
            [&](const auto &pair)
            {
              brine.diffusion.flow_with_heat(pair, brine.heat, 0, brine.rows.rows,
                                             brine.solute, 1);
            });
        benchmark::ClobberMemory();
      }
      set_size(state, brine.size(2), "interaction");
    }
  } // namespace

  void register_mixture_benchmarks()
  {
    for(const auto &[form, mean] :
        {std::pair{"integral", MeanConductivity::integral},
         std::pair{"arithmetic", MeanConductivity::arithmetic}})
      for(const auto &[name, n] : {std::pair{"small", 40}, std::pair{"2D", 160}})
      {
        const auto add = [&](const char *what, const auto &body)
        {
          benchmark::RegisterBenchmark(
              fmt::format("{}, {}, {}", what, form, name).c_str(),
              [body, n = n, mean = mean](benchmark::State &state)
              { body(state, n, mean); })
              ->UseRealTime();
        };
        add("mixture, heat then solute", one_after_the_other);
        add("mixture, heat with solute", together);
      }
  }
} // namespace meltfront::particles::benchmarks
