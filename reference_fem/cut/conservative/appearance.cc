#include <reference_fem/cut/conservative/appearance.h>
#include <reference_fem/cut/conservative/step_frame.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Spacings from a front within which heat beyond the melting temperature is an error
     * of the elements, and not a phase to come; at walls that drive it. */
    constexpr double away_from_front = 2.5, away_at_wall = 1;

    /** Spacings: thickness of the thinnest layer that appears; and from a wall, within
     * which heat belongs to a layer on it. */
    constexpr double thinnest = 0.05, near_wall = 6;

    /** Spacings from a wall within which nodes lie at it. */
    constexpr double within_wall = 1;

    /** Of what is tolerated beyond the melting temperature. */
    constexpr double appears_at = 0.5;

    /** Squares of the spacing: the smallest body that appears. */
    constexpr double smallest = 0.2;

    std::ptrdiff_t nodes_at_driving_walls(const AppearanceSetting &setting,
                                          const std::vector<unsigned int> &nodes)
    {
      return std::ranges::count_if(nodes, [&](unsigned int node)
                                   { return setting.at_driving_wall[node] != 0; });
    }

    /** Connected nodes of a phase that hold heat of the other one. */
    struct Patch
    {
      Phase phase;
      std::vector<unsigned int> nodes;
    };

    /** Of a phase (J/m). */
    double heat_beyond_melting(const std::array<Values, 2> &heat, unsigned int node,
                               Phase phase)
    {
      const double of_phase = heat[index(phase)][node];
      return std::max(0., phase == Phase::liquid ? -of_phase : of_phase);
    }

    Phase phase_of(const Values &level_set, unsigned int node)
    {
      return level_set[node] < 0 ? Phase::solid : Phase::liquid;
    }

    /** By node and phase, the area of the other phase that its heat would make (m^2). */
    double area_due(const FrontState &state, unsigned int node, Phase phase,
                    double latent_heat)
    {
      return heat_beyond_melting(state.heat, node, phase) / latent_heat;
    }

    bool is_away_from_front(const AppearanceSetting &setting, const Values &level_set,
                            unsigned int node)
    {
      const double least = setting.at_driving_wall[node] ? away_at_wall : away_from_front;
      return std::abs(level_set[node]) > least * setting.mesh.spacing;
    }

    std::vector<Patch> patches(const AppearanceSetting &setting, const FrontState &state)
    {
      const TriangleMesh &mesh = setting.mesh;
      std::vector<std::vector<unsigned int>> neighbours(mesh.nodes.size());
      for(const Triangle &triangle : mesh.triangles)
        for(std::size_t i = 0; i < 3 && !triangle.part.empty(); ++i)
          for(const std::size_t j : {(i + 1) % 3, (i + 2) % 3})
            neighbours[triangle.nodes[i]].push_back(triangle.nodes[j]);
      const auto takes_part = [&](unsigned int node)
      {
        return is_away_from_front(setting, state.level_set, node)
               && area_due(state, node, phase_of(state.level_set, node),
                           setting.latent_heat)
                      > 0;
      };
      std::vector<char> seen(mesh.nodes.size(), false);
      std::vector<Patch> result;
      for(unsigned int first = 0; first < mesh.nodes.size(); ++first)
      {
        if(seen[first] || !takes_part(first))
          continue;
        Patch patch{phase_of(state.level_set, first), {first}};
        seen[first] = true;
        for(std::size_t i = 0; i < patch.nodes.size(); ++i)
          for(const unsigned int node : neighbours[patch.nodes[i]])
            if(!seen[node] && takes_part(node))
            {
              seen[node] = true;
              patch.nodes.push_back(node);
            }
        result.push_back(std::move(patch));
      }
      return result;
    }

    /** The point of a side that is nearest to one, and how far into the domain that is
     * from it (m). */
    struct Foot
    {
      Point place;
      double distance;
    };

    Foot foot(const cases::Domain &domain, cases::Side side, const Point &point)
    {
      if(domain.round())
      {
        const double radius
            = side == cases::Side::inner ? domain.inner_radius : domain.radius;
        const double at = point.norm();
        return {at > 0 ? Point(radius / at * point) : Point(radius, 0),
                side == cases::Side::inner ? at - radius : radius - at};
      }
      const auto number = static_cast<std::size_t>(side);
      const unsigned int d = number / 2;
      Foot result{point, 0};
      result.place[d] = (number % 2 == 1 ? domain.upper : domain.lower)[d];
      result.distance = std::abs(point[d] - result.place[d]);
      return result;
    }

    /** How thick a layer is along the walls. */
    class Thickness
    {
    public:
      explicit Thickness(const TriangleMesh &mesh)
        : mesh(mesh)
        , areas(mesh.walls.size())
      {
      }

      void add(cases::Side side, const Point &place, double area)
      {
        double sum = 0;
        visit(side, place, [&](std::size_t, double weight) { sum += weight; });
        visit(side, place,
              [&](std::size_t piece, double weight)
              { areas[piece] += weight / sum * area; });
      }

      double at(cases::Side side, const Point &place) const
      {
        double area = 0, length = 0;
        visit(side, place,
              [&](std::size_t piece, double weight)
              {
                area += weight * areas[piece];
                length += weight * mesh.walls[piece].segment.length();
              });
        return length > 0 ? area / length : 0;
      }

      double largest() const
      {
        double result = 0;
        for(const WallPiece &wall : mesh.walls)
          result = std::max(result, at(wall.side, middle(wall)));
        return result;
      }

    private:
      static Point middle(const WallPiece &wall)
      {
        return wall.segment.begin + (wall.segment.end - wall.segment.begin) / 2;
      }

      /** Pieces of a side that are within a spacing of a point. */
      template <typename Visit>
      void visit(cases::Side side, const Point &place, const Visit &visit) const
      {
        for(std::size_t piece = 0; piece < mesh.walls.size(); ++piece)
          if(mesh.walls[piece].side == side)
            if(const double distance = place.distance(middle(mesh.walls[piece]));
               distance < 2 * mesh.spacing)
              visit(piece, 2 * mesh.spacing - distance);
      }

      const TriangleMesh &mesh;
      Values areas; ///< by piece of a wall (m^2)
    };

    /** The wall that a layer at a point would lie on: one that drives it if any is near.
     */
    std::optional<std::pair<cases::Side, Foot>>
    wall_below(const AppearanceSetting &setting, const Point &point)
    {
      std::optional<std::pair<cases::Side, Foot>> result;
      const auto look = [&](const std::vector<cases::Side> &sides)
      {
        for(const cases::Side side : sides)
          if(const Foot below = foot(setting.domain, side, point);
             !(below.distance > near_wall * setting.mesh.spacing)
             && (!result || below.distance < result->second.distance))
            result.emplace(side, below);
      };
      look(setting.driving_walls);
      if(!result)
        look(setting.walls);
      return result;
    }

    /** The distance to a layer as thick as it is, negative in it, at all nodes. */
    Values layer(const AppearanceSetting &setting, const Thickness &thickness)
    {
      const TriangleMesh &mesh = setting.mesh;
      Values result(mesh.nodes.size(), std::numeric_limits<double>::infinity());
      for(std::size_t node = 0; node < result.size(); ++node)
        for(const cases::Side side : setting.walls)
        {
          const Foot below = foot(setting.domain, side, mesh.nodes[node]);
          if(!(below.distance < 2 * mesh.spacing))
            continue;
          // Where nothing is due the wall itself would be a front.
          const double thick = thickness.at(side, below.place);
          result[node] = std::min(result[node],
                                  thick > 0 ? below.distance - thick
                                            : std::max(below.distance, mesh.spacing));
        }
      return result;
    }

    /** The distance to what appears, negative in it, at all nodes. */
    std::optional<Values> body_of(const AppearanceSetting &setting,
                                  const FrontState &state, const Patch &patch,
                                  bool beyond_tolerance)
    {
      const TriangleMesh &mesh = setting.mesh;
      Thickness thickness(mesh);
      double area = 0, of_walls = 0, farthest = 0;
      unsigned int deepest = patch.nodes.front();
      for(const unsigned int node : patch.nodes)
      {
        const double due = area_due(state, node, patch.phase, setting.latent_heat);
        area += due;
        if(due > farthest)
        {
          farthest = due;
          deepest = node;
        }
        if(const auto wall = wall_below(setting, mesh.nodes[node]))
        {
          of_walls += due;
          thickness.add(wall->first, wall->second.place, due);
        }
      }
      if(area < smallest * mesh.spacing * mesh.spacing
         && !(beyond_tolerance && of_walls > area / 2
              && nodes_at_driving_walls(setting, patch.nodes) > 0))
        return std::nullopt;
      if(of_walls > area / 2)
      {
        if(!beyond_tolerance && thickness.largest() < thinnest * mesh.spacing)
          return std::nullopt;
        return layer(setting, thickness);
      }
      Values result(mesh.nodes.size());
      for(std::size_t node = 0; node < result.size(); ++node)
        result[node] = mesh.nodes[node].distance(mesh.nodes[deepest])
                       - std::sqrt(area / std::numbers::pi);
      return result;
    }

    /** Put a body in the place of the heat of a patch, but for triangles that a front
     * cuts already. @return its area (m^2); none where nothing of it is left */
    std::optional<double> put(const AppearanceSetting &setting, const Values &body,
                              const Patch &patch, FrontState &state)
    {
      const TriangleMesh &mesh = setting.mesh;
      const Front old_front(mesh, state.level_set);
      const double sign = patch.phase == Phase::liquid ? 1 : -1;
      std::vector<char> at_front(mesh.nodes.size(), false);
      for(const CutTriangle &cut : old_front.cut)
        for(const unsigned int node : cut.place->nodes)
          at_front[node] = true;
      Values level_set = state.level_set;
      for(std::size_t node = 0; node < body.size(); ++node)
        if(!at_front[node])
          level_set[node] = sign * std::min(sign * level_set[node], body[node]);
      level_set = without_zeros(std::move(level_set), mesh.spacing);
      const Front front(mesh, level_set);
      Values change = front.solid_area;
      for(std::size_t node = 0; node < change.size(); ++node)
        change[node] -= old_front.solid_area[node];
      const double made = sum(change);
      if(!(sign * made > 0))
        return std::nullopt;
      double due = 0;
      for(const unsigned int node : patch.nodes)
      {
        const double area = area_due(state, node, patch.phase, setting.latent_heat);
        due += area;
        state.heat[index(patch.phase)][node] += sign * setting.latent_heat * area;
      }
      for(std::size_t node = 0; node < change.size(); ++node)
        state.debt[node] += (sign * due / made - 1) * change[node];
      state.level_set = with_distances(mesh, front, level_set, setting.reach);
      return due;
    }
  } // namespace

  AppearanceSetting::AppearanceSetting(const TriangleMesh &mesh,
                                       const cases::Scene &scene, double reach)
    : mesh(mesh)
    , domain(scene.domain)
    , at_driving_wall(mesh.nodes.size(), false)
    , latent_heat(scene.material.solid.density * scene.material.latent_heat)
    , reach(reach)
  {
    for(const WallPiece &wall : mesh.walls)
      if(std::ranges::find(walls, wall.side) == walls.end())
        walls.push_back(wall.side);
    for(const cases::Side side : walls)
    {
      if(scene.boundary(side).kind == cases::BoundaryKind::insulated)
        continue;
      driving_walls.push_back(side);
      for(std::size_t node = 0; node < at_driving_wall.size(); ++node)
        at_driving_wall[node] = at_driving_wall[node]
                                || foot(domain, side, mesh.nodes[node]).distance
                                       < within_wall * mesh.spacing;
    }
  }

  bool lies_along_wall(const AppearanceSetting &setting,
                       const std::vector<unsigned int> &nodes)
  {
    return nodes_at_driving_walls(setting, nodes) > 1;
  }

  double largest_excess(const AppearanceSetting &setting,
                        const std::array<double, 2> &tolerated, const Values &level_set,
                        const std::array<Values, 2> &heat)
  {
    const Values volume = volume_of_hats(setting.mesh);
    double result = 0;
    for(unsigned int node = 0; node < level_set.size(); ++node)
      if(volume[node] > 0 && is_away_from_front(setting, level_set, node))
      {
        const Phase phase = phase_of(level_set, node);
        result = std::max(result, heat_beyond_melting(heat, node, phase)
                                      / (volume[node] * tolerated[index(phase)]));
      }
    return result;
  }

  std::vector<Appearance> let_phases_appear(const AppearanceSetting &setting,
                                            const std::array<double, 2> &tolerated,
                                            FrontState &state)
  {
    const bool beyond_tolerance
        = largest_excess(setting, tolerated, state.level_set, state.heat) > appears_at;
    std::vector<Appearance> result;
    for(const Patch &patch : patches(setting, state))
    {
      const auto body = body_of(setting, state, patch, beyond_tolerance);
      if(!body)
        continue;
      const std::optional<double> area = put(setting, *body, patch, state);
      if(!area)
        continue;
      result.push_back({patch.phase == Phase::liquid ? Phase::solid : Phase::liquid,
                        *area, setting.mesh.nodes[patch.nodes.front()]});
    }
    return result;
  }
} // namespace meltfront::reference_fem::cut::conservative
