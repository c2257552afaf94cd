#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/run.h>
#include <particles/rkpm_tracked/plane/topology.h>

#include <cases/error.h>
#include <cases/step_ends.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** The first step, of the one that accuracy allows: backward Euler makes it, whose
     * error is of first order. */
    constexpr double first_step_share = 1. / 32;

    /** BDF2 is stable for steps that grow by less than 1 + sqrt(2). */
    constexpr double largest_growth = 1.6;

    /** No particle moves by more than this in a step, in spacings. */
    constexpr double farthest_step = 1;

    constexpr int most_halvings = 8;
    constexpr int passes_allowed = 10;

    /** Passes in which nodes change their phases. */
    constexpr long regrouping_passes = 4;

    /** What is accepted, and counted, of a step that gets no better by halving:
     * neighbours of stencils change from pass to pass. Its heat balance holds all the
     * same. */
    constexpr double nearly_done = 1e-2;

    /** Shares of their distance within which front particles may stand. */
    constexpr double closest = 0.7, farthest = 1.35;

    /** No step takes a curve nearer to its middle than by this share. */
    constexpr double share_of_radius = 0.5;

    PlaneHeatSettings settings_of(const cases::Scene &scene,
                                  const TrackingParameters &parameters, int threads)
    {
      PlaneHeatSettings settings;
      settings.order = parameters.basis_order;
      settings.interpolation_distance = parameters.interpolation_distance;
      settings.threads = std::max(1, threads);
      settings.capillarity = scene.material.gibbs_thomson_coefficient;
      return settings;
    }
  } // namespace

  PlaneRun::PlaneRun(const cases::Scene &scene, const cases::EffectSet &effects,
                     const cases::Resolution &resolution)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , parameters(read_tracking_parameters(scene, resolution))
    , nodes(scene, parameters.cells, {parameters.jitter, resolution.seed})
    , heat(scene, nodes, settings_of(scene, parameters, resolution.threads))
    , relaxation(nodes, parameters.relax_rule, std::max(1, resolution.threads))
    , marked(nodes, std::max(1, resolution.threads))
    , bounds(cases::temperature_bounds(scene))
    , breakpoints(cases::breakpoints_of(scene))
    , step_ends(cases::step_ends(scene, resolution.n,
                                 (scene.end_time - scene.start_time) / parameters.steps))
  {
    if(parameters.time_scheme == TimeScheme::bdf3)
      throw cases::Refusal("rkpm-tracked steps by bdf2 or backward-euler in the plane");
    start();
  }

  void PlaneRun::take_steps()
  {
    if(before)
      run_particles();
    else
    {
      report_initial();
      if(state.time > scene.start_time)
        report();
    }
    while(state.time < scene.end_time)
    {
      step();
      report();
    }
  }

  double PlaneRun::next_stop() const
  {
    return cases::end_of_piece(step_ends, state.time, scene.end_time);
  }

  double PlaneRun::next_step() const
  {
    const double whole = scene.end_time - scene.start_time;
    double step = whole / parameters.steps;
    const PlaneFront &front = state.front;
    for(std::size_t c = 0; c < front.curves(); ++c)
    {
      double fastest = 0;
      for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
        if(front.active[p])
          fastest = std::max(fastest, std::abs(front.speed[p]));
      const double way = std::min(parameters.cfl * nodes.spacing,
                                  share_of_radius * curve_radius(front, c));
      if(fastest > 0)
        step = std::min(step, way / fastest);
    }
    step = std::min(step, longest_step_of_films(front, topology_settings()));
    step = restarted ? first_step_share * step
                     : std::min(step, largest_growth * last_step);
    const double rest = next_stop() - state.time;
    if(step >= rest * (1 - 1e-10))
      return rest;
    return step > rest / 2 ? rest / 2 : step;
  }

  /** The front goes on at its speed; expansions come from the particles that were nearest
   * at the last state. */
  void PlaneRun::predict(double step, PlaneState &next) const
  {
    next.front = state.front;
    next.phase = state.phase;
    next.unknown.clear();
    next.multiplier = state.multiplier;
    const double farthest_way = farthest_step * nodes.spacing;
    for(std::size_t p = 0; p < next.front.size(); ++p)
      next.front.position[p]
          += std::clamp(step * next.front.speed[p], -farthest_way, farthest_way)
             * next.front.normal[p];
    update_geometry(next.front);
    for(int phase = 0; phase < n_phases; ++phase)
    {
      FrontExpansion &expansion = next.expansion[phase];
      const FrontExpansion &from = state.expansion[phase];
      expansion = FrontExpansion();
      for(std::size_t p = 0; p < next.front.size(); ++p)
      {
        const PlanePoint &place = state.front.position[p];
        const long nearest = state.expansion_bins.nearest(place);
        const PlanePoint offset = place - state.expanded_about[nearest];
        expansion.value.push_back(from.at(nearest, offset));
        expansion.gradient.push_back(from.gradient_at(nearest, offset));
        expansion.second.push_back(from.second[nearest]);
      }
    }
  }

  /** Make the moves that are left. @return whether one of them met its limit or is not
   * finite. */
  bool PlaneRun::move(const std::vector<double> &displacement, PlaneState &next,
                      double &largest) const
  {
    const double h = nodes.spacing;
    bool limited = false;
    largest = 0;
    for(std::size_t p = 0; p < displacement.size(); ++p)
    {
      if(!std::isfinite(displacement[p]))
        return true;
      PlanePoint &place = next.front.position[p];
      const PlanePoint moved = place + displacement[p] * next.front.normal[p];
      const PlanePoint way = moved - state.front.position[p];
      const bool too_far = way.norm() > farthest_step * h;
      if(next.front.active[p])
      {
        largest = std::max(largest, std::abs(displacement[p]) / h);
        limited = limited || too_far;
      }
      place = too_far ? state.front.position[p] + farthest_step * h * way.normalized()
                      : moved;
    }
    update_geometry(next.front);
    return limited;
  }

  /** @return what is left of the front's way after the last pass, in spacings; infinite
   * where particles would move too far or the matrix is singular. */
  double PlaneRun::attempt(double step, PlaneState &next)
  {
    constexpr double failed = std::numeric_limits<double>::infinity();
    const double stop = next_stop();
    next.time = step == stop - state.time ? stop : state.time + step;
    const bool two_steps = older && parameters.time_scheme == TimeScheme::bdf2;
    const PlaneStep times(state, two_steps ? &*older : nullptr, next.time);
    predict(step, next);
    double largest = failed;
    std::optional<double> response;
    long passes = 0;
    while(largest > done && passes < passes_allowed)
    {
      heat.set_front(next, passes >= regrouping_passes);
      const std::optional<PlaneSolution> solution = heat.solve(times, next);
      ++passes;
      if(!solution)
        return failed;
      const bool made = heat.walls_hold_temperature()
                            ? !move(heat.apply(times, *solution, 0, next), next, largest)
                            : balance(times, *solution, next, response,
                                      passes == passes_allowed, largest);
      if(!made)
        return failed;
    }
    most_passes = std::max(most_passes, passes);
    return largest;
  }

  void PlaneRun::step()
  {
    prepare();
    double step = next_step();
    PlaneState next;
    double left = attempt(step, next);
    for(int halvings = 0; left > done && halvings < most_halvings; ++halvings)
    {
      const double before = left;
      ++halved_steps;
      step /= 2;
      left = attempt(step, next);
      if(left <= nearly_done && left > before / 2)
        break;
    }
    if(left > nearly_done)
      throw cases::NumericalError(
          method_name, step_number + 1, state.time + step, "front",
          std::isfinite(left)
              ? fmt::format("has {:.2g} spacings left to move after {} passes, however "
                            "short the step",
                            left, passes_allowed)
              : "moves too far or meets a singular matrix, however short the step");
    capped_steps += left > done;
    last_step = shorten_to_bounds(step, next);
    accept(std::move(next));
  }

  /** The level set goes along; then the particles are put onto its zeros. */
  void PlaneRun::follow_level_set()
  {
    PlaneFront &front = state.front;
    const auto ways = [&]
    {
      for(std::size_t p = 0; p < front.size(); ++p)
        front.displacement[p] = front.position[p] - older->front.position[p];
    };
    ways();
    marked.carry(older->front, front.displacement, step_number, state.time);
    mismatch = std::max(mismatch, marked.mismatch(front) / nodes.spacing);
    std::vector<double> areas;
    for(std::size_t c = 0; c < front.curves(); ++c)
      areas.push_back(signed_area(front, c));
    marked.reproject(front, front.displacement);
    for(std::size_t c = 0; c < front.curves(); ++c)
      restore_area(front, c, areas[c]);
    ways();
  }

  void PlaneRun::accept(PlaneState next)
  {
    older = std::move(state);
    state = std::move(next);
    restarted = false;
    ++step_number;
    largest_multiplier = std::max(largest_multiplier, std::abs(state.multiplier));
    check_resolved();
    warn_of_ripples();
  }

  /** Between steps: particles, curves and nodes are laid anew where they have to be. What
   * that does to the heat of a state is part of the next step, whose balance goes on from
   * the state that was reported. */
  void PlaneRun::prepare()
  {
    if(restarted)
      return;
    follow_level_set();
    redistribute(state.front, front_spacing * nodes.spacing, closest, farthest);
    // Particles that were placed anew may lie beyond a wall.
    heat.mark_active(state.front);
    follow_topology();
    if(parameters.relax > 0 && !restarted && step_number % parameters.relax == 0)
      relax_nodes();
    if(std::ranges::binary_search(breakpoints, state.time))
    {
      older.reset();
      restarted = true;
    }
  }

  std::unique_ptr<cases::Run> make_plane_run(const cases::Scene &scene,
                                             const cases::EffectSet &effects,
                                             const cases::Resolution &resolution)
  {
    return std::make_unique<PlaneRun>(scene, effects, resolution);
  }
} // namespace meltfront::particles::rkpm_tracked
