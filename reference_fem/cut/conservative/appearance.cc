#include <reference_fem/cut/conservative/appearance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Spacings from a front within which heat beyond the melting temperature is an error
     * of the elements, and not a phase to come. */
    constexpr double away_from_front = 2.5;

    /** Spacings: thickness of the thinnest layer that appears; and from a wall, within
     * which heat belongs to a layer on it. */
    constexpr double thinnest = 0.05, near_wall = 6;

    /** Of what is tolerated beyond the melting temperature. */
    constexpr double appears_at = 0.5;

    /** Squares of the spacing: the smallest body that appears. */
    constexpr double smallest = 0.2;

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

    std::vector<Patch> patches(const TriangleMesh &mesh, const FrontState &state,
                               double latent_heat)
    {
      std::vector<std::vector<unsigned int>> neighbours(mesh.nodes.size());
      for(const Triangle &triangle : mesh.triangles)
        for(std::size_t i = 0; i < 3 && !triangle.part.empty(); ++i)
          for(const std::size_t j : {(i + 1) % 3, (i + 2) % 3})
            neighbours[triangle.nodes[i]].push_back(triangle.nodes[j]);
      const auto takes_part = [&](unsigned int node)
      {
        return std::abs(state.level_set[node]) > away_from_front * mesh.spacing
               && area_due(state, node, phase_of(state.level_set, node), latent_heat) > 0;
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

    /** The distance to what appears, negative in it, at all nodes. */
    std::optional<Values> body_of(const TriangleMesh &mesh, const cases::Domain &domain,
                                  const std::vector<cases::Side> &sides,
                                  const FrontState &state, const Patch &patch,
                                  double latent_heat, bool beyond_tolerance)
    {
      Thickness thickness(mesh);
      double area = 0, of_walls = 0, farthest = 0;
      unsigned int deepest = patch.nodes.front();
      for(const unsigned int node : patch.nodes)
      {
        const double due = area_due(state, node, patch.phase, latent_heat);
        area += due;
        if(due > farthest)
        {
          farthest = due;
          deepest = node;
        }
        const auto nearest = std::ranges::min_element(
            sides, {},
            [&](cases::Side side)
            { return foot(domain, side, mesh.nodes[node]).distance; });
        const Foot below = foot(domain, *nearest, mesh.nodes[node]);
        if(below.distance > near_wall * mesh.spacing)
          continue;
        of_walls += due;
        thickness.add(*nearest, below.place, due);
      }
      if(area < smallest * mesh.spacing * mesh.spacing)
        return std::nullopt;
      Values result(mesh.nodes.size());
      const bool on_wall = of_walls > area / 2;
      if(on_wall && !beyond_tolerance && thickness.largest() < thinnest * mesh.spacing)
        return std::nullopt;
      for(std::size_t node = 0; node < result.size(); ++node)
        if(!on_wall)
          result[node] = mesh.nodes[node].distance(mesh.nodes[deepest])
                         - std::sqrt(area / std::numbers::pi);
        else
        {
          result[node] = std::numeric_limits<double>::infinity();
          for(const cases::Side side : sides)
          {
            const Foot below = foot(domain, side, mesh.nodes[node]);
            if(below.distance < 2 * mesh.spacing)
              result[node] = std::min(result[node],
                                      below.distance - thickness.at(side, below.place));
          }
        }
      return result;
    }
  } // namespace

  double largest_excess(const TriangleMesh &mesh, const std::array<double, 2> &tolerated,
                        const Values &level_set, const std::array<Values, 2> &heat)
  {
    const Values volume = volume_of_hats(mesh);
    double result = 0;
    for(unsigned int node = 0; node < level_set.size(); ++node)
      if(volume[node] > 0 && std::abs(level_set[node]) > away_from_front * mesh.spacing)
      {
        const Phase phase = phase_of(level_set, node);
        result = std::max(result, heat_beyond_melting(heat, node, phase)
                                      / (volume[node] * tolerated[index(phase)]));
      }
    return result;
  }

  std::vector<Appearance> let_phases_appear(const TriangleMesh &mesh,
                                            const cases::Domain &domain,
                                            double latent_heat,
                                            const std::array<double, 2> &tolerated,
                                            double reach, FrontState &state)
  {
    std::vector<cases::Side> sides;
    for(const WallPiece &wall : mesh.walls)
      if(std::ranges::find(sides, wall.side) == sides.end())
        sides.push_back(wall.side);
    const bool beyond_tolerance
        = largest_excess(mesh, tolerated, state.level_set, state.heat) > appears_at;
    std::vector<Appearance> result;
    for(const Patch &patch : patches(mesh, state, latent_heat))
    {
      const auto body
          = body_of(mesh, domain, sides, state, patch, latent_heat, beyond_tolerance);
      if(!body)
        continue;
      const Values before = Front(mesh, state.level_set).solid_area;
      const double sign = patch.phase == Phase::liquid ? 1 : -1;
      for(std::size_t node = 0; node < body->size(); ++node)
        state.level_set[node]
            = sign * std::min(sign * state.level_set[node], (*body)[node]);
      state.level_set = without_zeros(std::move(state.level_set), mesh.spacing);
      const Front front(mesh, state.level_set);
      double due = 0, put = 0;
      for(const unsigned int node : patch.nodes)
      {
        const double area = area_due(state, node, patch.phase, latent_heat);
        due += sign * area;
        state.heat[index(patch.phase)][node] += sign * latent_heat * area;
      }
      for(std::size_t node = 0; node < before.size(); ++node)
        put += front.solid_area[node] - before[node];
      for(std::size_t node = 0; node < before.size(); ++node)
        state.debt[node] += (due / put - 1) * (front.solid_area[node] - before[node]);
      state.level_set = with_distances(mesh, front, state.level_set, reach);
      result.push_back({patch.phase == Phase::liquid ? Phase::solid : Phase::liquid,
                        std::abs(due), mesh.nodes[patch.nodes.front()]});
    }
    return result;
  }
} // namespace meltfront::reference_fem::cut::conservative
