#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/topology.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Share of its distance from the melting temperature by which a node is changed. */
    constexpr double largest_share = 0.5;
  } // namespace

  double book_heat(PlaneState &state, const cases::Scene &scene, const PlaneNodes &nodes,
                   PlaneHeat &heat, const std::vector<PlanePoint> &places, double wanted)
  {
    const auto missing = [&]
    {
      heat.expand(state);
      const PlaneMeasure found = measure(scene, nodes, heat, state);
      return wanted - found.sensible - found.latent;
    };
    const double energy = missing();
    const PlaneBins bins(places, nodes.spacing);
    const FrontIndex index(state.front, heat.settings.solid_beyond, nodes.spacing);
    const double melting = scene.material.melting_temperature,
                 beside_front = cut_reach * nodes.spacing;
    struct Store
    {
      double distance, excess, capacity;
      std::uint32_t node;
    };
    std::vector<Store> stores, others;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const PlanePoint &place = nodes.position[i];
      if(state.phase[i] == NodePhase::front || nodes.wall_of_node[i] >= 0
         || std::abs(index.signed_distance(place, beside_front)) < beside_front)
        continue;
      const double excess = heat.temperature(state, i) - melting;
      const auto &phase = state.phase[i] == NodePhase::solid ? scene.material.solid
                                                             : scene.material.liquid;
      const long nearest = bins.nearest(place);
      (excess * energy < 0 ? stores : others)
          .push_back({nearest < 0 ? 0 : (place - places[nearest]).norm(), excess,
                      phase.volumetric_heat_capacity() * nodes.weight[i],
                      static_cast<std::uint32_t>(i)});
    }
    std::ranges::sort(stores,
                      [](const Store &a, const Store &b) {
                        return a.distance < b.distance
                               || (a.distance == b.distance && a.node < b.node);
                      });
    double room = 0;
    std::size_t count = 0;
    while(count < stores.size()
          && (places.empty() || largest_share * room < std::abs(energy)))
    {
      room += std::abs(stores[count].excess) * stores[count].capacity;
      ++count;
    }
    double left = energy;
    // Heat depends on temperatures linearly: the second change is exact.
    const auto book = [&](double amount, const auto &change)
    {
      change(amount);
      const double after = missing();
      if(after != left)
        change(amount * after / (left - after));
      left = missing();
    };
    if(room > 0)
    {
      const auto approach = [&](double share)
      {
        for(std::size_t i = 0; i < count; ++i)
          state.unknown[stores[i].node] -= share * stores[i].excess;
      };
      if(std::abs(energy) < largest_share * room)
        book(std::abs(energy) / room, approach);
      else
      {
        approach(largest_share);
        left = missing();
      }
    }
    double capacity = 0;
    for(const Store &store : others)
      capacity += store.capacity;
    if(std::abs(energy) >= largest_share * room && capacity > 0)
      book(left / capacity,
           [&](double warming)
           {
             for(const Store &store : others)
               state.unknown[store.node] += warming;
           });
    return left;
  }
} // namespace meltfront::particles::rkpm_tracked
