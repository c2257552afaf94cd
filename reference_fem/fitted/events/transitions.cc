#include <reference_fem/fitted/events/resolution.h>
#include <reference_fem/fitted/events/transitions.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using dealii::Vector;

    constexpr double growth_of_steps = 2;

    /** Cells next to a wall in the thermal layer that forms before a front starts, and
     * steps of that time's double. */
    constexpr double cells_in_layer = 2;
    constexpr int steps_to_passing = 28;

    /** Halve the cells of an interval on both sides of the face at @p place until those
     * next to it are that small. */
    std::vector<double> halved_towards(std::vector<double> shares, const double place,
                                       const double smallest)
    {
      auto face = std::ranges::min_element(
          shares, {}, [&](const double share) { return std::abs(share - place); });
      for(; face != shares.begin() && *face - *(face - 1) > smallest; ++face)
        face = shares.insert(face, 0.5 * (*face + *(face - 1)));
      while(face + 1 != shares.end() && *(face + 1) - *face > smallest)
        face = shares.insert(face + 1, 0.5 * (*face + *(face + 1))) - 1;
      return shares;
    }

    /** The state of a segment on a mesh with more faces, and steps to come. */
    RunSegment on_finer_mesh(const EventScene &setting, const RunSegment &segment,
                             const std::vector<std::vector<double>> &shares,
                             const Clock &clock)
    {
      const FittedProblem &old = *segment.problem;
      const RayMesh &mesh = old.mesh();
      Physics physics = old.physics();
      physics.clock = clock;
      const LayeredState layers = layers_of(segment, segment.time, segment.state);
      RunSegment result;
      result.problem = std::make_shared<FittedProblem>(
          RayMesh(mesh.surface, mesh.inner, mesh.outer, shares), physics);
      result.time = segment.time;
      result.state
          = result.problem->state(segment.time, layers.fronts,
                                  [&](const cases::Position &p) {
                                    return layers.temperature(coordinate_of(setting, p));
                                  });
      result.before = layers.before;
      return result;
    }
  } // namespace

  RunSegment one_phase_stretch(const EventScene &setting)
  {
    const cases::Scene &scene = setting.scene;
    const RayScene &rays = setting.rays;
    Physics physics
        = physics_between(setting, initial_fronts(scene, rays).solid_inside, 0);
    physics.clock = {};
    // A sink makes a front at once: this is the state before it is switched on.
    physics.power = {};
    const auto temperature = [&](const cases::Position &p)
    { return scene.initial.temperature(p, scene.start_time); };
    const RayMesh mesh = resolving_mesh(
        RayMesh(rays.surface, rays.inner, rays.outer, graded_shares(rays.cells, 1, true)),
        physics, scene.start_time, {}, temperature);
    RunSegment result;
    result.problem = std::make_shared<FittedProblem>(mesh, physics);
    result.time = scene.start_time;
    result.state = result.problem->state(scene.start_time, {}, temperature);
    straighten_jumps(*result.problem, scene.start_time, result.state);
    result.steps = {{scene.end_time, (scene.end_time - scene.start_time)
                                         / std::max(1, setting.options.steps)}};
    return result;
  }

  RunSegment refined_stretch(const EventScene &setting, const RunSegment &segment,
                             const bool passing_inner, const double soon)
  {
    const RayMesh &mesh = segment.problem->mesh();
    const LayeredState layers = layers_of(segment, segment.time, segment.state);
    const std::array<cases::WallLayer, 2> forms = layers_at_walls(setting, layers);
    const Clock clock{true, segment.time};
    const double end = clock.clock(setting.scene.end_time),
                 early = std::min(clock.clock(segment.time + 2 * soon), end);
    const int steps = steps_for(setting, segment.time);
    const StepRange to_passing{early, early / std::max(steps_to_passing, steps / 2)};
    std::vector<std::vector<double>> shares = mesh.shares;
    for(const bool inner : {true, false})
    {
      const bool passes = inner == passing_inner;
      if(!passes && !forms[inner ? 0 : 1].forms())
        continue;
      const unsigned int interval = inner ? 0 : mesh.n_fronts();
      const Phase &phase = segment.problem->phase(interval);
      const double time = passes ? soon : clock.time(to_passing.step) - segment.time;
      shares[interval]
          = halved_towards(shares[interval], inner ? 0 : 1,
                           std::sqrt(phase.conductivity / phase.capacity * time)
                               / (cells_in_layer * room_at_wall(setting, layers, inner)));
    }
    RunSegment result = on_finer_mesh(setting, segment, shares, clock);
    result.steps = {to_passing};
    if(early < end)
      for(const StepRange &range : lengthening_steps(early, end, steps, growth_of_steps))
        result.steps.push_back(range);
    result.event
        = {segment.time, fmt::format("cells and steps are drawn to the wall {}, which is "
                                     "about to pass the melting temperature",
                                     to_string(side_at(setting.scene, passing_inner)))};
    return result;
  }

  namespace
  {
    /** The cells of an interval without those of others that are no more. */
    std::vector<double> shares_between(const std::vector<double> &faces)
    {
      std::vector<double> shares;
      for(const double face : faces)
        shares.push_back((face - faces.front()) / (faces.back() - faces.front()));
      return shares;
    }

    /** What is left of a mesh without an interval: its levels with the intervals they lay
     * in, and fronts and cells as they are then. */
    struct Remains
    {
      double place = 0; ///< of what is gone (m)
      std::vector<unsigned int> levels, intervals;
      std::vector<double> fronts;
      std::vector<std::vector<double>> shares{{}};
    };

    Remains remains_without(const FittedProblem &old, const Vector<double> &u,
                            const unsigned int vanished)
    {
      const RayMesh &mesh = old.mesh();
      const unsigned int n = mesh.n_fronts();
      const bool at_inner = vanished == 0, at_outer = vanished == n;
      Remains result;
      // The levels on both sides of the gap are one, and the cells next to it reach as
      // far as it does.
      for(unsigned int level = 0; level < mesh.n_levels(); ++level)
      {
        const bool before = vanished > 0 && level <= mesh.front_level(vanished - 1);
        const bool beyond = vanished < n && level >= mesh.front_level(vanished);
        if(!before && (!beyond || (!at_inner && level == mesh.front_level(vanished))))
          continue;
        result.levels.push_back(level);
        result.intervals.push_back(before
                                       ? mesh.interval_of(level)
                                       : std::max(mesh.interval_of(level), vanished + 1));
      }
      const double lower = at_inner ? mesh.inner : u[mesh.front_node(0, vanished - 1)];
      const double upper = at_outer ? mesh.outer : u[mesh.front_node(0, vanished)];
      result.place = at_inner ? lower : at_outer ? upper : 0.5 * (lower + upper);

      std::vector<double> faces;
      for(std::size_t i = 0; i < result.levels.size(); i += mesh.surface.degree)
      {
        const unsigned int level = result.levels[i], front = mesh.front_at(level);
        const bool gap
            = front != RayMesh::none && (front + 1 == vanished || front == vanished);
        faces.push_back(gap ? result.place : old.coordinate(0, level, u));
        if(front == RayMesh::none || gap)
          continue;
        result.fronts.push_back(faces.back());
        result.shares.back() = shares_between(faces);
        result.shares.emplace_back();
        faces = {faces.back()};
      }
      result.shares.back() = shares_between(faces);
      return result;
    }

    std::string what_vanishes(const EventScene &setting, const RayMesh &mesh,
                              const unsigned int vanished, const double place)
    {
      if(vanished > 0 && vanished < mesh.n_fronts())
        return fmt::format("two fronts meet at {:.6g}", place);
      return fmt::format(
          "the front reaches {}",
          vanished == 0 && mesh.has_centre()
              ? "the centre"
              : fmt::format("the wall {}",
                            to_string(side_at(setting.scene, vanished == 0))));
    }

    /** A segment on cells that are halved towards places where the temperature bends,
     * with steps that lengthen from short ones. */
    RunSegment drawn_segment(const EventScene &setting, const RunSegment &segment,
                             const std::vector<double> &places, const Clock &clock,
                             const std::string &event)
    {
      const RayMesh &mesh = segment.problem->mesh();
      const std::vector<StepRange> steps = lengthening_steps(
          clock.clock(segment.time), clock.clock(setting.scene.end_time),
          steps_for(setting, segment.time), clock.root ? 1 : 2);
      const double first = clock.time(steps.front().end) - segment.time;
      std::vector<std::vector<double>> shares = mesh.shares;
      const LayeredState layers = layers_of(segment, segment.time, segment.state);
      double lower = mesh.inner;
      for(unsigned int k = 0; k <= mesh.n_fronts(); ++k)
      {
        const double upper = k < mesh.n_fronts() ? layers.fronts[k] : mesh.outer;
        const Phase &phase = segment.problem->phase(k);
        const double smallest = std::sqrt(phase.conductivity / phase.capacity * first)
                                / (cells_in_layer * (upper - lower));
        for(const double place : places)
          if(place >= lower && place <= upper)
            shares[k]
                = halved_towards(shares[k], (place - lower) / (upper - lower), smallest);
        lower = upper;
      }
      RunSegment result = on_finer_mesh(setting, segment, shares, clock);
      result.steps = steps;
      result.event = {segment.time, event};
      return result;
    }
  } // namespace

  RunSegment drawn_to_walls(const EventScene &setting, const RunSegment &segment,
                            const std::array<cases::WallLayer, 2> &forms)
  {
    Clock clock = segment.problem->physics().clock;
    if(setting.options.clock != "t")
      clock = {true, segment.time};
    std::vector<double> places;
    std::string walls;
    for(const bool inner : {true, false})
      if(forms[inner ? 0 : 1].forms())
      {
        places.push_back(inner ? setting.rays.inner : setting.rays.outer);
        walls += fmt::format("{}{}", walls.empty() ? "" : " and ",
                             to_string(side_at(setting.scene, inner)));
      }
    return drawn_segment(setting, segment, places, clock,
                         fmt::format("cells and steps are drawn to the wall {}, where a "
                                     "layer of heat forms",
                                     walls));
  }

  namespace
  {
    /** What the last of a layer held goes to the node next to its place, of those that no
     * wall holds. */
    void keep_heat(const FittedProblem &problem, const double time, const double place,
                   const double heat, Vector<double> &u)
    {
      const RayMesh &mesh = problem.mesh();
      unsigned int nearest = RayMesh::none;
      const auto distance = [&](unsigned int level)
      { return std::abs(problem.coordinate(0, level, u) - place); };
      for(unsigned int level = 1; level + 1 < mesh.n_levels(); ++level)
        if(mesh.front_at(level) == RayMesh::none
           && (nearest == RayMesh::none || distance(level) < distance(nearest)))
          nearest = level;
      const HeatContent now = problem.heat(time, u);
      Vector<double> warmer = u;
      warmer[nearest] += 1;
      u[nearest] += (heat - now.sensible - now.latent)
                    / (problem.heat(time, warmer).sensible - now.sensible);
    }
  } // namespace

  RunSegment remaining_stretch(const EventScene &setting, const RunSegment &past,
                               const double time, const Vector<double> &u,
                               const unsigned int vanished)
  {
    const FittedProblem &old = *past.problem;
    const RayMesh &mesh = old.mesh();
    if(vanished == 0 && old.physics().power)
      throw cases::Refusal(fmt::format(
          "fem-fitted does not simulate a source whose own phase vanishes, which "
          "leaves no field to split off: at t = {:.6g}",
          time));
    const Remains remains = remains_without(old, u, vanished);
    Physics physics = physics_between(setting, old.phase(vanished == 0 ? 1 : 0).solid,
                                      remains.fronts.size());
    if(setting.options.clock != "t")
      physics.clock = {true, time};
    RunSegment left;
    left.problem = std::make_shared<FittedProblem>(
        RayMesh(mesh.surface, mesh.inner, mesh.outer, remains.shares), physics);
    left.time = time;
    left.state.reinit(left.problem->size());
    const RayMesh &mesh_left = left.problem->mesh();
    for(unsigned int front = 0; front < remains.fronts.size(); ++front)
      left.state[mesh_left.front_node(0, front)] = remains.fronts[front];
    for(unsigned int i = 0; i < remains.levels.size(); ++i)
      if(mesh_left.front_at(i) == RayMesh::none)
      {
        const double r = left.problem->coordinate(0, i, left.state);
        left.state[i] = old.theta(remains.intervals[i], 0, remains.levels[i], time, u);
        if(r > 0)
          left.state[i]
              += old.source(remains.intervals[i], time)
                     .value(old.coordinate(0, remains.levels[i], u))
                 - left.problem->source(mesh_left.interval_of(i), time).value(r);
      }
    const HeatContent before = old.heat(time, u);
    keep_heat(*left.problem, time, remains.place, before.sensible + before.latent,
              left.state);
    left.before = past.before;
    left.before.walls += before.walls;
    left.before.sources += before.sources;
    return drawn_segment(setting, left, {remains.place}, physics.clock,
                         what_vanishes(setting, mesh, vanished, remains.place));
  }
} // namespace meltfront::reference_fem::fitted
