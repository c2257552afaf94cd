#include <cases/dense_sampling.h>
#include <particles/sph/exact_sum.h>
#include <particles/sph/wall_areas.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    /** Of an arc for whose middle a value is taken, in spacings. */
    constexpr double longest_part = 0.25;

    double area_about_axis(const cases::Domain &domain, cases::Side side)
    {
      using std::numbers::pi;
      const double inner = domain.lower[0], outer = domain.upper[0];
      if(side == cases::Side::y_min || side == cases::Side::y_max)
        return pi * (outer - inner) * (outer + inner);
      return 2 * pi * (side == cases::Side::x_min ? inner : outer)
             * (domain.upper[1] - domain.lower[1]);
    }

    double wall_area(const Discretisation &dis, cases::Side side)
    {
      for(const RoundWall &wall : dis.round_walls)
        if(wall.boundary == &dis.scene.boundary(side))
          return wall.area(dis.dimension);
      const cases::Domain &domain = dis.scene.domain;
      if(domain.outline)
        return domain.outline->perimeter();
      if(domain.shape == cases::DomainShape::axisymmetric)
        return area_about_axis(domain, side);
      double area = dis.cross_section;
      if(domain.shape == cases::DomainShape::box)
        for(int d = 0; d < dis.dimension; ++d)
          if(d != static_cast<int>(side) / 2)
            area *= domain.upper[d] - domain.lower[d];
      return area;
    }

    /** What particles take at one place of a circle, or at places that differ by rounding
     * only: an arc of it. */
    struct Arc
    {
      double angle, length = 0;
      std::vector<std::size_t> links;
    };

    std::vector<Arc> arcs_in_order(const RoundWall &wall,
                                   const std::vector<WallPoint> &points,
                                   const std::vector<WallLink> &links)
    {
      using std::numbers::pi;
      constexpr double grain = 1e-9;
      std::vector<Arc> arcs;
      for(std::size_t i = 0; i < links.size(); ++i)
      {
        const WallPoint &point = points[links[i].point];
        if(point.boundary != wall.boundary)
          continue;
        const double angle = std::atan2(point.position[1], point.position[0]);
        arcs.push_back(
            {angle > pi - grain ? angle - 2 * pi : angle, links[i].strength, {i}});
      }
      std::ranges::stable_sort(arcs, {}, &Arc::angle);
      std::vector<Arc> result;
      for(Arc &arc : arcs)
        if(result.empty() || arc.angle - result.back().angle > grain)
          result.push_back(std::move(arc));
        else
        {
          result.back().length += arc.length;
          result.back().links.push_back(arc.links.front());
        }
      return result;
    }

    /** Arcs in a row from any angle on, then turned together by the mean of what their
     * middles are away from where they were. What is longer than a length is taken in
     * parts. */
    void share_circle(const RoundWall &wall, double longest, WallShares &shares)
    {
      const std::vector<Arc> arcs = arcs_in_order(wall, shares.points, shares.links);
      if(arcs.empty())
        return;
      double end = 0, turn = 0;
      for(const Arc &arc : arcs)
      {
        turn += arc.length * (arc.angle - (end + arc.length / 2) / wall.radius);
        end += arc.length;
      }
      turn /= end;
      double begin = 0;
      for(const Arc &arc : arcs)
      {
        const int parts = std::max(1, static_cast<int>(std::ceil(arc.length / longest)));
        std::vector<cases::Position> places;
        for(int part = 0; part < parts; ++part)
        {
          const double angle
              = turn + (begin + (part + 0.5) / parts * arc.length) / wall.radius;
          places.push_back(
              {wall.radius * std::cos(angle), wall.radius * std::sin(angle), 0});
        }
        for(const std::size_t link : arc.links)
          shares.divide(link, places);
        begin += arc.length;
      }
    }
  } // namespace

  void WallShares::divide(std::size_t link, const std::vector<cases::Position> &places)
  {
    const cases::Boundary *const boundary = points[links[link].point].boundary;
    links[link].strength /= static_cast<double>(places.size());
    points[links[link].point].position = places.front();
    for(std::size_t part = 1; part < places.size(); ++part)
    {
      links.push_back({links[link].row, static_cast<std::uint32_t>(points.size()),
                       links[link].strength});
      points.push_back({boundary, places[part]});
      if(depths)
        depths->push_back((*depths)[link]);
    }
  }

  void share_walls(const Discretisation &dis, WallShares shares)
  {
    for(const cases::Side side : dis.scene.sides())
    {
      const cases::Boundary &boundary = dis.scene.boundary(side);
      ExactSum own;
      for(const WallLink &link : shares.links)
        if(shares.points[link.point].boundary == &boundary)
          own.add(link.strength);
      const double sum = dis.own.total(own);
      for(WallLink &link : shares.links)
        if(shares.points[link.point].boundary == &boundary)
          link.strength *= wall_area(dis, side) / sum;
    }
    if(dis.dimension == 2)
      for(const RoundWall &wall : dis.round_walls)
        if(cases::may_vary_with(wall.boundary->value, "xyz"))
          share_circle(wall, longest_part * dis.spacing, shares);
  }
} // namespace meltfront::particles
