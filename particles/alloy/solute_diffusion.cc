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

    struct DiffusionPair
    {
      const double *concentration;
      const double *mobility;
      double scale; ///< rho D

      double operator()(std::size_t a, std::size_t b) const
      {
        // Where both are solid nothing flows: the least number keeps 0/0 away.
        const double own = mobility[a], other = mobility[b];
        const double mean = 2 * own * other / (own + other + 1e-300);
        return scale * mean * (concentration[b] - concentration[a]);
      }
    };
  } // namespace

  SoluteDiffusion::SoluteDiffusion(const Discretisation &dis,
                                   const SphParameters &parameters,
                                   const AlloySubstance &substance,
                                   const ParticleOperator &heat_rows)
    : substance(substance)
    , n(dis.particles.size())
    , held(dis.held)
    , eutectic_concentration(concentration_at_eutectic(substance))
  {
    meter.measure_setup(
        [&]
        {
          const cases::Scene scene = closed(dis.scene);
          const Discretisation closed_dis(scene, parameters);
          ConductionRows rows(closed_dis, parameters.moment_correction);
          largest_row_sum = rows.largest_row_sum;
          if(dis.layout == LatticeLayout::cell_centred)
            own_rows = std::move(rows.rows);
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
          for(const std::uint32_t a : held)
            mobility[a] = 0;
        });
  }

  void SoluteDiffusion::flow(std::size_t solute, const ParticleOperator &heat_rows,
                             std::span<double> flow, int threads)
  {
    const double diffusivity = substance.alloy.solutes[solute].diffusivity;
    if(diffusivity == 0)
    {
      std::fill(flow.begin(), flow.end(), 0.);
      return;
    }
    meter.measure(
        [&]
        {
          const ParticleOperator &rows = own_rows ? *own_rows : heat_rows;
          const double *concentration = in_liquid.data() + solute * mobility.size();
          rows.apply_pairs(DiffusionPair{concentration, mobility.data(),
                                         substance.density * diffusivity},
                           flow, threads);
          touched += static_cast<long>(rows.interactions());
        });
  }

  cases::EffectCost SoluteDiffusion::cost(std::size_t further_bytes) const
  {
    return meter.cost(cases::Effect::solute_diffusion,
                      (own_rows ? own_rows->bytes() : 0)
                          + sizeof(double) * (mobility.size() + in_liquid.size())
                          + sizeof(std::uint32_t) * held.size() + further_bytes);
  }
} // namespace meltfront::particles
