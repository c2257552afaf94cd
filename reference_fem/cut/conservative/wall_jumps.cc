#include <reference_fem/cut/conservative/conservative_run.h>

#include <cases/exact/front_start.h>
#include <cases/mean_with_jumps.h>
#include <cases/means_of_jumps.h>
#include <cases/overshoot.h>
#include <cases/time_integral.h>
#include <cases/wall_law.h>
#include <reference_fem/cut/run.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Steps of backward Euler after a jump of the data at a wall. */
    constexpr int damping_steps = 4;

    /** Of the largest datum: what counts as a jump. */
    constexpr double least_jump = 1e-3;

    /** Of the run: how long after a breakpoint data are read for what they jump to. */
    constexpr double just_after = 1e-9;

    cases::Position middle(const WallPiece &wall)
    {
      return position(wall.segment.begin + (wall.segment.end - wall.segment.begin) / 2);
    }
  } // namespace

  /** Whether a wall is held, at the start, beyond the melting temperature of the phase
   * that lies at it, by more than temperatures may overshoot: a layer is there at once.
   */
  bool ConservativeRun::layer_appears_at_once(const cases::FrontStart &found) const
  {
    double largest = 0, farthest = 0;
    for(const WallPiece &wall : mesh.walls)
    {
      const cases::Boundary &boundary = scene.boundary(wall.side);
      if(boundary.kind != cases::BoundaryKind::fixed_temperature || boundary.exact)
        continue;
      const cases::Position place = middle(wall);
      const double excess
          = boundary.value(place, scene.start_time) - scene.material.melting_temperature;
      largest = std::max(largest, std::abs(excess));
      farthest = std::max(farthest, found.level_set(place) < 0 ? excess : -excess);
    }
    return farthest > cases::allowed_overshoot(cut::overshoot, mesh.spacing, scene.domain)
                          * largest;
  }

  /** Whether temperatures jump at the start, between nodes of a triangle. */
  bool ConservativeRun::starts_with_jumps() const
  {
    if(!cases::may_jump_at_start(scene))
      return false;
    const auto temperature = [&](const cases::Position &place)
    { return scene.initial.temperature(place, scene.start_time); };
    Values values;
    for(const Point &node : mesh.nodes)
      values.push_back(temperature(position(node)));
    const auto [lowest, highest] = std::ranges::minmax(values);
    const double least = cases::negligible_jump * (highest - lowest);
    return std::ranges::any_of(mesh.triangles,
                               [&](const Triangle &triangle)
                               {
                                 if(triangle.part.empty())
                                   return false;
                                 for(std::size_t side = 0; side < 3; ++side)
                                 {
                                   const unsigned int from = triangle.nodes[side],
                                                      to = triangle.nodes[(side + 1) % 3];
                                   if(std::abs(values[to] - values[from]) > least
                                      && cases::jump_between(temperature,
                                                             position(mesh.nodes[from]),
                                                             position(mesh.nodes[to]))
                                                 .height
                                             > least)
                                     return true;
                                 }
                                 return false;
                               });
  }

  /** Damp the coming steps where walls that hold temperatures hold other ones than those
   * that the scene begins with. */
  void ConservativeRun::damp_jump_at_start(
      const std::function<double(const cases::Position &)> &temperature)
  {
    damp_jump(
        [&](const WallPiece &wall, const cases::Boundary &boundary)
        {
          return boundary.kind == cases::BoundaryKind::fixed_temperature
                     ? temperature(middle(wall))
                     : boundary.value(middle(wall), time);
        },
        time);
  }

  /** The same where data jump at the end of a step. */
  void ConservativeRun::damp_jump_after_step(double began)
  {
    damp_jump([&](const WallPiece &wall, const cases::Boundary &boundary)
              { return cases::value_at_end(boundary.value, middle(wall), began, time); },
              time + just_after * (scene.end_time - scene.start_time));
  }

  /** @param before what a wall's datum is a jump from */
  void ConservativeRun::damp_jump(
      const std::function<double(const WallPiece &, const cases::Boundary &)> &before,
      double after)
  {
    // Of fluxes, and of temperatures over the melting point.
    struct
    {
      double jump = 0, size = 0;
    } largest[2];
    for(const WallPiece &wall : mesh.walls)
    {
      const cases::Boundary &boundary = scene.boundary(wall.side);
      if(boundary.kind == cases::BoundaryKind::insulated
         || boundary.kind == cases::BoundaryKind::periodic)
        continue;
      const bool flux = boundary.kind == cases::BoundaryKind::flux;
      const double rest = flux ? 0 : scene.material.melting_temperature,
                   was = before(wall, boundary),
                   given = boundary.value(middle(wall), after);
      auto &[jump, size] = largest[flux ? 0 : 1];
      jump = std::max(jump, std::abs(given - was));
      size = std::max({size, std::abs(given - rest), std::abs(was - rest)});
    }
    if(std::ranges::none_of(largest, [](const auto &of)
                            { return of.jump > least_jump * of.size; }))
      return;
    damped_steps = damping_steps;
    layer_resolved = time + damping_steps * damping_step();
  }

  /** The shortest step of backward Euler in which linear elements smooth a jump and do
   * not overshoot: h^2/(3 alpha), from which on no two nodes are coupled by mass more
   * than by conduction. */
  double ConservativeRun::damping_step() const
  {
    return mesh.spacing * mesh.spacing
           / (3
              * std::min(scene.material.solid.diffusivity(),
                         scene.material.liquid.diffusivity()));
  }
} // namespace meltfront::reference_fem::cut::conservative
