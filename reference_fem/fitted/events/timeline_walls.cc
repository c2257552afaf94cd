#include <reference_fem/fitted/events/timeline.h>

#include <cases/error.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using dealii::Vector;

    /** A wall that is so shortly after it has passed the melting temperature, of the time
     * to the seed, as far off it as this share of what it is at the seed, has jumped. */
    constexpr double shortly = 1e-3, already = 0.1;

    /** Difference of a wall's values, of the larger, that is a jump. */
    constexpr double least_jump_of_wall = 1e-3;

    /** A wall that passes the melting temperature within this share of the time from
     * another one's passing to its seed has its front seeded with that. */
    constexpr double together = 0.5;
  } // namespace

  std::optional<RunSegment> Timeline::set_out(const RunSegment &segment,
                                              const LayeredState &state) const
  {
    const bool starts_here = state.time == setting.scene.start_time;
    std::vector<SuddenStart> starts;
    if(starts_here)
      starts = sudden_starts(setting, state);
    else
      for(const bool inner : {true, false})
        if(auto start = start_at_wall(setting, state, inner))
          starts.push_back(*start);
    const std::array<cases::WallLayer, 2> forms = layers_at_walls(setting, state);
    std::erase_if(starts,
                  [&](const SuddenStart &start)
                  {
                    const bool inner = start.at_inner_end;
                    return !(starts_here && state.fronts.empty())
                           && (forms[inner ? 0 : 1].jump == 0
                               || !phases.has_passed(*segment.problem, inner, 0,
                                                     state.time, segment.state));
                  });
    if(!starts.empty())
      return seeded_stretch(setting, starts, state);
    if(forms[0].forms() || forms[1].forms())
      return drawn_to_walls(setting, segment, forms);
    return std::nullopt;
  }

  double Timeline::next_jump(const double time) const
  {
    double result = std::numeric_limits<double>::infinity();
    if(!follows_events())
      return result;
    const RayScene &rays = setting.rays;
    const RayMesh geometry(rays.surface, rays.inner, rays.outer, {0, 1});
    for(const bool inner : {true, false})
    {
      if(inner && geometry.has_centre())
        continue;
      const cases::Boundary &wall = setting.scene.boundary(side_at(setting.scene, inner));
      if(wall.kind == cases::BoundaryKind::insulated || wall.exact)
        continue;
      const cases::Position place = geometry.position(0, inner ? rays.inner : rays.outer);
      for(const double point : wall.value.breakpoints)
      {
        const double shift = beside_jump();
        if(!(point - shift > time) || !(point + shift < setting.scene.end_time))
          continue;
        const double before = wall.value(place, point - shift),
                     behind = wall.value(place, point + shift);
        if(std::abs(behind - before)
           > least_jump_of_wall * std::max(std::abs(before), std::abs(behind)))
          result = std::min(result, point);
      }
    }
    return result;
  }

  Timeline::LocatedPassing Timeline::locate(const RunSegment &segment,
                                            Integrator &integrator, const Point &before,
                                            const WallCrossing &crossing) const
  {
    const FittedProblem &problem = *segment.problem;
    const Clock &clock = problem.physics().clock;
    const bool inner = crossing.inner;
    const auto excess_at = [&](const double end)
    {
      integrator.start(before.clock, before.u);
      integrator.advance_to(end, crossing.clock - before.clock);
      return problem.wall_excess(inner, 0, clock.time(end), integrator.state());
    };
    const double at_start
        = problem.wall_excess(inner, 0, clock.time(before.clock), before.u),
        at_end = excess_at(crossing.clock);
    // A step may end on the melting temperature, up to rounding.
    if(at_start * at_end >= 0)
    {
      const double time = clock.time(before.clock);
      const bool begins = before.clock == clock.clock(segment.time);
      return {{inner, begins ? segment.time : time,
               begins && leads_at_once(problem, inner, time, before.u)},
              before.clock};
    }
    std::uintmax_t iterations = 100;
    const auto [lower, upper] = boost::math::tools::toms748_solve(
        [&](const double end) { return end == before.clock ? at_start : excess_at(end); },
        before.clock, crossing.clock, at_start, at_end,
        boost::math::tools::eps_tolerance<double>(50), iterations);
    const double middle = 0.5 * (lower + upper), time = clock.time(middle);
    // Of a jump the far side: the wall is to show the value that it jumps to.
    if(has_jumped(segment, {inner, time}))
      return {{inner, clock.time(upper)}, lower};
    return {{inner, time}, middle};
  }

  RunSegment Timeline::pass_walls(const RunSegment &segment, Integrator &integrator,
                                  const Point &before,
                                  const std::vector<WallCrossing> &crossings)
  {
    std::vector<LocatedPassing> located;
    for(const WallCrossing &crossing : crossings)
      located.push_back(locate(segment, integrator, before, crossing));
    std::ranges::stable_sort(
        located, {}, [](const LocatedPassing &wall) { return wall.passing.time; });
    const WallPassing first = located.front().passing;
    const auto state_at = [&](const double clock_then)
    {
      integrator.start(before.clock, before.u);
      if(clock_then > before.clock)
        integrator.advance_to(clock_then, setting.scene.end_time);
      return integrator.state();
    };
    if(has_jumped(segment, first))
      return after_jump(segment, first.time, state_at(located.front().clock));
    double tau = time_of_seed(setting, segment, first);
    std::vector<WallPassing> passings{first};
    if(located.size() == 2)
    {
      const WallPassing second = located[1].passing;
      const double later = second.time - first.time;
      if(later <= together * tau && second.at_once == first.at_once
         && !has_jumped(segment, second))
        passings.push_back(second);
      else if(later > 0)
        tau = std::min(tau, 0.5 * later);
    }
    return late_stretch(setting, segment, passings, tau,
                        state_at(located[passings.size() - 1].clock),
                        options_for(segment));
  }

  bool Timeline::has_jumped(const RunSegment &segment, const WallPassing &passing) const
  {
    const FittedProblem &problem = *segment.problem;
    const Physics &physics = problem.physics();
    const cases::Boundary &wall = passing.inner ? physics.inner_wall : physics.outer_wall;
    if(wall.kind != cases::BoundaryKind::fixed_temperature)
      return false;
    const RayMesh &mesh = problem.mesh();
    const double since = time_of_seed(setting, segment, passing);
    const auto excess_after = [&](const double share)
    {
      return std::abs(
          wall.value(mesh.position(0, passing.inner ? mesh.inner : mesh.outer),
                     passing.time + share * since)
          - physics.melting_temperature);
    };
    return excess_after(shortly) > already * excess_after(1);
  }

  RunSegment Timeline::after_jump(const RunSegment &segment, const double time,
                                  const Vector<double> &u) const
  {
    RunSegment here = segment;
    here.time = time;
    here.state = u;
    if(auto next = set_out(here, layers_of(here, time, u)))
      return *next;
    // What jumps makes no difference here, as the surroundings of a wall without
    // exchange.
    const Clock &clock = here.problem->physics().clock;
    const double end = clock.clock(setting.scene.end_time);
    here.steps = {{end, (end - clock.clock(time)) / steps_for(setting, time)}};
    return here;
  }
} // namespace meltfront::reference_fem::fitted
