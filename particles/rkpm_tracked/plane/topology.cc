#include <particles/rkpm_tracked/plane/bodies.h>
#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/topology.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Normals of particles that face each other make at most this cosine. */
    constexpr double facing = -0.5;

    /** Particles so near on one curve do not face each other: the curve only turns. */
    constexpr std::size_t places_along_curve = 3;

    /** Gaps between facing particles that steps look at, in spacings, and the share of
     * one, or the part of a spacing, that a step may take from it. */
    constexpr double widest_gap = 1;
    constexpr double share_of_gap = 0.5, least_closing = 0.1;

    /** Spacings about a change within which particles make up for its area, and by how
     * much at most. */
    constexpr double near_change = 2.5, farthest_shift = 0.1;

    /** So much of it: no more than went is to come back. */
    constexpr double share_made_up = 0.95;

    /** Spacings within which a particle finds its contour; one without has none. */
    constexpr double pairing_reach = 0.5;

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

    /** Call visitor(p, q, gap) for particles that face each other across less than the
     * widest gap (m), positive across solid. */
    template <typename Visitor>
    void visit_facing(const PlaneFront &front, const TopologySettings &settings,
                      Visitor &&visitor)
    {
      const double reach = widest_gap * settings.spacing;
      // Facing particles stand opposite to each other to half of their distance only.
      const double search = std::hypot(reach, 0.6 * settings.front_spacing);
      const PlaneBins bins(front.position, settings.front_spacing);
      for(std::size_t p = 0; p < front.size(); ++p)
        bins.visit(front.position[p], search,
                   [&](std::uint32_t q, double)
                   {
                     if(q <= p || !front.active[p] || !front.active[q]
                        || front.normal[p].dot(front.normal[q]) > facing
                        || are_near_along_curve(front, p, q))
                       return;
                     const double gap
                         = (front.position[q] - front.position[p])
                               .dot((front.normal[p] - front.normal[q]).normalized());
                     if(std::abs(gap) <= reach)
                       visitor(p, q, gap);
                   });
    }

    /** The middle of the narrowest gap; where there is none, the place given. */
    PlanePoint narrowest_gap(const PlaneFront &front, const TopologySettings &settings,
                             PlanePoint place)
    {
      double least = std::numeric_limits<double>::infinity();
      visit_facing(front, settings,
                   [&](std::size_t p, std::size_t q, double gap)
                   {
                     if(std::abs(gap) >= least)
                       return;
                     least = std::abs(gap);
                     place = (front.position[p] + front.position[q]) / 2;
                   });
      return place;
    }

    void take_speeds(const PlaneFront &old, PlaneFront &front, double spacing)
    {
      const PlaneBins bins(old.position, spacing);
      for(std::size_t p = 0; p < front.size(); ++p)
        if(const long nearest = bins.nearest(front.position[p]); nearest >= 0)
          front.speed[p] = old.speed[nearest];
    }

    TopologyEvent vanished(bool solid, const PlanePoint &centre)
    {
      return {fmt::format("a body of {} vanished at ({:.6g}, {:.6g})",
                          solid ? "solid" : "liquid", centre.x(), centre.y()),
              true};
    }

    /** One phase fills the domain. */
    TopologyEvent fill(PlaneFront &front, bool solid, bool &solid_beyond)
    {
      front = PlaneFront();
      solid_beyond = solid;
      return {fmt::format("all is {}", solid ? "solid" : "liquid"), true};
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
        if(outside && !small)
        {
          front.remove_curve(c);
          continue;
        }
        PlanePoint centre(0, 0);
        for(std::size_t p = first; p < last; ++p)
          centre += front.position[p] / static_cast<double>(last - first);
        events.push_back(vanished(signed_area(front, c) > 0, centre));
        front.remove_curve(c);
      }
      return events;
    }

    /** Where curves and contours do not belong together one by one. */
    std::optional<PlanePoint> first_difference(const PlaneFront &front,
                                               const Contours &contours,
                                               const TopologySettings &settings)
    {
      constexpr std::size_t none = static_cast<std::size_t>(-1);
      std::vector<PlanePoint> points;
      std::vector<std::size_t> contour_of;
      for(std::size_t c = 0; c < contours.curves.size(); ++c)
        for(const PlanePoint &point : contours.curves[c])
        {
          points.push_back(point);
          contour_of.push_back(c);
        }
      const PlaneBins bins(points, settings.spacing / 2);
      const double reach = pairing_reach * settings.spacing;
      std::vector<std::size_t> curve_of(contours.curves.size(), none);
      for(std::size_t c = 0; c < front.curves(); ++c)
      {
        std::size_t own = none;
        for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
        {
          if(!front.active[p])
            continue;
          const long nearest = bins.nearest(front.position[p]);
          if(nearest < 0 || (points[nearest] - front.position[p]).norm() > reach)
            continue;
          const std::size_t contour = contour_of[nearest];
          if(own == none)
            own = contour;
          if(curve_of[contour] == none)
            curve_of[contour] = c;
          if(contour != own || curve_of[contour] != c)
            return front.position[p];
        }
      }
      return std::nullopt;
    }

    bool crosses_walls(const PlaneFront &front)
    {
      for(std::size_t c = 0; c < front.curves(); ++c)
      {
        const auto first = front.active.begin() + front.offsets[c],
                   last = front.active.begin() + front.offsets[c + 1];
        if(std::adjacent_find(first, last, std::not_equal_to<>()) != last)
          return true;
      }
      return false;
    }

    /** Lay the curves anew along the zeros of a level set. Where the front melts no solid
     * is to come back by that, nor liquid where it freezes. */
    void lay_anew(PlaneFront &front, const MarkedFront &marked,
                  const PlaneLevelSet &level_set, bool &solid_beyond,
                  const TopologySettings &settings)
    {
      const FrontIndex index(front, solid_beyond, settings.spacing);
      const PlaneBins bins(front.position, settings.spacing);
      const PlaneLevelSet no_way_back = [&](const PlanePoint &point)
      {
        const double value = level_set(point),
                     distance = index.signed_distance(point, settings.spacing);
        return front.speed[bins.nearest(point)] > 0 ? std::max(value, distance)
                                                    : std::min(value, distance);
      };
      const Contours contours = marked.contours(no_way_back);
      PlaneFront laid = front_on_zeros(contours, no_way_back, settings.front_spacing,
                                       4 * settings.least_radius * settings.spacing);
      take_speeds(front, laid, settings.spacing);
      front = std::move(laid);
      solid_beyond = contours.solid_beyond;
    }

    std::vector<TopologyEvent> follow_level_set(PlaneFront &front,
                                                const PlaneNodes &nodes,
                                                const MarkedFront &marked,
                                                bool &solid_beyond,
                                                const TopologySettings &settings)
    {
      std::vector<TopologyEvent> events;
      const PlaneLevelSet value
          = [&](const PlanePoint &point) { return marked.value(point); };
      if(crosses_walls(front))
      {
        const double radius = settings.least_radius * settings.spacing;
        const SmallBodies small(nodes, value, std::numbers::pi * radius * radius);
        for(const bool solid : {false, true})
          if(small.all(solid))
          {
            events.push_back(
                {fmt::format("all is {}", solid ? "solid" : "liquid"), true});
            front = PlaneFront();
            solid_beyond = solid;
            return events;
          }
        for(const Body &body : small.bodies())
          events.push_back(vanished(body.solid, body.centre));
        if(!events.empty())
        {
          const auto without = [&](const PlanePoint &point)
          {
            const Body *body = small.at(point);
            return body ? (body->solid ? 1 : -1) * settings.spacing : value(point);
          };
          lay_anew(front, marked, without, solid_beyond, settings);
          return events;
        }
      }
      if(!settings.join)
        return {};
      const std::optional<PlanePoint> differing
          = first_difference(front, marked.contours(), settings);
      if(!differing)
        return {};
      const PlanePoint place = narrowest_gap(front, settings, *differing);
      const std::size_t curves = front.curves();
      lay_anew(front, marked, value, solid_beyond, settings);
      events.push_back({fmt::format("fronts met at ({:.6g}, {:.6g}): {} curves became {}",
                                    place.x(), place.y(), curves, front.curves()),
                        false});
      return events;
    }
  } // namespace

  double curve_radius(const PlaneFront &front, std::size_t curve)
  {
    return std::sqrt(std::abs(signed_area(front, curve)) / std::numbers::pi);
  }

  std::vector<TopologyEvent> update_topology(PlaneFront &front, const PlaneNodes &nodes,
                                             const MarkedFront &marked,
                                             bool &solid_beyond,
                                             const TopologySettings &settings)
  {
    std::vector<TopologyEvent> events;
    const bool all_beyond
        = std::ranges::all_of(front.position, [&](const PlanePoint &place)
                              { return nodes.wall_distance(place) < 0; });
    if(front.size() > 0 && all_beyond)
    {
      const FrontIndex index(front, solid_beyond, settings.spacing);
      const bool solid = index.solid(nodes.lattice.place(nodes.lattice.first_inside()));
      events.push_back(fill(front, solid, solid_beyond));
    }
    else
      events = remove_vanished(front, nodes, settings);
    if(front.size() > 0)
      for(TopologyEvent &event :
          follow_level_set(front, nodes, marked, solid_beyond, settings))
        events.push_back(std::move(event));
    if(!events.empty())
      for(PlanePoint &way : front.displacement)
        way = PlanePoint(0, 0);
    return events;
  }

  void add_solid(PlaneFront &front, const std::vector<PlanePoint> &places, double area,
                 double spacing)
  {
    if(places.empty())
      return;
    const PlaneBins bins(places, spacing);
    std::vector<std::size_t> near;
    double length = 0;
    for(std::size_t c = 0; c < front.curves(); ++c)
      for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
      {
        const PlanePoint &place = front.position[p];
        if(!front.active[p]
           || (places[bins.nearest(place)] - place).norm() > near_change * spacing)
          continue;
        near.push_back(p);
        length += ((front.position[front.next(c, p)] - place).norm()
                   + (front.position[front.previous(c, p)] - place).norm())
                  / 2;
      }
    if(length == 0)
      return;
    const double way = std::clamp(-share_made_up * area / length,
                                  -farthest_shift * spacing, farthest_shift * spacing);
    for(const std::size_t p : near)
      front.position[p] += way * front.normal[p];
    update_geometry(front);
  }

  double longest_step_of_films(const PlaneFront &front, const TopologySettings &settings)
  {
    double longest = std::numeric_limits<double>::infinity();
    visit_facing(front, settings,
                 [&](std::size_t p, std::size_t q, double gap)
                 {
                   // Positive speeds melt: they close a gap across solid.
                   const double rate = front.speed[p] + front.speed[q];
                   if(gap * rate <= 0)
                     return;
                   const double way = std::max(share_of_gap * std::abs(gap),
                                               least_closing * settings.spacing);
                   longest = std::min(longest, way / std::abs(rate));
                 });
    return longest;
  }
} // namespace meltfront::particles::rkpm_tracked
