#include <cases/error.h>
#include <cases/initial_level.h>
#include <cases/mean_with_jumps.h>
#include <cases/means_of_jumps.h>
#include <cases/step_ends.h>
#include <cases/time_integral.h>
#include <cases/wall_law.h>
#include <particles/core/arrangement.h>
#include <particles/rkpm_tracked/line/collocation.h>
#include <particles/rkpm_tracked/line/similarity_start.h>
#include <particles/rkpm_tracked/line/start.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    using cases::BoundaryKind;
    using cases::Side;

    /** A phase is told at so many places in each spacing. */
    constexpr int probes_per_spacing = 16;
    constexpr int bisections = 60;
    /** Thicknesses of the layer that a run starts with, over the spacing. */
    constexpr double first_layers[] = {2, 1, 0.5, 0.25, 0.1};
    LineWall wall_of(const cases::Scene &scene, Side side, double x)
    {
      const cases::Boundary &boundary = scene.boundary(side);
      LineWall wall;
      wall.kind = boundary.kind;
      wall.law = boundary;
      if(wall.kind == BoundaryKind::insulated)
        return wall;
      // Far less than any step, far more than round-off.
      const double beside = 1e-11 * (scene.end_time - scene.start_time);
      const auto value_at = [field = boundary.value, x](double side)
      {
        return [field, x, side](double time)
        {
          return field(position_on_line(x),
                       cases::breaks_at(field, time) ? time + side : time);
        };
      };
      wall.value = value_at(-beside);
      wall.value_after = value_at(beside);
      const cases::TimeMean mean(boundary.value);
      if(wall.kind == BoundaryKind::flux)
        wall.mean_flux = [mean, x](double begin, double end)
        { return mean(position_on_line(x), begin, end); };
      return wall;
    }

    std::vector<double> arrange_line(double lower, double upper, double spacing,
                                     double jitter_over_spacing, std::uint64_t seed)
    {
      const double length = upper - lower;
      const auto intervals = std::lround(length / spacing);
      if(intervals < 2)
        throw cases::Refusal(
            fmt::format("rkpm-tracked needs at least two intervals between nodes, not {}",
                        intervals));
      ParticleStorage places;
      places.dimension = 1;
      for(long i = 0; i <= intervals; ++i)
        places.add({i == intervals ? upper : lower + length * i / intervals, 0, 0});
      if(jitter_over_spacing > 0)
        jitter(places, jitter_over_spacing * length / intervals, seed,
               [&](const std::array<double, 3> &p)
               { return p[0] != lower && p[0] != upper; });
      return places.position[0];
    }

    /** Cells grow from walls that make them finer over two fifths of the domain's side,
     * so that all are halved where n is doubled; but where there are fewer than ten by
     * this at most: each is then 1.28 times as long as the one before. */
    constexpr double graded_share = 0.4, most_growth = 0.25;

    /** Cells between nodes from a wall that makes them finer to a distance from it, and
     * back: beside the wall their length is growth times the distance beyond that at the
     * wall. */
    struct GradedCells
    {
      double spacing, at_wall; ///< m
      double spacing_growth;

      double graded() const
      {
        return std::log(spacing / at_wall) / spacing_growth;
      }

      double to(double distance) const
      {
        const double way = (spacing - at_wall) / spacing_growth;
        return distance < way
                   ? std::log1p(spacing_growth * distance / at_wall) / spacing_growth
                   : graded() + (distance - way) / spacing;
      }

      double distance(double cells) const
      {
        const double graded_cells = graded();
        return cells < graded_cells
                   ? at_wall * std::expm1(spacing_growth * cells) / spacing_growth
                   : (spacing - at_wall) / spacing_growth
                         + (cells - graded_cells) * spacing;
      }
    };

    /** Nodes from one place to another, finer beside those where a spacing is given. */
    std::vector<double> lay_piece(double lower, double upper, double spacing,
                                  const std::array<double, 2> &at_ends, double growth,
                                  double jitter_over_spacing, std::uint64_t seed)
    {
      const GradedCells cells{spacing, std::max(at_ends[0], at_ends[1]), growth};
      const double length = upper - lower;
      if(!(cells.at_wall > 0))
        return arrange_line(lower, upper, spacing, jitter_over_spacing, seed);
      const bool both = at_ends[0] > 0 && at_ends[1] > 0;
      const double wanted = both ? 2 * cells.to(length / 2) : cells.to(length);
      // In a coordinate in which all cells are of length one.
      std::vector<double> nodes = arrange_line(0, wanted, 1, jitter_over_spacing, seed);
      for(double &node : nodes)
      {
        const bool from_lower = both ? node < wanted / 2 : at_ends[0] > 0;
        node = from_lower ? lower + cells.distance(node)
                          : upper - cells.distance(wanted - node);
      }
      nodes.front() = lower;
      nodes.back() = upper;
      return nodes;
    }

    /** Lay the nodes of a problem, finer beside walls that want it and where the
     * temperature jumps, on which they stand. */
    void lay_nodes(LineProblem &problem, double lower, double upper, double spacing,
                   double jitter_over_spacing, std::uint64_t seed)
    {
      std::vector<double> ends = problem.jumps;
      ends.push_back(upper);
      double from = lower, before = problem.wall_spacing[0];
      for(const double to : ends)
      {
        const double after = to == upper ? problem.wall_spacing[1] : problem.jump_spacing;
        const std::vector<double> piece
            = lay_piece(from, to, spacing, {before, after}, problem.spacing_growth,
                        jitter_over_spacing, seed);
        problem.nodes.insert(problem.nodes.end(),
                             piece.begin() + (problem.nodes.empty() ? 0 : 1),
                             piece.end());
        from = to;
        before = after;
      }
      const bool uniform
          = ends.size() == 1
            && !(std::max(problem.wall_spacing[0], problem.wall_spacing[1]) > 0);
      problem.spacing
          = uniform ? (upper - lower) / static_cast<double>(problem.nodes.size() - 1)
                    : spacing;
    }

    double temperature_at_start(const cases::Scene &scene, double x)
    {
      return scene.initial.temperature(position_on_line(x), scene.start_time);
    }

    /** Where temperatures jump at the start, as far as their expression may (m). */
    std::vector<double> find_jumps(const cases::Scene &scene, double lower, double upper,
                                   double spacing)
    {
      std::vector<double> jumps;
      if(!cases::may_jump_at_start(scene))
        return jumps;
      const auto probes
          = static_cast<long>((upper - lower) / spacing * probes_per_spacing);
      std::vector<double> place, value;
      for(long i = 0; i <= probes; ++i)
      {
        place.push_back(lower + (upper - lower) * i / probes);
        value.push_back(temperature_at_start(scene, place.back()));
      }
      const auto [lowest, highest] = std::ranges::minmax(value);
      const double least = cases::negligible_jump * (highest - lowest);
      for(std::size_t i = 1; i < place.size(); ++i)
      {
        if(!(std::abs(value[i] - value[i - 1]) > least))
          continue;
        const cases::Jump jump = cases::jump_between(
            [&](const cases::Position &at)
            { return scene.initial.temperature(at, scene.start_time); },
            position_on_line(place[i - 1]), position_on_line(place[i]));
        if(jump.height > least && jump.place[0] > lower && jump.place[0] < upper)
          jumps.push_back(jump.place[0]);
      }
      return jumps;
    }

    bool solid_at(const cases::Scene &scene, double x)
    {
      return cases::initial_level(scene)(position_on_line(x), scene.start_time) < 0;
    }

    std::vector<double> find_fronts(const cases::Scene &scene, double lower, double upper,
                                    double spacing)
    {
      std::vector<double> fronts;
      const auto probes
          = static_cast<long>((upper - lower) / spacing * probes_per_spacing);
      double before = lower;
      for(long i = 1; i <= probes; ++i)
      {
        double behind = lower + (upper - lower) * i / probes;
        const double next = behind;
        if(solid_at(scene, before) != solid_at(scene, behind))
        {
          for(int b = 0; b < bisections; ++b)
          {
            const double middle = (before + behind) / 2;
            (solid_at(scene, middle) == solid_at(scene, before) ? before : behind)
                = middle;
          }
          fronts.push_back((before + behind) / 2);
        }
        before = next;
      }
      return fronts;
    }

    /** Share of the time since an exact solution began that its history may take; less
     * where its front has just set out, with steps that are short beside its age. */
    constexpr double longest_exact_history = 0.5, longest_similarity_history = 0.2;

    /** States before a time, on an exact solution that began at `begin`. */
    template <typename StateAt>
    std::vector<LineState> older_states(const StateAt &state_at, double time,
                                        double begin, double step, TimeScheme scheme,
                                        double longest_history)
    {
      const int wanted = static_cast<int>(scheme) - 1;
      if(wanted > 0)
        step = std::min(step, longest_history * (time - begin) / wanted);
      std::vector<LineState> result;
      for(int k = 1; k <= wanted; ++k)
        result.push_back(state_at(time - k * step));
      return result;
    }

    /** A node where the temperature jumps has the mean of both sides; on a front, which
     * is to stand where they touch, that of the front. */
    void settle_jumps(const cases::Scene &scene, const LineProblem &problem,
                      LineState &state)
    {
      const double beside = coincidence * problem.spacing;
      for(const double jump : problem.jumps)
      {
        const auto node = std::ranges::find(problem.nodes, jump) - problem.nodes.begin();
        double value = (temperature_at_start(scene, jump - beside)
                        + temperature_at_start(scene, jump + beside))
                       / 2;
        for(double &front : state.fronts)
          if(std::abs(front - jump) <= beside)
          {
            front = jump;
            value = problem.material.melting_temperature;
          }
        state.temperature[static_cast<std::size_t>(node)] = value;
      }
    }
  } // namespace

  cases::Position position_on_line(double x)
  {
    return {x, 0, 0};
  }

  LineProblem pose_line_problem(const cases::Scene &scene,
                                const TrackingParameters &parameters, std::uint64_t seed)
  {
    const cases::Domain &domain = scene.domain;
    const bool ball = domain.shape == cases::DomainShape::ball;
    LineProblem problem;
    problem.symmetry = scene.symmetry;
    problem.material = scene.material;
    problem.form = parameters.form;
    const double lower = domain.round() ? (ball ? 0 : domain.inner_radius) : 0;
    const double upper = domain.round() ? domain.radius : domain.side();
    problem.axis = ball;
    if(!ball)
      problem.walls[0]
          = wall_of(scene, domain.round() ? Side::inner : Side::x_min, lower);
    problem.walls[1] = wall_of(scene, domain.round() ? Side::outer : Side::x_max, upper);
    const double spacing = domain.side() / parameters.cells;
    if(!problem.balanced() && domain.shape == cases::DomainShape::shell
       && problem.walls[0].kind != BoundaryKind::insulated
       && domain.inner_radius < spacing)
      throw cases::Refusal(fmt::format(
          "rkpm-tracked loses heat by collocation at an inner wall of radius {:.3g} m, "
          "less than the spacing of {:.3g} m; n has to be {:.3g} times as large at least",
          domain.inner_radius, spacing, spacing / domain.inner_radius));
    for(const std::size_t side : {0, 1})
      if(const LineWall &wall = problem.walls[side];
         problem.balanced() && parameters.wall_spacing < 1
         && wall.kind != BoundaryKind::insulated)
        problem.wall_spacing[side] = parameters.wall_spacing * spacing;
    problem.spacing_growth
        = std::min(most_growth, spacing / (graded_share * domain.side()));
    if(problem.balanced() && parameters.wall_spacing < 1)
    {
      problem.jumps = find_jumps(scene, lower, upper, spacing);
      problem.jump_spacing = parameters.wall_spacing * spacing;
    }
    lay_nodes(problem, lower, upper, spacing, parameters.jitter, seed);
    problem.breakpoints = cases::breakpoints_of(scene);
    // Steps that are equal in the root of time are up to twice as long as their mean.
    problem.step_ends
        = cases::step_ends(scene, parameters.cells,
                           (parameters.clock == Clock::time ? 1 : 2)
                               * (scene.end_time - scene.start_time) / parameters.steps);
    if(scene.volumetric_source)
    {
      const double beside = 1e-11 * (scene.end_time - scene.start_time);
      problem.volumetric_source
          = [field = *scene.volumetric_source, beside](double x, double time)
      {
        return field(position_on_line(x),
                     cases::breaks_at(field, time) ? time - beside : time);
      };
      problem.mean_release = [mean = cases::TimeMean(*scene.volumetric_source)](
                                 double x, double begin, double end)
      { return mean(position_on_line(x), begin, end); };
    }
    problem.displaced = parameters.displaced;
    problem.metastable = cases::metastable_initial_phase(scene) != nullptr;
    return problem;
  }

  LineState initial_state(const cases::Scene &scene, const LineProblem &problem)
  {
    const double lower = problem.nodes.front(), upper = problem.nodes.back();
    LineState state;
    state.time = scene.start_time;
    for(const double x : problem.nodes)
      state.temperature.push_back(temperature_at_start(scene, x));
    if(const auto &exact = scene.initial.exact)
    {
      const double front = exact->front(scene.start_time);
      state.solid_first = exact->solid_at_origin();
      if(front > lower && front < upper)
        state.fronts = {front};
      else if(front <= lower)
        state.solid_first = !state.solid_first;
      return state;
    }
    state.fronts = find_fronts(scene, lower, upper, problem.spacing);
    state.solid_first = solid_at(scene, lower);
    settle_jumps(scene, problem, state);
    return state;
  }

  LineStart choose_start(const cases::Scene &scene, const LineProblem &problem,
                         const TrackingParameters &parameters, const LineState &initial,
                         double step)
  {
    LineStart start;
    const double time = scene.start_time;
    const auto &exact = scene.initial.exact;
    if(exact && !initial.fronts.empty() && parameters.exact_history)
    {
      const double begin = exact->start_time();
      if(time > begin)
        start.older = older_states(
            [&](double t) { return exact_state(*exact, problem, t, false); }, time, begin,
            step, parameters.time_scheme, longest_exact_history);
      start.state = initial;
      start.how = "the exact solution and its history";
      return start;
    }
    const SimilarityStart similar(problem, initial, scene.end_time - time);
    if(similar && parameters.start == Start::automatic)
      for(const double layer : first_layers)
      {
        const double since = similar.time_of(layer * problem.spacing);
        if(!similar.holds(since))
          continue;
        start.state = similar.state(since);
        start.older = older_states([&](double t) { return similar.state(t - time); },
                                   time + since, time, step, parameters.time_scheme,
                                   longest_similarity_history);
        start.how
            = fmt::format("the similarity solution of a layer of {:g} spacings", layer);
        return start;
      }
    start.state = initial;
    start.how = "the initial state";
    start.from_initial = true;
    return start;
  }
} // namespace meltfront::particles::rkpm_tracked
