#include <particles/sph/front_exchange.h>

namespace meltfront::particles
{
  namespace
  {
    constexpr int solid_bit = 1, liquid_bit = 2, melting_bit = 4;
  } // namespace

  FrontExchange::FrontExchange(const cases::Material &material, FrontRule rule,
                               const ParticleOperator &rows)
    : rule(rule)
    , latent_heat(material.latent_heat)
  {
    const double solid = material.solid.conductivity;
    const double liquid = material.liquid.conductivity;
    solid_scale = 2 * liquid / (solid + liquid);
    liquid_scale = 2 * solid / (solid + liquid);
    meter.measure_setup(
        [&]
        {
          rows.slice_adjacency(offsets, adjacent);
          phases.assign(rows.slices(), 0);
          fronts.reserve(rows.slices());
        });
  }

  double FrontExchange::largest_factor(FrontRule rule)
  {
    return rule == FrontRule::sub_particle ? 2 : 1;
  }

  bool FrontExchange::update_phases(const double *u)
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;
    bool changed = false;
    for(std::size_t slice = 0; slice < phases.size(); ++slice)
    {
      const double *value = u + slice * lanes;
      int solid = 0, liquid = 0, melting = 0;
#pragma omp simd reduction(| : solid, liquid, melting)
      for(std::size_t lane = 0; lane < lanes; ++lane)
      {
        solid |= value[lane] < 0;
        liquid |= value[lane] > 0;
        melting |= value[lane] == 0;
      }
      const auto found = static_cast<unsigned char>(
          solid * solid_bit | liquid * liquid_bit | melting * melting_bit);
      changed = changed || found != phases[slice];
      phases[slice] = found;
    }
    return changed;
  }

  void FrontExchange::find_fronts(const double *u)
  {
    if(!update_phases(u))
      return;
    fronts.clear();
    for(std::size_t slice = 0; slice < phases.size(); ++slice)
    {
      int reached = 0;
      for(std::size_t i = offsets[slice]; i < offsets[slice + 1]; ++i)
        reached |= phases[adjacent[i]];
      if(reached != solid_bit && reached != liquid_bit && reached != melting_bit)
        fronts.push_back(slice);
    }
  }

  void FrontExchange::apply(const ParticleOperator &rows, FrontState state,
                            std::span<double> flow)
  {
    meter.measure(
        [&]
        {
          find_fronts(state.u);
          with_pair(state,
                    [&](const auto &pair) { rows.apply_to_slices(fronts, pair, flow); });
        });
    for(const std::uint32_t slice : fronts)
      touched += rows.interactions(slice);
  }

  cases::EffectCost FrontExchange::cost(cases::Effect effect) const
  {
    return meter.cost(effect, offsets.size() * sizeof(offsets[0])
                                  + adjacent.size() * sizeof(adjacent[0]) + phases.size()
                                  + fronts.capacity() * sizeof(fronts[0]));
  }
} // namespace meltfront::particles
