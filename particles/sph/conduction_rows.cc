#include <cases/stopwatch.h>
#include <cases/wall_law.h>
#include <particles/sph/bent_walls.h>
#include <particles/sph/conduction_rows.h>
#include <particles/sph/outline_shares.h>
#include <particles/sph/square_lattice.h>
#include <particles/sph/wall_areas.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  using cases::BoundaryKind;

  namespace
  {
    /** A set of plane walls, one bit each: the image of a particle mirrored in all of
     * them. */
    using WallSet = unsigned;

    /** Assembles the rows of one discretisation. */
    class Assembly
    {
    public:
      Assembly(const Discretisation &discretisation, bool moment_correction,
               ConductionRows &result)
        : dis(discretisation)
        , square(discretisation)
        , result(result)
        , in_sight(dis, NeighbourList(square.particles(), reach_of_kernel(),
                                      square.periodicity()))
        , neighbours(in_sight.seen)
        , ghost_neighbours(dis.particles, dis.ghosts, reach_of_kernel())
      {
        find_walls_in_reach();
        if(dis.scene.inclusion)
          find_conductivities();
        if(moment_correction)
          correct_second_moment();
      }

      void assemble()
      {
        std::vector<double> coefficients(neighbours.size());
        std::vector<double> row_sum(dis.particles.size(), 0.);
        for(std::size_t a = 0; a < dis.particles.size(); ++a)
        {
          std::size_t e = neighbours.offset(a);
          for(const std::uint32_t b : neighbours[a])
          {
            coefficients[e] = pair_coefficient(a, b);
            row_sum[a] += std::abs(coefficients[e++]);
          }
          if(!dis.own.holds(a))
            continue;
          if(dis.layout == LatticeLayout::cell_centred)
            link_to_images(a);
          else
            link_to_edges(a);
          link_to_ghosts(a);
        }
        if(!crossings.empty())
          link_to_outline();
        share_walls(dis, {result.flux_points, result.flux_links});
        share_walls(dis, {result.exchange_points, result.exchange_links,
                          &result.exchange_depths});
        for(const WallLink &link : result.temperature_links)
          row_sum[link.row] += link.strength;
        // At most what a wall of given temperature would exchange.
        for(std::size_t i = 0; i < result.exchange_links.size(); ++i)
          row_sum[result.exchange_links[i].row]
              += result.exchange_links[i].strength / result.exchange_depths[i];
        for(const std::uint32_t a : dis.dirichlet)
          row_sum[a] = 0;
        result.wall_cells = dis.wall_cells;
        result.take_per_cell(row_sum);
        const auto own_sums = dis.own.part(std::span<const double>(row_sum));
        result.largest_row_sum
            = dis.own.largest(*std::max_element(own_sums.begin(), own_sums.end()));
        result.rows = ParticleOperator(neighbours, coefficients);
      }

    private:
      /** The support, without the pairs that rounding alone puts inside it. */
      double reach_of_kernel() const
      {
        return dis.kernel.support() * (1 - 1e-9);
      }

      void find_conductivities()
      {
        const cases::ScopedTimer timer(result.inclusion_cost.seconds);
        const cases::Scene &scene = dis.scene;
        conductivity.resize(dis.particles.size());
        for(std::size_t i = 0; i < conductivity.size(); ++i)
          conductivity[i] = scene.conductivity_at(dis.particles.point(i))
                            / scene.material.solid.conductivity;
        ++result.inclusion_cost.calls;
        result.inclusion_cost.bytes
            = static_cast<long>(conductivity.size() * sizeof(double));
      }

      /** Mean conductivity between two particles, over that outside of the inclusion. */
      double between(std::size_t a, std::size_t b) const
      {
        return conductivity.empty() ? 1.
                                    : 2 * conductivity[a] * conductivity[b]
                                          / (conductivity[a] + conductivity[b]);
      }

      /** Circumference at the middle of a pair about an axis, else 1. The same bits for
       * (a, b) and (b, a). */
      double circumference(std::size_t a, std::size_t b, WallSet mirrors) const
      {
        using std::numbers::pi;
        if(dis.scene.domain.shape != cases::DomainShape::axisymmetric)
          return 1;
        for(std::size_t w = 0; w < dis.walls.size(); ++w)
          if(mirrors >> w & 1 && dis.walls[w].direction == 0)
            return 2 * pi * dis.walls[w].coordinate;
        return pi * (dis.particles.position[0][a] + dis.particles.position[0][b]);
      }

      void find_walls_in_reach()
      {
        reach.assign(dis.particles.size(), 0);
        for(std::size_t w = 0; w < dis.walls.size(); ++w)
        {
          const auto &[boundary, direction, coordinate] = square.walls()[w];
          const auto &x = square.particles().position[direction];
          for(std::size_t i = 0; i < x.size(); ++i)
            if(std::abs(x[i] - coordinate) < dis.kernel.support())
              reach[i] |= 1u << w;
        }
      }

      /** The walls beyond which images of a particle act on another: none in the edge
       * layout, where particles lie on the walls. */
      WallSet common_walls(std::size_t a, std::size_t b) const
      {
        return dis.layout == LatticeLayout::cell_centred ? reach[a] & reach[b] : 0;
      }

      /** Visit the non-empty subsets of a set that hold at most one wall per direction.
       */
      template <typename Visit>
      void visit_images(WallSet set, const Visit &visit) const
      {
        for(WallSet subset = set; subset != 0; subset = (subset - 1) & set)
        {
          std::array<int, 3> used{};
          bool valid = true;
          for(std::size_t w = 0; w < dis.walls.size(); ++w)
            if(subset >> w & 1)
              valid = valid && ++used[dis.walls[w].direction] == 1;
          if(valid)
            visit(subset);
        }
      }

      using Step = std::array<double, 3>;

      /** The step between one particle and the image of another where cells are squares.
       * The same bits but for signs for (a, b) and (b, a). */
      Step step_between(std::size_t a, std::size_t b, WallSet mirrors) const
      {
        const auto [first, second] = std::minmax(a, b);
        const auto &position = square.particles().position;
        Step step{};
        for(int d = 0; d < dis.dimension; ++d)
          step[d] = square.periodicity().shortest(d, position[d][first]
                                                         - position[d][second]);
        for(std::size_t w = 0; w < dis.walls.size(); ++w)
          if(mirrors >> w & 1)
          {
            const auto &[boundary, d, coordinate] = square.walls()[w];
            step[d]
                = (position[d][first] - coordinate) + (position[d][second] - coordinate);
          }
        return step;
      }

      static double squared_length(const Step &step)
      {
        return step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
      }

      /** g of a particle and the image of another. */
      double pair_strength(std::size_t a, std::size_t b, WallSet mirrors) const
      {
        const Step step = step_between(a, b, mirrors);
        const double squared = squared_length(step);
        return strength(a, b, squared) * square.by_direction(step, squared);
      }

      /** -F(r) */
      double slope(double squared) const
      {
        const double distance = std::sqrt(squared);
        return distance < reach_of_kernel()
                   ? -dis.kernel.radial_derivative_over_distance(distance)
                   : 0.;
      }

      /** g of a pair at a distance. */
      double strength(std::size_t a, std::size_t b, double squared) const
      {
        const double correction = inverse_moment.empty()
                                      ? 1 / result.second_moment
                                      : 0.5 * (inverse_moment[a] + inverse_moment[b]);
        return 2 * dis.particle_volume * dis.particle_volume * slope(squared)
               * correction;
      }

      /** True if the image's deviation from the wall is the opposite of the particle's.
       */
      bool antisymmetric(WallSet mirrors) const
      {
        bool odd = false;
        for(std::size_t w = 0; w < dis.walls.size(); ++w)
          if(mirrors >> w & 1
             && dis.walls[w].boundary->kind == BoundaryKind::fixed_temperature)
            odd = !odd;
        return odd;
      }

      double pair_coefficient(std::size_t a, std::size_t b) const
      {
        const double mean = between(a, b);
        double g = mean * pair_strength(a, b, 0) * circumference(a, b, 0);
        visit_images(common_walls(a, b),
                     [&](WallSet mirrors)
                     {
                       const double image = mean * pair_strength(a, b, mirrors)
                                            * circumference(a, b, mirrors);
                       g += antisymmetric(mirrors) ? -image : image;
                     });
        return g;
      }

      /** What the images of all particles, its own among them, add to a row. */
      void link_to_images(std::size_t a)
      {
        std::vector<double> to_temperature(dis.walls.size(), 0.);
        std::vector<double> to_flux(dis.walls.size(), 0.);
        const auto add = [&](std::size_t b)
        {
          visit_images(common_walls(a, b),
                       [&](WallSet mirrors)
                       {
                         const double image = pair_strength(a, b, mirrors)
                                              * circumference(a, b, mirrors);
                         for(std::size_t w = 0; w < dis.walls.size(); ++w)
                         {
                           if(!(mirrors >> w & 1))
                             continue;
                           const auto &[boundary, d, coordinate] = dis.walls[w];
                           const double depth
                               = std::abs(dis.particles.position[d][b] - coordinate);
                           if(cases::prescribes_heat(boundary->kind))
                             to_flux[w] += 2 * depth * image;
                           if(boundary->kind == BoundaryKind::fixed_temperature
                              && antisymmetric(mirrors))
                           {
                             to_temperature[w] += 2 * between(a, b) * image;
                             break; // an image belongs to one wall
                           }
                         }
                       });
        };
        add(a);
        for(const std::uint32_t b : neighbours[a])
          add(b);
        for(std::size_t w = 0; w < dis.walls.size(); ++w)
        {
          add_link(result.temperature_points, result.temperature_links, a, dis.walls[w],
                   to_temperature[w]);
          add_heat_link(a, dis.walls[w], to_flux[w]);
        }
      }

      /** Edge layout: particles on a wall take its flux; those at a prescribed
       * temperature are held. */
      void link_to_edges(std::size_t a)
      {
        for(const PlaneWall &wall : dis.walls)
          if(wall.boundary->kind == BoundaryKind::flux && dis.on_wall(wall, a))
            add_link(result.flux_points, result.flux_links, a, wall,
                     dis.particle_volume / dis.spacing);
      }

      /** A particle's share of the area of a wall through which heat is to flow. */
      void add_heat_link(std::size_t a, const PlaneWall &wall, double strength)
      {
        if(!cases::exchanges_heat(wall.boundary->kind))
          return add_link(result.flux_points, result.flux_links, a, wall, strength);
        add_link(result.exchange_points, result.exchange_links, a, wall, strength);
        if(strength > 0)
          result.exchange_depths.push_back(std::max(
              std::abs(dis.particles.position[wall.direction][a] - wall.coordinate),
              shallowest_depth * dis.spacing));
      }

      void add_link(std::vector<WallPoint> &points, std::vector<WallLink> &links,
                    std::size_t a, const PlaneWall &wall, double strength) const
      {
        if(strength <= 0)
          return;
        links.push_back({static_cast<std::uint32_t>(a),
                         static_cast<std::uint32_t>(points.size()), strength});
        points.push_back({wall.boundary, wall.project(dis.particles.point(a))});
      }

      /**
       * Walls that bend. Where the temperature is known beyond the wall, ghosts hold it.
       * Otherwise the line from the particle through the wall's value is continued to the
       * ghost (Morris, Fox and Zhu 1997). Particles that an outline hides are ghosts to
       * each other.
       */
      void link_to_ghosts(std::size_t a)
      {
        if(dis.ghosts.size() > 0)
          for(const std::uint32_t ghost : ghost_neighbours[a])
            link_to_ghost(a, dis.ghosts.point(ghost));
        if(in_sight.hidden && !insulated_outline())
          for(const std::uint32_t b : (*in_sight.hidden)[a])
            link_to_ghost(a, dis.particles.point(b));
      }

      bool insulated_outline() const
      {
        return dis.scene.boundary(cases::Side::outer).kind == BoundaryKind::insulated;
      }

      void link_to_ghost(std::size_t a, const cases::Position &ghost)
      {
        const cases::Position own = dis.particles.point(a);
        double squared = 0;
        for(int d = 0; d < dis.dimension; ++d)
          squared += (own[d] - ghost[d]) * (own[d] - ghost[d]);
        const double g = between(a, a) * strength(a, a, squared);
        if(g == 0)
          return;
        const LineToGhost line = line_to_ghost(dis, own, ghost);
        const BoundaryKind kind = line.boundary->kind;
        const bool exchange = cases::exchanges_heat(kind),
                   flux = cases::prescribes_heat(kind);
        if(flux && dis.scene.domain.outline)
        {
          crossings.push_back(
              {static_cast<std::uint32_t>(a), line.place, g * line.across});
          return;
        }
        auto &points = exchange ? result.exchange_points
                       : flux   ? result.flux_points
                                : result.temperature_points;
        auto &links = exchange ? result.exchange_links
                      : flux   ? result.flux_links
                               : result.temperature_links;
        if(exchange)
          result.exchange_depths.push_back(line.depth);
        links.push_back({static_cast<std::uint32_t>(a),
                         static_cast<std::uint32_t>(points.size()),
                         g * (flux ? line.across : line.extension)});
        points.push_back({line.boundary, line.place});
      }

      void link_to_outline()
      {
        const cases::Boundary &boundary = dis.scene.boundary(cases::Side::outer);
        const bool exchange = cases::exchanges_heat(boundary.kind);
        auto &points = exchange ? result.exchange_points : result.flux_points;
        auto &links = exchange ? result.exchange_links : result.flux_links;
        for(const OutlineShare &share : share_outline(dis, crossings))
        {
          if(points.empty() || points.back().position != share.place)
            points.push_back({&boundary, share.place});
          links.push_back({share.particle, static_cast<std::uint32_t>(points.size() - 1),
                           share.length});
          if(exchange)
            result.exchange_depths.push_back(share.depth);
        }
      }

      /**
       * mu_a = -(1/d) sum_b V_b F_ab r_ab^2. Summed where particles are displaced and
       * images or ghosts complete the support; the lattice's value elsewhere.
       */
      void correct_second_moment()
      {
        result.second_moment = lattice_second_moment(dis.kernel, dis.spacing);
        if(!dis.displaced)
          return;
        inverse_moment.assign(dis.particles.size(), 1 / result.second_moment);
        const double factor = dis.particle_volume / dis.dimension;
        for(std::size_t a = 0; a < dis.particles.size(); ++a)
        {
          if(!complete_support(a))
            continue;
          double sum = 0;
          const auto add = [&](double squared) { sum += slope(squared) * squared; };
          const auto add_images = [&](std::size_t b)
          {
            visit_images(common_walls(a, b), [&](WallSet mirrors)
                         { add(squared_length(step_between(a, b, mirrors))); });
          };
          add_images(a);
          for(const std::uint32_t b : neighbours[a])
          {
            add(squared_length(step_between(a, b, 0)));
            add_images(b);
          }
          for(std::size_t g = 0; dis.ghosts.size() > 0 && g < ghost_neighbours[a].size();
              ++g)
          {
            double squared = 0;
            for(int d = 0; d < dis.dimension; ++d)
            {
              const double difference = dis.particles.position[d][a]
                                        - dis.ghosts.position[d][ghost_neighbours[a][g]];
              squared += difference * difference;
            }
            add(squared);
          }
          inverse_moment[a] = 1 / (factor * sum);
        }
      }

      bool complete_support(std::size_t a) const
      {
        if(dis.scene.domain.outline)
          return dis.scene.domain.outline->distance(dis.particles.point(a))
                 > dis.kernel.support();
        if(!dis.scene.domain.round())
          return dis.layout == LatticeLayout::cell_centred || reach[a] == 0;
        const auto own = dis.particles.point(a);
        const double distance = std::hypot(own[0], own[1], own[2]);
        for(const RoundWall &wall : dis.round_walls)
          if(wall.boundary->kind == BoundaryKind::insulated
             && wall.depth(distance) <= dis.kernel.support())
            return false;
        return true;
      }

      const Discretisation &dis;
      const SquareLattice square;
      ConductionRows &result;
      const NeighboursInSight in_sight;
      const NeighbourList &neighbours;
      NeighbourList ghost_neighbours;
      std::vector<OutlineCrossing> crossings; ///< where an outline gives or takes heat
      std::vector<WallSet> reach; ///< the walls within a support of each particle
      std::vector<double> inverse_moment;
      std::vector<double> conductivity; ///< over that outside of an inclusion; or empty
    };
  } // namespace

  ConductionRows::ConductionRows(const Discretisation &discretisation,
                                 bool moment_correction)
  {
    Assembly(discretisation, moment_correction, *this).assemble();
  }
} // namespace meltfront::particles
