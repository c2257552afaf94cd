#include <verification/measure/checks/front_phases.h>
#include <verification/measure/formulas/site_grid.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr double spacings_to_phases = 3;
  } // namespace

  PhasesPresent phases_present(const cases::Snapshot &snapshot)
  {
    PhasesPresent result;
    for(std::size_t i = 0; i < snapshot.solid_fraction.size(); ++i)
    {
      if(!(snapshot.weights[i] > 0))
        continue;
      result.solid |= snapshot.solid_fraction[i] > 0;
      result.liquid |= snapshot.solid_fraction[i] < 1;
    }
    return result;
  }

  double distance_from_wall(const cases::Domain &domain, const cases::Position &point)
  {
    if(domain.outline)
      return domain.outline->distance(point);
    if(domain.mesh)
      return domain.mesh->distance_from_boundary(point);
    if(domain.round())
    {
      const double radius = std::hypot(point[0], point[1], point[2]);
      const double inner = domain.inner_radius > 0 ? radius - domain.inner_radius
                                                   : std::numeric_limits<double>::max();
      return std::min(inner, domain.radius - radius);
    }
    double result = std::numeric_limits<double>::max();
    for(int d = 0; d < domain.dimension; ++d)
      result = std::min({result, point[d] - domain.lower[d], domain.upper[d] - point[d]});
    return result;
  }

  namespace
  {
    /** Whether the sites on both sides of a point of a line are of different phases,
     * however far they are. */
    bool changes_between_neighbours(const cases::Snapshot &snapshot, double x)
    {
      double below = -std::numeric_limits<double>::infinity(), above = -below;
      double fraction_below = 0, fraction_above = 0;
      for(std::size_t i = 0; i < snapshot.solid_fraction.size(); ++i)
      {
        const double place = snapshot.positions[0][i];
        // The front's own site, if it has one, is on neither side.
        if(place < x && place > below)
        {
          below = place;
          fraction_below = snapshot.solid_fraction[i];
        }
        if(place > x && place < above)
        {
          above = place;
          fraction_above = snapshot.solid_fraction[i];
        }
      }
      return std::isfinite(below) && std::isfinite(above)
             && fraction_below != fraction_above;
    }
  } // namespace

  StrayPoints stray_points(const cases::Domain &domain, const cases::Snapshot &snapshot,
                           double spacing)
  {
    StrayPoints result;
    const std::size_t n = snapshot.front[0].size();
    if(n == 0)
      return result;
    const double reach = spacings_to_phases * spacing;
    const SiteGrid grid(snapshot, reach);
    std::size_t stray = 0;
    for(std::size_t p = 0; p < n; ++p)
    {
      cases::Position point{};
      for(int d = 0; d < snapshot.dimension; ++d)
        point[d] = snapshot.front[d][p];
      bool solid = false, liquid = false;
      grid.visit(point,
                 [&](std::uint32_t site)
                 {
                   solid |= snapshot.solid_fraction[site] > 0;
                   liquid |= snapshot.solid_fraction[site] < 1;
                 });
      if((solid && liquid) || distance_from_wall(domain, point) <= spacing)
        continue;
      if(snapshot.dimension == 1 && changes_between_neighbours(snapshot, point[0]))
        continue;
      if(stray == 0)
        result.first = point;
      ++stray;
    }
    result.share = static_cast<double>(stray) / static_cast<double>(n);
    return result;
  }
} // namespace meltfront::verification
