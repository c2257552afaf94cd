#include <particles/sph/bent_walls.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::particles
{
  namespace
  {
    LineToGhost through_round_wall(const Discretisation &dis,
                                   const cases::Position &particle,
                                   const cases::Position &ghost)
    {
      const double from_origin = std::hypot(ghost[0], ghost[1], ghost[2]);
      const RoundWall &wall = dis.nearest_round_wall(from_origin);
      const double depth = wall.conductive_depth(
                       std::hypot(particle[0], particle[1], particle[2]), dis.dimension),
                   beyond = -wall.conductive_depth(from_origin, dis.dimension),
                   least = std::max(depth, shallowest_depth * dis.spacing);
      if(wall.known_beyond())
        return {wall.boundary, ghost, least, depth + beyond, 1};
      cases::Position place = ghost;
      for(double &x : place)
        x *= wall.radius / from_origin;
      return {wall.boundary, place, least, std::max(depth, 0.) + beyond,
              1 + beyond / least};
    }

    LineToGhost through_outline(const Discretisation &dis,
                                const cases::Position &particle,
                                const cases::Position &ghost)
    {
      const cases::Outline &outline = *dis.scene.domain.outline;
      const auto crossing = outline.first_crossing(particle, ghost);
      const cases::Outline::Edge edge
          = crossing ? *crossing : outline.nearest_edge(ghost);
      const auto along_normal
          = [&edge](const cases::Position &from, const cases::Position &to)
      { return edge.normal[0] * (to[0] - from[0]) + edge.normal[1] * (to[1] - from[1]); };
      const auto length = [](const cases::Position &from, const cases::Position &to)
      { return std::hypot(to[0] - from[0], to[1] - from[1]); };
      const double shallowest = shallowest_depth * dis.spacing,
                   depth = std::max(along_normal(particle, edge.place), shallowest);
      return {&dis.scene.boundary(cases::Side::outer), edge.place, depth,
              std::max(along_normal(particle, ghost), 0.),
              crossing ? length(particle, ghost)
                             / std::max(length(particle, edge.place), shallowest)
                       : 1 + along_normal(edge.place, ghost) / depth};
    }

    std::vector<bool> seen_pairs(const Discretisation &dis, const NeighbourList &list)
    {
      const cases::Outline &outline = *dis.scene.domain.outline;
      // A line that the outline crosses is longer than its ends are from it.
      const double reach = std::max(dis.kernel.support(), 2 * dis.spacing);
      std::vector<bool> inner(list.rows());
      for(std::size_t i = 0; i < inner.size(); ++i)
        inner[i] = outline.distance(dis.particles.point(i)) > reach;
      std::vector<bool> result(list.size(), true);
      for(std::size_t a = 0; a < list.rows(); ++a)
        for(std::size_t k = 0; !inner[a] && k < list[a].size(); ++k)
          if(const std::size_t b = list[a][k]; !inner[b])
          {
            const auto [first, second] = std::minmax(a, b);
            result[list.offset(a) + k]
                = !outline.hides(dis.particles.point(first), dis.particles.point(second));
          }
      return result;
    }
  } // namespace

  LineToGhost line_to_ghost(const Discretisation &dis, const cases::Position &particle,
                            const cases::Position &ghost)
  {
    return dis.scene.domain.outline ? through_outline(dis, particle, ghost)
                                    : through_round_wall(dis, particle, ghost);
  }

  NeighboursInSight::NeighboursInSight(const Discretisation &dis,
                                       NeighbourList neighbours)
    : seen(std::move(neighbours))
  {
    if(!dis.scene.domain.outline)
      return;
    std::vector<bool> pairs = seen_pairs(dis, seen);
    NeighbourList in_sight = seen.kept(pairs);
    pairs.flip();
    hidden = seen.kept(pairs);
    seen = std::move(in_sight);
  }
} // namespace meltfront::particles
