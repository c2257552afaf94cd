#include <particles/front_tracking/plane_contour.h>
#include <particles/front_tracking/plane_topology.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::front_tracking
{
  namespace
  {
    /** Normals of particles that face each other make at least this angle's cosine. */
    constexpr double facing = -0.5;

    /** Particles so near on one curve do not meet: the curve only turns. */
    constexpr std::size_t places_along_curve = 3;

    /** A bridge is wider than the gap by so many spacings. */
    constexpr double bridge_margin = 0.5;

    /** Share of its distance from the melting temperature by which a node is changed. */
    constexpr double largest_share = 0.5;

    /** Where two pieces of the front are about to meet. */
    struct Contact
    {
      PlanePoint place;
      double gap;
      bool solid; ///< the bridge: solid joins solid across liquid
    };

    /** Whether two particles stand a few places from each other on one curve. */
    bool are_near_along_curve(const PlaneFront &front, std::size_t first,
                              std::size_t second)
    {
      for(std::size_t c = 0; c < front.curves(); ++c)
        if(front.offsets[c] <= first && second < front.offsets[c + 1])
        {
          const std::size_t apart = second - first,
                            all = front.offsets[c + 1] - front.offsets[c];
          return std::min(apart, all - apart) <= places_along_curve;
        }
      return false;
    }

    /** Particles of other curves, or of other parts of the same one, that face each other
     * across a gap. */
    std::vector<Contact> find_contacts(const PlaneFront &front, const FrontIndex &index,
                                       const TopologySettings &settings)
    {
      std::vector<Contact> contacts;
      const double reach = settings.meeting_gap * settings.spacing;
      // Facing particles stand opposite to each other to half of their distance only.
      const double search = std::hypot(reach, 0.6 * settings.front_spacing);
      const PlaneBins bins(front.position, settings.front_spacing);
      for(std::size_t p = 0; p < front.size(); ++p)
        bins.visit(
            front.position[p], search,
            [&](std::uint32_t q, double)
            {
              if(q <= p || front.normal[p].dot(front.normal[q]) > facing
                 || are_near_along_curve(front, p, q))
                return;
              const PlanePoint between = front.position[q] - front.position[p];
              const PlanePoint direction
                  = (front.normal[p] - front.normal[q]).normalized();
              const double gap = between.dot(direction);
              if(std::abs(gap) > reach)
                return;
              const PlanePoint middle = (front.position[p] + front.position[q]) / 2;
              // A gap of liquid is gone round by no body of solid, where two
              // overlap by two of them.
              const int winding = index.winding(middle);
              contacts.push_back({middle, std::abs(gap), winding == 0 || winding >= 2});
            });
      return contacts;
    }

    double bridged(double distance, const PlanePoint &place,
                   const std::vector<Contact> &contacts, double spacing)
    {
      for(const Contact &contact : contacts)
      {
        const double radius = contact.gap / 2 + bridge_margin * spacing;
        const double from_bridge = (place - contact.place).norm() - radius;
        distance = contact.solid ? std::min(distance, from_bridge)
                                 : std::max(distance, -from_bridge);
      }
      return distance;
    }

    void take_speeds(const PlaneFront &old, PlaneFront &front, double spacing)
    {
      const PlaneBins bins(old.position, spacing);
      for(std::size_t p = 0; p < front.size(); ++p)
        if(const long nearest = bins.nearest(front.position[p]); nearest >= 0)
          front.speed[p] = old.speed[nearest];
    }

    double total_area(const PlaneFront &front)
    {
      double sum = 0;
      for(std::size_t c = 0; c < front.curves(); ++c)
        sum += signed_area(front, c);
      return sum;
    }

    std::vector<TopologyEvent> remove_vanished(PlaneFront &front, const PlaneNodes &nodes,
                                               const TopologySettings &settings)
    {
      std::vector<TopologyEvent> events;
      for(std::size_t c = front.curves(); c-- > 0;)
      {
        const std::size_t first = front.offsets[c], last = front.offsets[c + 1];
        const bool beyond = std::all_of(
            front.position.begin() + first, front.position.begin() + last,
            [&](const PlanePoint &p) { return nodes.wall_distance(p) < 0; });
        // A curve around all of the domain still says which phase fills it.
        const bool outside
            = beyond
              && curve_radius(front, c) < std::sqrt(nodes.area / std::numbers::pi) / 2;
        const bool small
            = curve_radius(front, c) < settings.least_radius * settings.spacing;
        if(!small && !outside)
          continue;
        const double area = signed_area(front, c);
        PlanePoint centre(0, 0);
        for(std::size_t p = first; p < last; ++p)
          centre += front.position[p] / static_cast<double>(last - first);
        TopologyEvent event;
        event.what = fmt::format("a body of {} vanished at ({:.6g}, {:.6g})",
                                 area > 0 ? "solid" : "liquid", centre.x(), centre.y());
        event.place = centre;
        event.solid_area = outside ? 0 : -area;
        event.vanished = true;
        events.push_back(event);
        front.remove_curve(c);
      }
      return events;
    }

    std::vector<TopologyEvent> join_contacts(PlaneFront &front, const PlaneNodes &nodes,
                                             bool &solid_beyond,
                                             const TopologySettings &settings)
    {
      const double h = settings.spacing;
      const FrontIndex index(front, solid_beyond, h);
      const std::vector<Contact> contacts = find_contacts(front, index, settings);
      if(contacts.empty())
        return {};
      const double reach = 2 * h;
      const PlaneLevelSet level_set = [&](const PlanePoint &place)
      { return bridged(index.signed_distance(place, reach), place, contacts, h); };
      PlanePoint lower = nodes.lower, upper = nodes.upper;
      for(const PlanePoint &place : front.position)
      {
        lower = lower.cwiseMin(place);
        upper = upper.cwiseMax(place);
      }
      const ContourGrid grid = contour_grid(lower, upper, 2 * h, h / 4);
      std::vector<double> values;
      for(long j = 0; j < grid.rows; ++j)
        for(long i = 0; i < grid.columns; ++i)
          values.push_back(level_set(grid.node(i, j)));
      const Contours contours = find_contours(grid, std::move(values), level_set);
      PlaneFront joined = front_on_zeros(contours, level_set, settings.front_spacing,
                                         4 * settings.least_radius * h);
      take_speeds(front, joined, h);
      TopologyEvent event;
      event.what = fmt::format("fronts met at ({:.6g}, {:.6g}): {} curves became {}",
                               contacts.front().place.x(), contacts.front().place.y(),
                               front.curves(), joined.curves());
      event.place = contacts.front().place;
      event.solid_area = total_area(joined) - total_area(front);
      front = std::move(joined);
      solid_beyond = contours.solid_beyond;
      return {event};
    }
  } // namespace

  double curve_radius(const PlaneFront &front, std::size_t curve)
  {
    return std::sqrt(std::abs(signed_area(front, curve)) / std::numbers::pi);
  }

  std::vector<TopologyEvent> update_topology(PlaneFront &front, const PlaneNodes &nodes,
                                             bool &solid_beyond,
                                             const TopologySettings &settings)
  {
    std::vector<TopologyEvent> events = remove_vanished(front, nodes, settings);
    if(settings.join)
      for(TopologyEvent &event : join_contacts(front, nodes, solid_beyond, settings))
        events.push_back(std::move(event));
    if(!events.empty())
      for(PlanePoint &way : front.displacement)
        way = PlanePoint(0, 0);
    return events;
  }

  double book_latent_heat(PlaneState &state, const cases::Scene &scene,
                          const PlaneNodes &nodes, const PlaneHeat &heat,
                          const PlanePoint &place, double energy)
  {
    const double melting = scene.material.melting_temperature;
    struct Store
    {
      double distance, excess, capacity;
      std::uint32_t node;
    };
    std::vector<Store> stores;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(state.phase[i] == NodePhase::front || nodes.wall_of_node[i] >= 0)
        continue;
      const double excess = heat.temperature(state, i) - melting;
      if(excess * energy >= 0)
        continue;
      const auto &phase = state.phase[i] == NodePhase::solid ? scene.material.solid
                                                             : scene.material.liquid;
      stores.push_back({(nodes.position[i] - place).norm(), excess,
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
    while(count < stores.size() && largest_share * room < std::abs(energy))
    {
      room += std::abs(stores[count].excess) * stores[count].capacity;
      ++count;
    }
    if(room == 0)
      return 0;
    const double share = std::min(largest_share, std::abs(energy) / room);
    for(std::size_t i = 0; i < count; ++i)
      state.unknown[stores[i].node] -= share * stores[i].excess;
    return std::copysign(share * room, energy);
  }
} // namespace meltfront::particles::front_tracking
