#include <particles/rkpm_tracked/plane/enthalpy_particles.h>
#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/run.h>
#include <particles/rkpm_tracked/plane/topology.h>

#include <cases/capabilities.h>
#include <cases/error.h>
#include <cases/exact/front_start.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Largest and smallest radius of a seed around a sink, in spacings. */
    constexpr double largest_seed = 3, smallest_seed = 0.75;
    constexpr double negligible = 1e-5, closed_bracket = 1e-15; ///< see cases::SeedRule

    /** Secant steps that put a front where it encloses the particles' solid, to which
     * share of the domain; and the farthest way, in spacings: beyond that there is solid
     * that the front does not go round. */
    constexpr int most_shifts = 8;
    constexpr double enclosed = 1e-12, farthest_from_shares = 0.25;

    std::function<double(const PlanePoint &)>
    at_points(const cases::FrontStart::Function &function)
    {
      return [function](const PlanePoint &point) { return function(position_of(point)); };
    }
  } // namespace

  void PlaneRun::start()
  {
    if(starts_from_one_phase(scene))
    {
      before.emplace(scene, effects, resolution, nodes, parameters);
      start_in_words = fmt::format(
          "sph with {} particles along the side until {:.6g} s, the new phase {:.2g} to "
          "{:.2g} spacings deep",
          before->particles, before->time, before->least_depth, before->most_depth);
      return;
    }
    if(std::ranges::count(cases::front_origins(scene), cases::FrontOrigin::wall) > 0)
      throw cases::Refusal(fmt::format(
          "{} does not simulate, in the plane, a front that sets out from a wall beside "
          "others: only where one phase fills the domain at the start",
          method_name));
    if(!starts_with_jumps(scene, nodes))
      return start_from_front();
    before.emplace(scene, effects, resolution, nodes, parameters);
    start_in_words = fmt::format("sph with {} particles along the side until {:.6g} s, "
                                 "what jumps at the start smooth over {:.2g} spacings",
                                 before->particles, before->time, before->least_depth);
  }

  void PlaneRun::start_from_front()
  {
    const double h = nodes.spacing;
    const cases::FrontStart found = find_front_start(scene, {method_name,
                                                             "nodes",
                                                             smallest_seed * h,
                                                             largest_seed * h,
                                                             negligible,
                                                             closed_bracket,
                                                             {cases::Side::inner}});
    const PlaneLevelSet level_set = at_points(found.level_set);
    const auto temperature = at_points(found.temperature);
    start_in_words = found.description;
    state.time = found.time;
    lay_front(level_set);
    state.unknown.resize(nodes.size());
    for(std::size_t i = 0; i < nodes.size(); ++i)
      state.unknown[i]
          = state.phase[i] == NodePhase::solid
                ? heat.sinks.at_node(temperature, nodes.position[i], nodes.samples_of(i))
                      - heat.singular_part(i, state.time)
                : temperature(nodes.position[i]);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      withstood = std::max(withstood, beyond_melting(state, i));
    heat.expand(state);
    marked.seed(state.front, heat.settings.solid_beyond);
    condition = heat.worst_condition(state);
    front_at_start = state.front.size();
    step_number = found.time > scene.start_time ? 1 : 0;
    check(state);
  }

  /** @throws cases::Refusal where nodes are too far apart for a front. */
  void PlaneRun::lay_front(const PlaneLevelSet &level_set)
  {
    const double h = nodes.spacing;
    const Contours contours = find_contours(nodes.lower, nodes.upper, h, level_set);
    state.front = front_on_zeros(contours, level_set, front_spacing * h, 4 * h);
    heat.settings.solid_beyond = contours.solid_beyond;
    heat.set_front(state);
    if(state.front.size() == 0)
      throw cases::Refusal(fmt::format(
          "rkpm-tracked finds no front at the start with nodes {:.3g} m apart; "
          "a smaller spacing may resolve it",
          h));
  }

  /** The particles' steps up to the time at which they hand over. */
  void PlaneRun::run_particles()
  {
    cost_before = before->run(
        [this](const cases::Snapshot &snapshot)
        {
          if(snapshot.time < before->time)
          {
            state_before = &snapshot;
            reached(snapshot.step, snapshot.time);
            state_before = nullptr;
          }
          else
            take_over(snapshot);
        });
    note(state.time, "sph handed over temperature and front");
    report();
  }

  /** Front and temperatures of a state of particles; what heat is off by is spread over
   * all nodes alike. */
  void PlaneRun::take_over(const cases::Snapshot &snapshot)
  {
    state.time = snapshot.time;
    step_number = snapshot.step;
    initial_heat = snapshot.heat.initial;
    state.wall_heat = snapshot.heat.boundary;
    state.released_heat = snapshot.heat.sources;
    const EnthalpyParticles particles(scene, nodes, snapshot);
    lay_front([&](const PlanePoint &place) { return particles.level(place); });
    particles.fit(state.front, heat.settings.solid_beyond);
    fit_solid(particles);
    handed_over_heat = lost_heat(state);
    const PlaneMeasure found = measure(scene, nodes, heat, state);
    unbooked_heat = book_heat(state, scene, nodes, heat, {},
                              found.sensible + found.latent + handed_over_heat);
    marked.seed(state.front, heat.settings.solid_beyond);
    check(state);
  }

  /** The front as a whole is put where it encloses the particles' solid.
   * @throws cases::Refusal where it does not go round all of that */
  void PlaneRun::fit_solid(const EnthalpyParticles &particles)
  {
    PlaneFront &front = state.front;
    double way = 0;
    for(int i = 0; i <= most_shifts; ++i)
    {
      take_temperatures(particles);
      const double missing
          = particles.solid_area - measure(scene, nodes, heat, state).solid_area;
      if(std::abs(missing) <= enclosed * nodes.area)
        break;
      double length = 0;
      for(std::size_t c = 0; c < front.curves(); ++c)
        for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
          if(front.active[p])
            length += (front.position[front.next(c, p)] - front.position[p]).norm();
      const double shift = missing / length;
      way += shift;
      if(!(std::abs(way) <= farthest_from_shares * nodes.spacing))
        throw cases::Refusal(fmt::format(
            "{} does not take over the state of sph at t = {:.6g}: its front would go "
            "round {:.3g} m^2 less of solid, {:.2g} spacings along all of it; take more "
            "nodes, or sph",
            method_name, state.time, missing, missing / length / nodes.spacing));
      for(std::size_t p = 0; p < front.size(); ++p)
        front.position[p] -= shift * front.normal[p];
      update_geometry(front);
    }
  }

  /** Of the nodes by the front that is there; held walls have their own. */
  void PlaneRun::take_temperatures(const EnthalpyParticles &particles)
  {
    const double melting = scene.material.melting_temperature;
    heat.set_front(state);
    const PlaneBins front_bins(state.front.position, nodes.spacing);
    state.unknown.assign(nodes.size(), melting);
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(state.phase[i] == NodePhase::front)
        continue;
      const bool solid = state.phase[i] == NodePhase::solid;
      const std::int32_t wall = nodes.wall_of_node[i];
      const WallPiece *held = wall < 0 ? nullptr : nodes.walls[wall].dirichlet();
      const double value
          = held ? held->boundary->value(position_of(nodes.position[i]), state.time)
                 : particles.temperature(nodes.position[i], solid, state.front,
                                         front_bins);
      state.unknown[i] = solid ? std::min(value, melting) : std::max(value, melting);
    }
    heat.expand(state);
  }
} // namespace meltfront::particles::rkpm_tracked
