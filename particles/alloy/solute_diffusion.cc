#include <particles/alloy/solute_diffusion.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** The scene with walls that are closed to heat as they are to solute. */
    cases::Scene closed(const cases::Scene &scene)
    {
      cases::Scene result = scene;
      for(auto &boundary : result.boundaries)
        if(boundary && boundary->kind != cases::BoundaryKind::periodic)
          boundary = cases::Boundary();
      return result;
    }

    double largest_diffusivity(const cases::Alloy &alloy)
    {
      double largest = 0;
      for(const cases::Solute &solute : alloy.solutes)
        largest = std::max(largest, solute.diffusivity);
      return largest;
    }

    /** Concentration of a single solute in the liquid at the eutectic temperature. */
    double concentration_at_eutectic(const AlloySubstance &substance)
    {
      if(!std::isfinite(substance.eutectic_excess) || substance.n_solutes() != 1)
        return 1;
      const double sample = 1e-6;
      const double temperature = std::nextafter(substance.alloy.eutectic_temperature,
                                                substance.material.melting_temperature);
      return std::min(
          1., sample / (1 - substance.diagram.solid_fraction(temperature, sample)));
    }
  } // namespace

  SoluteDiffusion::SoluteDiffusion(const Discretisation &dis,
                                   const SphParameters &parameters,
                                   const AlloySubstance &substance,
                                   const ParticleOperator &heat_rows)
    : substance(substance)
    , n(dis.particles.size())
    , dirichlet(dis.dirichlet)
    , eutectic_concentration(concentration_at_eutectic(substance))
  {
    meter.measure_setup(
        [&]
        {
          const cases::Scene scene = closed(dis.scene);
          const Discretisation closed_dis(scene, parameters);
          const ConductionRows rows(closed_dis, parameters.moment_correction);
          largest_row_sum = rows.largest_row_sum;
          // In the edge layout walls act through particles, which take no solute.
          if(dis.layout == LatticeLayout::cell_centred)
            closing = heat_rows.differing_pairs(rows.rows);
          mobility.resize(heat_rows.padded_rows());
          in_liquid.resize(substance.n_solutes() * heat_rows.padded_rows());
        });
  }

  double SoluteDiffusion::row_sum() const
  {
    return 2 * substance.density * largest_diffusivity(substance.alloy) * largest_row_sum;
  }

  void SoluteDiffusion::follow(std::span<const double> liquid_fraction,
                               std::span<const double> depression,
                               std::span<const std::span<const double>> concentration)
  {
    meter.measure(
        [&]
        {
          const std::size_t size = mobility.size();
          for(std::size_t a = 0; a < n; ++a)
          {
            const double fraction = liquid_fraction[a];
            mobility[a] = fraction;
            // What freezes at the eutectic temperature takes its solute with it.
            const double eutectic_fraction
                = concentration.size() == 1 ? concentration[0][a] / eutectic_concentration
                                            : depression[a] / -substance.eutectic_excess;
            const double share = std::max(fraction, eutectic_fraction);
            for(std::size_t s = 0; s < concentration.size(); ++s)
              in_liquid[s * size + a] = share > 0 ? concentration[s][a] / share : 0.;
          }
          for(const std::uint32_t a : dirichlet)
            mobility[a] = 0;
        });
  }

  DiffusionPair SoluteDiffusion::pair(std::size_t solute) const
  {
    return {in_liquid.data() + solute * mobility.size(), mobility.data(),
            substance.density * substance.alloy.solutes[solute].diffusivity};
  }

  void SoluteDiffusion::close_walls(std::size_t solute, std::span<double> flow) const
  {
    const DiffusionPair exchange = pair(solute);
    for(const ParticleOperator::Entry &entry : closing)
    {
      const double added = entry.coefficient * exchange(entry.row, entry.neighbour);
      flow[entry.row] += added;
      flow[entry.neighbour] -= added;
    }
  }

  std::size_t SoluteDiffusion::first_to_diffuse() const
  {
    const auto &solutes = substance.alloy.solutes;
    return static_cast<std::size_t>(std::find_if(solutes.begin(), solutes.end(),
                                                 [](const cases::Solute &solute)
                                                 { return solute.diffusivity > 0; })
                                    - solutes.begin());
  }

  void SoluteDiffusion::flow(std::size_t solute, const ParticleOperator &heat_rows,
                             std::span<double> flow, int threads)
  {
    if(substance.alloy.solutes[solute].diffusivity == 0)
    {
      std::fill(flow.begin(), flow.end(), 0.);
      return;
    }
    meter.measure(
        [&]
        {
          heat_rows.apply_pairs(pair(solute), flow, threads);
          close_walls(solute, flow);
        });
    touched += static_cast<long>(heat_rows.interactions() + closing.size());
  }

  cases::EffectCost SoluteDiffusion::cost(std::size_t further_bytes) const
  {
    const std::size_t bytes = sizeof(closing[0]) * closing.size()
                              + sizeof(double) * (mobility.size() + in_liquid.size())
                              + sizeof(std::uint32_t) * dirichlet.size() + further_bytes;
    cases::EffectCost cost = meter.cost(cases::Effect::solute_diffusion, bytes);
    const cases::EffectCost joint = joint_meter.cost(cases::Effect::solute_diffusion, 0);
    cost.calls += joint.calls;
    cost.seconds += 0.5 * joint.seconds;
    return cost;
  }
} // namespace meltfront::particles
