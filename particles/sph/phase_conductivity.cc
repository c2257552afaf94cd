#include <particles/sph/phase_conductivity.h>

namespace meltfront::particles
{
  PhaseConductivity::PhaseConductivity(const cases::Material &material,
                                       MeltingConductivity rule,
                                       const ParticleOperator &rows)
      : rule(rule)
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

  bool
  PhaseConductivity::update_phases(std::span<const double> u)
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;
    const bool melting_is_liquid = rule == MeltingConductivity::liquid;
    bool changed = false;
    for(std::size_t slice = 0; slice < phases.size(); ++slice)
    {
      const double *value = u.data() + slice * lanes;
      int solid = 0, liquid = 0;
#pragma omp simd reduction(| : solid, liquid)
      for(std::size_t lane = 0; lane < lanes; ++lane)
      {
        solid |= value[lane] < 0;
        liquid |= value[lane] > 0 || (melting_is_liquid && value[lane] == 0);
      }
      const auto found = static_cast<unsigned char>(solid | liquid << 1);
      changed = changed || found != phases[slice];
      phases[slice] = found;
    }
    return changed;
  }

  void
  PhaseConductivity::find_fronts(std::span<const double> u)
  {
    if(!update_phases(u))
      return;
    fronts.clear();
    for(std::size_t slice = 0; slice < phases.size(); ++slice)
    {
      unsigned char reached = 0;
      for(std::size_t i = offsets[slice]; i < offsets[slice + 1]; ++i)
        reached |= phases[adjacent[i]];
      if(reached == 3)
        fronts.push_back(slice);
    }
  }

  void
  PhaseConductivity::apply(const ParticleOperator &rows, std::span<const double> u,
                           std::span<double> flow)
  {
    meter.measure(
        [&]
        {
          find_fronts(u);
          with_pair([&](const auto &pair)
                    { rows.apply_to_slices(fronts, pair, u, flow); });
        });
    for(const std::uint32_t slice : fronts)
      touched += rows.interactions(slice);
  }

  cases::EffectCost
  PhaseConductivity::cost() const
  {
    return meter.cost(cases::Effect::phase_conductivity,
                      offsets.size() * sizeof(offsets[0])
                          + adjacent.size() * sizeof(adjacent[0]) + phases.size()
                          + fronts.capacity() * sizeof(fronts[0]));
  }
} // namespace meltfront::particles
