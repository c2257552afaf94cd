#include <cases/error.h>
#include <cases/exact/front_fixing.h>
#include <cases/exact/heat_quadrature.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace meltfront::cases::spectral
{
  namespace
  {
    const char *const name = "spectral oracle";

    /** A phase thinner than this share of the domain has vanished. */
    constexpr double thinnest = 1e-6;

    std::vector<double> initial_fronts(const OracleProblem &problem)
    {
      return problem.start ? fronts_of(*problem.start, problem.start_time)
                           : problem.initial_fronts;
    }

    double initial_temperature(const OracleProblem &problem, double coordinate)
    {
      return problem.start ? problem.start->temperature(coordinate, problem.start_time)
                           : problem.initial_temperature(coordinate);
    }

    /** The stretch that draws nodes of the last phase into the layer beyond its front at
     * the start: spacing at the front in proportion to the layer's width, where that is
     * narrow. */
    double last_stretch(const OracleProblem &problem)
    {
      const double front = initial_fronts(problem).back(), length = problem.outer - front;
      const auto excess = [&](double share)
      {
        return std::abs(initial_temperature(problem, front + share * length)
                        - problem.material.melting_temperature);
      };
      const int samples = 64;
      double range = 0;
      for(int i = 1; i <= samples; ++i)
        range = std::max(range, excess(static_cast<double>(i) / samples));
      double slope = 0;
      for(double step = 1e-2; step > 1e-9; step /= 10)
        slope = std::max(slope, excess(step) / step);
      const double spacing = slope > 0 ? 12 * range / slope : 1;
      const double most_stretch = 18;
      double stretch = 0;
      while(stretch < most_stretch
            && (stretch > 0 ? stretch / std::sinh(stretch) : 1) > spacing)
        stretch += 0.25;
      return stretch;
    }
  } // namespace

  FrontFixing::FrontFixing(const OracleProblem &problem,
                           const std::vector<int> &intervals)
    : problem(problem)
    , exponent(problem.symmetry == Symmetry::planar        ? 0
               : problem.symmetry == Symmetry::cylindrical ? 1
                                                           : 2)
    , sink_factor(problem.line_sink
                  / (2 * std::numbers::pi * problem.material.solid.conductivity))
  {
    add_phases(intervals);
    find_temperature_scale();
  }

  void FrontFixing::add_phases(const std::vector<int> &intervals)
  {
    const bool axis = exponent > 0 && problem.inner == 0;
    const std::size_t last = intervals.size() - 1;
    first = {0};
    for(std::size_t p = 0; p <= last; ++p)
    {
      const bool solid = (p % 2 == 0) == problem.solid_at_origin;
      const bool solved = !(solid ? problem.solid_at_melting : problem.liquid_at_melting);
      const bool stretched = solved && p == last && p > 0;
      phases.push_back(
          {.material = solid ? problem.material.solid : problem.material.liquid,
           .solid = solid,
           .melting_temperature = problem.material.melting_temperature,
           .low = p > 0  ? PhaseEnd{}
                  : axis ? PhaseEnd{.kind = PhaseEnd::axis}
                         : PhaseEnd::at_wall(problem.inner_wall),
           .high = p < last ? PhaseEnd{} : PhaseEnd::at_wall(problem.outer_wall),
           .solved = solved,
           .basis = ChebyshevBasis(intervals[p], stretched ? last_stretch(problem) : 0)});
      first.push_back(first.back() + phases.back().unknowns());
    }
  }

  void FrontFixing::find_temperature_scale()
  {
    const double melting = problem.material.melting_temperature;
    temperature_scale = initial_state().head(first.back()).lpNorm<Eigen::Infinity>();
    const int samples = 64;
    for(const MappedPhase &phase : phases)
      for(const PhaseEnd *end : {&phase.low, &phase.high})
        if(phase.solved && end->kind == PhaseEnd::wall
           && end->law.kind == BoundaryKind::fixed_temperature)
          for(int i = 0; i <= samples; ++i)
          {
            const double time = std::lerp(problem.start_time, problem.end_time,
                                          static_cast<double>(i) / samples);
            temperature_scale
                = std::max(temperature_scale, std::abs(end->value(time) - melting));
          }
    if(temperature_scale == 0)
      temperature_scale
          = problem.material.latent_heat / phases.front().material.specific_heat_capacity;
  }

  double FrontFixing::logarithm(double coordinate, double front) const
  {
    return sink_factor == 0 ? 0 : sink_factor * std::log(coordinate / front);
  }

  std::vector<double> FrontFixing::edges(const Eigen::VectorXd &state) const
  {
    std::vector<double> result{problem.inner};
    result.insert(result.end(), state.begin() + first.back(), state.end());
    result.push_back(problem.outer);
    return result;
  }

  Eigen::VectorXd FrontFixing::initial_state() const
  {
    const std::vector<double> fronts = initial_fronts(problem);
    Eigen::VectorXd state(first.back() + fronts.size());
    std::ranges::copy(fronts, state.begin() + first.back());
    const std::vector<double> edge = edges(state);
    const double melting = problem.material.melting_temperature;
    for(std::size_t p = 0; p < phases.size(); ++p)
      for(int i = 0; i < phases[p].unknowns(); ++i)
      {
        const double x = phases[p].basis.nodes[phases[p].first_unknown() + i];
        // Just off a sink, where its logarithm has no value: smooth in r^2, the rest has
        // not changed there to round-off.
        const double r
            = holds_axis(p)
                  ? edge[p + 1] * std::max(std::sqrt(x), sink_factor == 0 ? 0 : 1e-8)
                  : edge[p] + x * (edge[p + 1] - edge[p]);
        state[first[p] + i] = initial_temperature(problem, r) - melting
                              - (p == 0 ? logarithm(r, edge[1]) : 0);
      }
    return state;
  }

  MappedPhase::Nodal FrontFixing::nodal(std::size_t phase, double time,
                                        const Eigen::VectorXd &state) const
  {
    const std::size_t front = static_cast<std::size_t>(first.back()) + phase;
    const double lower = phase == 0 ? problem.inner : state[front - 1];
    const double upper = phase == n_fronts() ? problem.outer : state[front];
    return phases[phase].complete(time, holds_axis(phase) ? upper / 2 : upper - lower,
                                  state.segment(first[phase], phases[phase].unknowns()));
  }

  double FrontFixing::heat_to_front(std::size_t front, const std::vector<double> &edge,
                                    const std::vector<MappedPhase::Derivatives> &u) const
  {
    const MappedPhase &near = phases[front], &far = phases[front + 1];
    const double at = edge[front + 1];
    const double near_gradient = (holds_axis(front) ? 2 : 1)
                                     * u[front].first[near.basis.intervals]
                                     / (at - edge[front])
                                 + (front == 0 ? sink_factor / at : 0);
    const double far_gradient = u[front + 1].first[0] / (edge[front + 2] - at);
    return near.material.conductivity * near_gradient
           - far.material.conductivity * far_gradient;
  }

  void FrontFixing::rate(double time, const Eigen::VectorXd &state,
                         Eigen::VectorXd &rate) const
  {
    const std::vector<double> edge = edges(state);
    std::vector<MappedPhase::Derivatives> u;
    for(std::size_t p = 0; p < phases.size(); ++p)
      u.push_back(phases[p].derivatives(nodal(p, time, state)));
    rate.resize(state.size());
    Speeds speeds;
    for(std::size_t p = 0; p < phases.size(); ++p)
    {
      const MappedPhase &phase = phases[p];
      // What lies at the inner wall is at rest; what lies beyond a front is displaced.
      const double at_front
          = speeds.material == 0 || p == n_fronts()
                ? 0
                : speeds.material * std::pow(edge[p] / edge[p + 1], exponent);
      speeds.upper = 0;
      if(p < n_fronts())
        speeds.upper = at_front
                       + (phase.solid ? 1 : -1) * heat_to_front(p, edge, u)
                             / (phase.material.density * problem.material.latent_heat);
      if(holds_axis(p))
        axis_rates(u[p], edge[p + 1], speeds.upper, rate);
      else
        rates(p, u[p], edge[p], edge[p + 1], speeds, rate);
      if(p == n_fronts())
        break;
      rate[first.back() + static_cast<Eigen::Index>(p)] = speeds.upper;
      const double displacement
          = 1 - phase.material.density / phases[p + 1].material.density;
      speeds.material = at_front + displacement * (speeds.upper - at_front);
      speeds.lower = speeds.upper;
    }
  }

  void FrontFixing::axis_rates(const MappedPhase::Derivatives &u, double front,
                               double speed, Eigen::VectorXd &rate) const
  {
    const MappedPhase &phase = phases.front();
    const double diffusivity = phase.material.diffusivity();
    for(int i = 0; i < phase.unknowns(); ++i)
    {
      const double x = phase.basis.nodes[i];
      rate[i] = diffusivity * (4 * x * u.second[i] + 2 * (1 + exponent) * u.first[i])
                    / (front * front)
                + speed / front * (2 * x * u.first[i] + sink_factor);
    }
  }

  void FrontFixing::rates(std::size_t phase, const MappedPhase::Derivatives &u,
                          double lower, double upper, const Speeds &speeds,
                          Eigen::VectorXd &rate) const
  {
    const double length = upper - lower;
    const double diffusivity = phases[phase].material.diffusivity();
    for(int i = 0; i < phases[phase].unknowns(); ++i)
    {
      const int j = phases[phase].first_unknown() + i;
      const double x = phases[phase].basis.nodes[j];
      const double r = lower + x * length;
      const double node_speed = speeds.lower * (1 - x) + speeds.upper * x;
      const double material_speed
          = speeds.material == 0 ? 0 : speeds.material * std::pow(lower / r, exponent);
      const double curvature = exponent > 0 ? exponent / r : 0;
      rate[first[phase] + i]
          = (diffusivity * (u.second[j] / length + curvature * u.first[j])
             + (node_speed - material_speed) * u.first[j])
            / length;
    }
  }

  Eigen::VectorXd FrontFixing::scale(const Eigen::VectorXd &state) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Constant(state.size(), temperature_scale);
    for(Eigen::Index i = first.back(); i < state.size(); ++i)
      result[i]
          = std::max(state[i] - problem.inner, 1e-3 * (problem.outer - problem.inner));
    return result;
  }

  bool FrontFixing::admissible(const Eigen::VectorXd &state) const
  {
    return state.allFinite()
           && std::ranges::is_sorted(edges(state), std::less_equal<double>{});
  }

  void FrontFixing::check(long step, double time, const Eigen::VectorXd &state) const
  {
    if(!state.allFinite())
      throw NumericalError(name, step, time, "the state", "is not finite");
    const std::vector<double> edge = edges(state);
    const double gap = thinnest * (problem.outer - problem.inner);
    for(std::size_t p = 0; p < phases.size(); ++p)
      if(edge[p + 1] - edge[p] < gap)
        throw NumericalError(
            name, step, time, phases[p].solid ? "the solid" : "the liquid",
            p == 0            ? "vanishes: the front has reached the inner end"
            : p == n_fronts() ? "vanishes: the front has reached the outer end"
                              : "between two fronts vanishes: they have met");
    if(problem.metastable || std::isfinite(problem.longest_beyond))
      return;
    const Profile now = profile(time, state);
    double beyond = 0;
    for(std::size_t p = 0; p < phases.size(); ++p)
      for(int j = holds_axis(p) ? 1 : 0; j <= phases[p].basis.intervals; ++j)
      {
        const double x = phases[p].basis.nodes[j];
        const double sink
            = p > 0 || sink_factor == 0 ? 0 : 0.5 * sink_factor * std::log(x);
        beyond = std::max(beyond, (phases[p].solid ? 1 : -1) * (now.excess[p][j] + sink));
      }
    if(beyond > 1e-8 * temperature_scale)
      throw NumericalError(name, step, time, "the temperature",
                           "passes the melting point inside a phase: another front "
                           "would form");
  }

  double FrontFixing::beyond_at_walls(double time, const Eigen::VectorXd &state) const
  {
    double beyond = -std::numeric_limits<double>::infinity();
    const auto look = [&](const MappedPhase &phase, double excess)
    { beyond = std::max(beyond, (phase.solid ? 1 : -1) * excess); };
    if(!holds_axis(0))
      look(phases.front(), nodal(0, time, state).excess[0]);
    const Eigen::VectorXd last = nodal(n_fronts(), time, state).excess;
    look(phases.back(), last[last.size() - 1]);
    return beyond;
  }

  std::vector<double> FrontFixing::resolution_defects(double time,
                                                      const Eigen::VectorXd &state) const
  {
    std::vector<double> result;
    for(std::size_t p = 0; p < phases.size(); ++p)
      result.push_back(phases[p].basis.tail(nodal(p, time, state).excess)
                       / temperature_scale);
    return result;
  }

  FrontFixing::Profile FrontFixing::profile(double time,
                                            const Eigen::VectorXd &state) const
  {
    Profile result{time, edges(state), {}};
    for(std::size_t p = 0; p < phases.size(); ++p)
      result.excess.push_back(nodal(p, time, state).excess);
    return result;
  }

  std::size_t FrontFixing::phase_at(const Profile &profile, double coordinate) const
  {
    std::size_t phase = 0;
    while(phase < n_fronts() && coordinate > profile.edges[phase + 1])
      ++phase;
    return phase;
  }

  double FrontFixing::excess(const Profile &profile, double coordinate) const
  {
    const double r = std::clamp(coordinate, problem.inner, problem.outer);
    const std::size_t p = phase_at(profile, r);
    if(!phases[p].solved)
      return 0;
    const double x = (r - profile.edges[p]) / (profile.edges[p + 1] - profile.edges[p]);
    return phases[p].basis.interpolate(profile.excess[p], holds_axis(p) ? x * x : x);
  }

  double FrontFixing::temperature(const Profile &profile, double coordinate) const
  {
    const double sink = phase_at(profile, coordinate) == 0
                            ? logarithm(coordinate, profile.edges[1])
                            : 0;
    return problem.material.melting_temperature + excess(profile, coordinate) + sink;
  }

  double FrontFixing::heat_content(const Profile &profile, double lower,
                                   double upper) const
  {
    lower = std::clamp(lower, problem.inner, problem.outer);
    upper = std::clamp(upper, problem.inner, problem.outer);
    double heat = 0;
    for(std::size_t p = 0; p < phases.size(); ++p)
    {
      const double start = profile.edges[p], length = profile.edges[p + 1] - start;
      const double from = std::clamp(start, lower, upper),
                   to = std::clamp(profile.edges[p + 1], lower, upper);
      const double stretch = phases[p].basis.stretch;
      const double layer = stretch > 0 ? stretch / std::sinh(stretch) : 1;
      const PhaseProperties &material = phases[p].material;
      const double latent = phases[p].solid
                                ? 0
                                : material.density * problem.material.latent_heat
                                      * volume_between(problem.symmetry, from, to);
      heat += latent
              + material.volumetric_heat_capacity()
                    * integrate_panels(
                        problem.symmetry, from, to,
                        [&](double r) { return excess(profile, r); },
                        [&](double r)
                        { return std::min(r - start + layer * length, length) / 8; });
    }
    if(sink_factor != 0)
    {
      const double front = profile.edges[1], split = std::clamp(front, lower, upper);
      const auto primitive
          = [&](double r) { return r > 0 ? r * r * (std::log(r / front) - 0.5) : 0.; };
      heat += phases.front().material.volumetric_heat_capacity() * std::numbers::pi
              * sink_factor * (primitive(split) - primitive(lower));
    }
    return heat;
  }
} // namespace meltfront::cases::spectral
