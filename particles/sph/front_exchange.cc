#include <particles/sph/front_exchange.h>
#include <particles/sph/plane_pair.h>

#include <boost/container/static_vector.hpp>

namespace meltfront::particles
{
  namespace
  {
    constexpr int solid_bit = 1, liquid_bit = 2, melting_bit = 4;

    /** Of a particle on a lattice that FrontPlanes takes. */
    constexpr std::size_t most_neighbours = 26;
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
    return lies_within_particles(rule) ? 2 : 1;
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
          if(planes)
            return apply_planes(rows, state, flow);
          with_pair(state,
                    [&](const auto &pair) { rows.apply_to_slices(fronts, pair, flow); });
        });
    for(const std::uint32_t slice : fronts)
      touched += rows.interactions(slice);
  }

  void FrontExchange::follow_planes(const Discretisation &dis)
  {
    meter.measure_setup([&] { planes.emplace(dis); });
  }

  void FrontExchange::apply_planes(const ParticleOperator &rows, FrontState state,
                                   std::span<double> flow)
  {
    planes->update(fronts, state.enthalpy, latent_heat);
    const PlanePair pair{state, latent_heat, planes->distance(), planes->trust()};
    rows.apply_to_slices(fronts, pair, flow);
    settle(rows, state, flow);
  }

  /**
   * What a solid and a liquid particle leave over goes to the melting particles between
   * them, by their coefficients and by how near to the middle they lie. Where there is
   * none, or the front has all but reached the particle that is about to change phase,
   * it goes to that one: else it would keep its phase when the front is past its centre.
   */
  void FrontExchange::settle(const ParticleOperator &rows, FrontState state,
                             std::span<double> flow) const
  {
    const PlanePair pair{state, latent_heat, planes->distance(), planes->trust()};
    boost::container::static_vector<std::pair<std::size_t, double>, 2 * most_neighbours>
        between;
    const auto find_between = [&](std::size_t a, std::size_t b)
    {
      const auto weigh = [&](std::size_t m, double coefficient)
      {
        if(state.u[m] == 0)
          if(const double share = pair.share_between(a, b, m); share > 0)
            between.emplace_back(m, coefficient * share);
      };
      rows.visit_row(a, weigh);
      rows.visit_row(b, weigh);
    };
    const auto settle_pair = [&](std::size_t a, std::size_t b, double coefficient)
    {
      if(!(a < b && state.u[a] * state.u[b] < 0))
        return;
      const double to_a = coefficient * pair(a, b), to_b = coefficient * pair(b, a);
      const std::size_t changing = std::abs(to_a) < std::abs(to_b) ? a : b;
      between.clear();
      if(!pair.reached(changing))
        find_between(a, b);
      if(between.empty())
        between.emplace_back(changing, 1);
      double weight = 0;
      for(const auto &[m, share] : between)
        weight += share;
      for(const auto &[m, share] : between)
        flow[m] -= (to_a + to_b) * share / weight;
    };
    constexpr std::size_t lanes = ParticleOperator::lanes;
    for(const std::uint32_t slice : fronts)
      for(std::size_t a = slice * lanes; a < std::min((slice + 1) * lanes, rows.rows());
          ++a)
        rows.visit_row(a, [&](std::size_t b, double coefficient)
                       { settle_pair(a, b, coefficient); });
  }

  cases::EffectCost FrontExchange::cost(cases::Effect effect) const
  {
    return meter.cost(effect, offsets.size() * sizeof(offsets[0])
                                  + adjacent.size() * sizeof(adjacent[0]) + phases.size()
                                  + fronts.capacity() * sizeof(fronts[0])
                                  + (planes ? planes->bytes() : 0));
  }
} // namespace meltfront::particles
