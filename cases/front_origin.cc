#include <cases/capabilities.h>
#include <cases/dense_sampling.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    /** Off a wall by this share of the domain's side: initial and wall value may differ
     * at the wall itself. */
    constexpr double next_to_wall = 1e-6;

    /** Relative to |T_m| and the largest |T - T_m|: nearer to the melting point is at it.
     * What an exact solution keeps there misses it by round-off. */
    constexpr double share_of_round_off = 1e-9;

    /** Samples may pass by the extremes of a metastable phase by this share of them. */
    constexpr double share_of_sampling = 1e-3;

    enum class InitialPhase
    {
      solid,
      liquid,
      mush
    };

    class Start
    {
    public:
      explicit Start(const Scene &scene)
        : scene(scene)
        , metastable(metastable_start(scene))
      {
        std::vector<const Field *> fields{&scene.initial.temperature};
        if(scene.initial.front)
          fields.push_back(&*scene.initial.front);
        std::vector<std::pair<double, double>> values;
        visit_densely(scene, fields,
                      [&](const Position &p)
                      {
                        values.emplace_back(front(p), excess(p));
                        if(std::isfinite(values.back().second))
                          largest = std::max(largest, std::abs(values.back().second));
                      });
        for(const auto &[front, excess] : values)
          found[static_cast<std::size_t>(phase(front, excess))] = true;
      }

      InitialPhase phase(const Position &p) const
      {
        return phase(front(p), excess(p));
      }

      /** A temperature nearer to the melting point than this is at it (K). */
      double round_off() const
      {
        return share_of_round_off
               * std::max(largest, std::abs(scene.material.melting_temperature));
      }

      /** How far beyond the melting point a wall must be for what lies at it to change
       * its phase (K): a metastable phase stands the temperatures that it has at the
       * start, there and next to the wall. */
      double withstood_by(InitialPhase of, Side side,
                          const std::vector<Position> &walls) const
      {
        const bool solid = of == InitialPhase::solid;
        double most = solid ? metastable.superheat : metastable.undercooling;
        for(const Position &wall : walls)
        {
          const double next_to = excess(inside_of(side, wall));
          most = std::max(most, solid ? next_to : -next_to);
        }
        return (1 + share_of_sampling) * most + round_off();
      }

      bool has(InitialPhase wanted) const
      {
        return found[static_cast<std::size_t>(wanted)];
      }

      /** What lies at a wall inside of a point of it. */
      InitialPhase phase_at_wall(Side side, const Position &wall) const
      {
        return phase(inside_of(side, wall));
      }

    private:
      Position inside_of(Side side, Position wall) const
      {
        const Domain &domain = scene.domain;
        if(domain.irregular())
          return wall;
        if(side == Side::outer || side == Side::inner)
          for(double &component : wall)
            component *= 1 + (side == Side::inner ? 1 : -1) * next_to_wall;
        else
          wall[static_cast<std::size_t>(side) / 2]
              += (static_cast<int>(side) % 2 == 0 ? 1 : -1) * next_to_wall
                 * domain.side();
        return wall;
      }

      InitialPhase phase(double front, double excess) const
      {
        const double sign = front != 0 ? front : excess;
        if(front != 0 || std::abs(sign) > round_off())
          return sign < 0 ? InitialPhase::solid : InitialPhase::liquid;
        const double fraction = scene.initial.solid_fraction_at_melting;
        return fraction == 1   ? InitialPhase::solid
               : fraction == 0 ? InitialPhase::liquid
                               : InitialPhase::mush;
      }

      double front(const Position &p) const
      {
        return scene.initial.front ? (*scene.initial.front)(p, scene.start_time) : 0;
      }

      double excess(const Position &p) const
      {
        const double value = scene.initial.temperature(p, scene.start_time)
                             - scene.material.melting_temperature;
        return std::isnan(value) ? 0 : value;
      }

      const Scene &scene;
      MetastableStart metastable;
      double largest = 0;
      std::array<bool, 3> found{}; ///< by InitialPhase
    };

    /** Whether the temperature of a wall is ever on the other side of the melting point
     * than what lies at it at the start. */
    bool starts_front(const Scene &scene, const Start &start, Side side)
    {
      const Boundary &boundary = scene.boundary(side);
      if(boundary.kind != BoundaryKind::fixed_temperature)
        return false;
      std::vector<Position> solid, liquid;
      visit_wall(scene.domain, side,
                 [&](const Position &wall)
                 {
                   const InitialPhase phase = start.phase_at_wall(side, wall);
                   if(phase != InitialPhase::mush)
                     (phase == InitialPhase::solid ? solid : liquid).push_back(wall);
                 });
      bool found = false;
      const auto look = [&](InitialPhase of, const std::vector<Position> &positions)
      {
        const double withstood = start.withstood_by(of, side, positions);
        const double sign = of == InitialPhase::solid ? 1 : -1;
        visit_values_in_time(scene, boundary.value, positions,
                             [&](double temperature)
                             {
                               const double excess
                                   = temperature - scene.material.melting_temperature;
                               found = found || sign * excess > withstood;
                             });
      };
      look(InitialPhase::solid, solid);
      look(InitialPhase::liquid, liquid);
      return found;
    }

    int walls_that_start_fronts(const Scene &scene, const Start &start)
    {
      const auto sides = scene.sides();
      return static_cast<int>(std::ranges::count_if(
          sides, [&](Side side) { return starts_front(scene, start, side); }));
    }

    int sources_that_start_fronts(const Scene &scene, const Start &start)
    {
      // The heat of a plane of sources spreads before anything freezes.
      if(scene.domain.shape == DomainShape::slab)
        return 0;
      return static_cast<int>(
          std::ranges::count_if(scene.sources,
                                [&](const PointSource &source)
                                {
                                  const double energy = source.energy(scene.end_time);
                                  const InitialPhase phase = start.phase(source.position);
                                  return (energy < 0 && phase == InitialPhase::liquid)
                                         || (energy > 0 && phase == InitialPhase::solid);
                                }));
    }

    /** Changes of phase along x or along a radius. */
    int fronts_on_line(const Scene &scene, const Start &start)
    {
      constexpr int points = 1025;
      const Domain &domain = scene.domain;
      const double lower = domain.round() ? domain.inner_radius : domain.lower[0];
      const double upper = domain.round() ? domain.radius : domain.upper[0];
      int fronts = 0;
      std::optional<bool> was_solid;
      for(int i = 0; i < points; ++i)
      {
        const InitialPhase phase
            = start.phase({lower + (upper - lower) * i / (points - 1), 0, 0});
        if(phase == InitialPhase::mush)
          continue;
        const bool solid = phase == InitialPhase::solid;
        fronts += was_solid && *was_solid != solid;
        was_solid = solid;
      }
      return fronts;
    }
  } // namespace

  std::vector<FrontOrigin> front_origins(const Scene &scene)
  {
    if(!scene.changes_phase())
      return {FrontOrigin::none};
    if(scene.alloy || scene.material.melting_range)
      return {};
    const Start start(scene);
    std::vector<FrontOrigin> result;
    if(start.has(InitialPhase::solid) && start.has(InitialPhase::liquid))
      result.push_back(FrontOrigin::initial_front);
    if(start.has(InitialPhase::mush))
      result.push_back(FrontOrigin::partly_melted);
    if(walls_that_start_fronts(scene, start) > 0)
      result.push_back(FrontOrigin::wall);
    if(sources_that_start_fronts(scene, start) > 0)
      result.push_back(FrontOrigin::source);
    return result;
  }

  int least_number_of_fronts(const Scene &scene)
  {
    if(!scene.changes_phase() || scene.alloy || scene.material.melting_range)
      return 0;
    const Start start(scene);
    const bool line = scene.symmetry != Symmetry::none;
    const int initial
        = line ? fronts_on_line(scene, start)
               : start.has(InitialPhase::solid) && start.has(InitialPhase::liquid);
    return initial + walls_that_start_fronts(scene, start)
           + sources_that_start_fronts(scene, start);
  }
} // namespace meltfront::cases
