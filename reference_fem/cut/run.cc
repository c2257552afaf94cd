#include <reference_fem/cut/run.h>

#include <cases/error.h>
#include <cases/exact/front_start.h>
#include <cases/step_ends.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** The first step, of the one that accuracy allows: backward Euler, whose error is of
     * first order, makes it. */
    constexpr double first_step_share = 1. / 32;

    /** Steps of backward Euler after a jump of the data at a wall. */
    constexpr int damping_steps = 4;

    /** Of the largest difference of a wall's temperature from the melting point: what
     * counts as a jump. One that is smaller overshoots by less than anything counts. */
    constexpr double least_jump = 1e-3;

    /** Of the run: how long after a breakpoint the data are read for what they jump to.
     */
    constexpr double just_after = 1e-9;

    /** Of the run: a front that calls for shorter steps has lost its way. */
    constexpr double shortest_step = 1e-8;

    /** BDF2 is stable for steps that grow by less than 1 + sqrt(2). */
    constexpr double largest_growth = 1.6;

    /** No node of the level set moves by more than this in a step, in cells: beyond it no
     * temperatures would be at hand. */
    constexpr double farthest_move = 0.9;

    /** A step that moves the front farther is halved so many times before it is cut. */
    constexpr int most_halvings = 8;

    /** Cells: beyond the band into which phases are extended, the mesh is to be finest
     * for so far more, for the next step. */
    constexpr double reach_of_step = farthest_move + 0.1;

    PointFunction at_points(const cases::FrontStart::Function &function)
    {
      return [function](const Point &point) { return function(position(point)); };
    }
  } // namespace

  CutRun::CutRun(const cases::Scene &scene, const cases::EffectSet &effects,
                 const cases::Resolution &resolution)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , options(options_for(scene, resolution))
    , finest_rim(options.refinement > 0 && scene.domain.round()
                     ? make_mesh(divided_at_rim(scene.domain), nullptr)
                     : nullptr)
    , state{scene.start_time, make_mesh({}, finest_rim.get()), {}, {}, {}, {}, 0}
    , heat(scene, state.mesh->spacing, options.stabilisation, options.speed_smoothing)
    , bounds(cases::temperature_bounds(scene))
    , breakpoints(cases::breakpoints_of(scene))
    , step_ends(cases::step_ends(scene, resolution.n,
                                 (scene.end_time - scene.start_time)
                                     / static_cast<double>(options.fewest_steps)))
  {
    start();
  }

  std::shared_ptr<const BackgroundMesh>
  CutRun::make_mesh(const RefinementCriterion &divided, const BackgroundMesh *rim) const
  {
    return std::make_shared<const BackgroundMesh>(scene, resolution.n, options.degree,
                                                  options.level_set_degree,
                                                  options.refinement, divided, rim);
  }

  void CutRun::take_steps()
  {
    report_initial();
    if(state.time > scene.start_time)
      reached(step_number, state.time);
    while(state.time < scene.end_time)
    {
      step();
      reached(step_number, state.time);
    }
  }

  void CutRun::start()
  {
    const double seed = options.seed_cells * state.mesh->spacing;
    cases::SeedRule rule{method_name, "cells", seed, seed};
    for(const cases::Side side : scene.sides())
      if(scene.boundary(side).exact)
        rule.exempt_walls.push_back(side);
    const cases::FrontStart found = find_front_start(scene, rule);
    const PointFunction level_set = at_points(found.level_set),
                        temperature = at_points(found.temperature);
    start_in_words = found.description;
    state.time = found.time;
    if(options.refinement > 0)
      state.mesh = make_mesh(refined_about(points_of_front(*state.mesh, level_set),
                                           *state.mesh, options.widths),
                             finest_rim.get());
    heat.set_front(state, signed_distance_to_zeros(*state.mesh, level_set));
    require_resolved();
    heat.project(state, temperature);
    unknowns_at_start = heat.unknowns;
    step_number = found.time > scene.start_time ? 1 : 0;
    check(state);
    damp_jump(
        [&](const WallPoint &wall)
        {
          return cases::prescribes_heat(scene.boundary(wall.side).kind)
                     ? 0
                     : temperature(wall.position);
        },
        state.time);
  }

  /** What a datum of a wall is worth in temperature (K): of heat that is given, across
   * the cell that takes it up. */
  double CutRun::worth(const cases::Boundary &boundary, double datum) const
  {
    using cases::BoundaryKind;
    if(boundary.kind == BoundaryKind::fixed_temperature)
      return std::abs(datum);
    const double across_cell = state.mesh->spacing
                               / std::min(scene.material.solid.conductivity,
                                          scene.material.liquid.conductivity);
    return std::abs(datum) * across_cell;
  }

  /** What a wall prescribes where its value is given: a temperature, or the flux by its
   * law at the temperature that it has. */
  double CutRun::datum(const WallPoint &wall, double given) const
  {
    const cases::Boundary &boundary = scene.boundary(wall.side);
    return cases::exchanges_heat(boundary.kind)
               ? cases::heat_through(
                     boundary, given,
                     heat.temperature(state, wall.phase, wall.cell, wall.point.unit))
                     .flux
               : given;
  }

  /** Damp the coming steps if data of walls at a time differ from what is there before.
   */
  void CutRun::damp_jump(const std::function<double(const WallPoint &)> &before,
                         double time)
  {
    double largest = 0, scale = 0;
    for(const WallPoint &wall : state.geometry->walls)
    {
      const cases::Boundary &boundary = scene.boundary(wall.side);
      if(boundary.kind == cases::BoundaryKind::insulated
         || boundary.kind == cases::BoundaryKind::periodic)
        continue;
      const double given = datum(wall, boundary.value(position(wall.position), time)),
                   was = before(wall),
                   rest = cases::prescribes_heat(boundary.kind)
                              ? 0
                              : scene.material.melting_temperature;
      largest = std::max(largest, worth(boundary, given - was));
      scale
          = std::max({scale, worth(boundary, given - rest), worth(boundary, was - rest)});
    }
    if(largest > least_jump * scale)
    {
      damped_steps = damping_steps;
      wall_jump = largest;
      layer_resolved = state.time + 3 * damping_step();
    }
  }

  /**
   * The shortest step of backward Euler in which bilinear elements smooth a jump and do
   * not overshoot: h^2/(3 alpha), from which on no two nodes of a Cartesian mesh are
   * coupled by mass more than by conduction.
   */
  double CutRun::damping_step() const
  {
    double slowest = std::numeric_limits<double>::infinity();
    for(const Phase phase : {Phase::solid, Phase::liquid})
      if(state.geometry->has(phase))
        slowest = std::min(slowest, (phase == Phase::solid ? scene.material.solid
                                                           : scene.material.liquid)
                                        .diffusivity());
    return state.mesh->spacing * state.mesh->spacing / (3 * slowest);
  }

  double CutRun::next_stop() const
  {
    return cases::end_of_piece(step_ends, state.time, scene.end_time);
  }

  double CutRun::next_step() const
  {
    const double longest
        = (scene.end_time - scene.start_time) / static_cast<double>(options.fewest_steps);
    const double by_front = state.speed.largest > 0
                                ? options.cfl * state.mesh->spacing / state.speed.largest
                                : std::numeric_limits<double>::infinity();
    double step = std::min(longest, by_front);
    step = fresh ? first_step_share * step : std::min(step, largest_growth * last_step);
    if(damped_steps > 0)
      step = std::max(step, std::min(damping_step(), by_front));
    const double whole = scene.end_time - scene.start_time;
    if(!(step > shortest_step * whole))
    {
      const cases::NumericalError error(
          method_name, step_number + 1, state.time, "front",
          fmt::format("moves at {:.3g} m/s, for which steps would be shorter than {:g} "
                      "of the run",
                      state.speed.largest, shortest_step));
      if(const std::string reason = why_last_body_is_lost(state); !reason.empty())
        throw cases::Refusal(fmt::format("{}; {}", error.what(), reason));
      throw error;
    }
    const double rest = next_stop() - state.time;
    if(step >= rest * (1 - 1e-10))
      return rest;
    return step > rest / 2 ? rest / 2 : step;
  }

  /** The level set after a displacement along the normals, at nodes in the band. */
  Values CutRun::displaced(const Values &displacement, const std::vector<char> &band,
                           bool &limited) const
  {
    const double farthest = farthest_move * state.mesh->spacing;
    Values result = state.level_set;
    for(std::size_t i = 0; i < result.size(); ++i)
    {
      if(!band[i])
        continue;
      limited = limited || !(std::abs(displacement[i]) <= farthest);
      result[i] -= std::clamp(displacement[i], -farthest, farthest);
    }
    state.mesh->distribute_level_set(result);
    return result;
  }

  /** Adams-Bashforth of second order, where a speed before is at hand. */
  Values CutRun::predicted_front(double step, bool &limited) const
  {
    Values displacement = state.speed.values;
    for(std::size_t i = 0; i < displacement.size(); ++i)
    {
      if(older && older->speed.band[i])
        displacement[i]
            += step / (2 * last_step) * (state.speed.values[i] - older->speed.values[i]);
      displacement[i] *= step;
    }
    return displaced(displacement, state.speed.band, limited);
  }

  /** The trapezoidal rule. */
  Values CutRun::moved_front(double step, const SpeedField &end_speed,
                             bool &limited) const
  {
    Values displacement = state.speed.values;
    for(std::size_t i = 0; i < displacement.size(); ++i)
    {
      if(end_speed.band[i])
        displacement[i] = (displacement[i] + end_speed.values[i]) / 2;
      displacement[i] *= step;
    }
    return displaced(displacement, state.speed.band, limited);
  }

  bool CutRun::attempt(double step, bool last_chance, State &next)
  {
    const double stop = next_stop();
    next.time = step == stop - state.time ? stop : state.time + step;
    bool limited = false;
    Values front = predicted_front(step, limited);
    for(int solve = 0; solve < options.solves; ++solve)
    {
      if(limited && !last_chance)
        return false;
      heat.set_front(next, std::move(front));
      try
      {
        heat.solve(next, state, older && damped_steps == 0 ? &*older : nullptr);
      }
      catch(const cases::Refusal &)
      {
        throw;
      }
      catch(const std::runtime_error &)
      {
        // In a shorter step what is stored outweighs the stabilisation.
        if(last_chance)
          throw;
        return false;
      }
      if(solve + 1 < options.solves)
        front = moved_front(step, next.speed, limited);
    }
    if(limited)
      ++capped_steps;
    return true;
  }

  void CutRun::step()
  {
    double step = next_step();
    State next;
    next.mesh = state.mesh;
    try
    {
      for(int halvings = 0; !attempt(step, halvings == most_halvings, next); ++halvings)
      {
        step /= 2;
        ++halved_steps;
      }
    }
    catch(const std::runtime_error &error)
    {
      if(dynamic_cast<const cases::Refusal *>(&error))
        throw;
      throw cases::NumericalError(method_name, step_number + 1, state.time + step,
                                  "temperature",
                                  fmt::format("cannot be solved for: {}", error.what()));
    }
    last_step = shorten_to_bounds(step, next);
    accept(std::move(next));
  }

  void CutRun::accept(State next)
  {
    if(fresh || damped_steps > 0)
      state.wall_power = next.wall_power;
    boundary_heat += (next.time - state.time) * (state.wall_power + next.wall_power) / 2;
    const double step_began = state.time;
    older = std::move(state);
    state = std::move(next);
    euler_steps += fresh || damped_steps > 0;
    damped_steps = std::max(0, damped_steps - 1);
    boundary_heat += state.flux_heat;
    released_heat += state.released_heat;
    fresh = std::ranges::binary_search(breakpoints, state.time);
    if(fresh)
    {
      older.reset();
      damp_jump(
          [&](const WallPoint &wall)
          {
            return datum(wall, cases::value_at_end(scene.boundary(wall.side).value,
                                                   position(wall.position), step_began,
                                                   state.time));
          },
          state.time + just_after * (scene.end_time - scene.start_time));
    }
    ++step_number;
    check(state);
    if(state.time > layer_resolved)
      wall_jump = 0;
    follow_front();
  }

  /** A new mesh where the front nears the end of the finest cells. */
  void CutRun::follow_front()
  {
    if(options.refinement == 0
       || !leaves_band(*state.mesh, *state.geometry, state.level_set,
                       options.stabilisation.extension + reach_of_step))
      return;
    const auto mesh
        = make_mesh(refined_about(points_of_front(*state.mesh, *state.geometry),
                                  *state.mesh, options.widths),
                    finest_rim.get());
    state = heat.transferred(state, mesh);
    if(older)
      *older = heat.transferred(*older, mesh);
    ++meshes;
  }
} // namespace meltfront::reference_fem::cut
