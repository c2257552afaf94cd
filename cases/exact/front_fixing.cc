#include <cases/error.h>
#include <cases/exact/front_fixing.h>
#include <cases/exact/heat_quadrature.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::cases::spectral
{
  namespace
  {
    const char *const name = "spectral oracle";

    /** A phase thinner than this share of the domain has vanished. */
    constexpr double thinnest = 1e-6;

    double initial_front(const OracleProblem &problem)
    {
      return problem.start ? problem.start->front(problem.start_time)
                           : problem.initial_front;
    }

    double initial_temperature(const OracleProblem &problem, double coordinate)
    {
      return problem.start ? problem.start->temperature(coordinate, problem.start_time)
                           : problem.initial_temperature(coordinate);
    }

    /** The stretch that draws nodes into the layer beyond the front at the start: spacing
     * at the front in proportion to the layer's width, where that is narrow. */
    double far_stretch(const OracleProblem &problem)
    {
      if(problem.one_phase)
        return 0;
      const double front = initial_front(problem), length = problem.outer - front;
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

  FrontFixing::FrontFixing(const OracleProblem &problem, int near_intervals,
                           int far_intervals)
    : problem(problem)
    , exponent(problem.symmetry == Symmetry::planar        ? 0
               : problem.symmetry == Symmetry::cylindrical ? 1
                                                           : 2)
    , near{.material
           = problem.solid_at_origin ? problem.material.solid : problem.material.liquid,
           .solid = problem.solid_at_origin,
           .wall = problem.inner_wall,
           .melting_temperature = problem.material.melting_temperature,
           .wall_is_first = true,
           .axis = exponent > 0 && problem.inner == 0,
           .solved = true,
           .basis = ChebyshevBasis(near_intervals)}
    , far{.material
          = problem.solid_at_origin ? problem.material.liquid : problem.material.solid,
          .solid = !problem.solid_at_origin,
          .wall = problem.outer_wall,
          .melting_temperature = problem.material.melting_temperature,
          .wall_is_first = false,
          .axis = false,
          .solved = !problem.one_phase,
          .basis = ChebyshevBasis(far_intervals, far_stretch(problem))}
    , size(near.unknowns() + far.unknowns() + 1)
    , sink_factor(problem.line_sink / (2 * std::numbers::pi * near.material.conductivity))
  {
    find_temperature_scale();
  }

  void FrontFixing::find_temperature_scale()
  {
    const double melting = problem.material.melting_temperature;
    temperature_scale = initial_state().head(size - 1).lpNorm<Eigen::Infinity>();
    const int samples = 64;
    for(const MappedPhase *side : {&near, &far})
      if(side->solved && !side->axis
         && side->wall.kind == BoundaryKind::fixed_temperature)
        for(int i = 0; i <= samples; ++i)
        {
          const double time = std::lerp(problem.start_time, problem.end_time,
                                        static_cast<double>(i) / samples);
          temperature_scale
              = std::max(temperature_scale, std::abs(side->wall.value(time) - melting));
        }
    if(temperature_scale == 0)
      temperature_scale
          = problem.material.latent_heat / near.material.specific_heat_capacity;
  }

  double FrontFixing::logarithm(double coordinate, double front) const
  {
    return sink_factor == 0 ? 0 : sink_factor * std::log(coordinate / front);
  }

  Eigen::VectorXd FrontFixing::initial_state() const
  {
    Eigen::VectorXd state(size);
    const double front = initial_front(problem);
    const double melting = problem.material.melting_temperature;
    for(int i = 0; i < near.unknowns(); ++i)
    {
      const double x = near.basis.nodes[near.first_unknown() + i];
      // Just off a sink, where its logarithm has no value: smooth in r^2, the rest has
      // not changed there to round-off.
      const double r = near.axis
                           ? front * std::max(std::sqrt(x), sink_factor == 0 ? 0 : 1e-8)
                           : problem.inner + x * (front - problem.inner);
      state[i] = initial_temperature(problem, r) - melting - logarithm(r, front);
    }
    for(int i = 0; i < far.unknowns(); ++i)
      state[near.unknowns() + i]
          = initial_temperature(problem, front
                                             + far.basis.nodes[far.first_unknown() + i]
                                                   * (problem.outer - front))
            - melting;
    state[size - 1] = front;
    return state;
  }

  MappedPhase::Nodal FrontFixing::near_nodal(double time,
                                             const Eigen::VectorXd &state) const
  {
    return near.complete(time, state[size - 1] - problem.inner,
                         state.head(near.unknowns()));
  }

  MappedPhase::Nodal FrontFixing::far_nodal(double time,
                                            const Eigen::VectorXd &state) const
  {
    return far.complete(time, problem.outer - state[size - 1],
                        state.segment(near.unknowns(), far.unknowns()));
  }

  void FrontFixing::rate(double time, const Eigen::VectorXd &state,
                         Eigen::VectorXd &rate) const
  {
    const double front = state[size - 1];
    const MappedPhase::Derivatives near_u = near.derivatives(near_nodal(time, state));
    const MappedPhase::Derivatives far_u = far.derivatives(far_nodal(time, state));
    const double near_gradient = (near.axis ? 2 : 1) * near_u.first[near.basis.intervals]
                                     / (front - problem.inner)
                                 + sink_factor / front;
    const double far_gradient = far_u.first[0] / (problem.outer - front);
    const double heat_to_near = near.material.conductivity * near_gradient
                                - far.material.conductivity * far_gradient;
    const double speed = (near.solid ? 1 : -1) * heat_to_near
                         / (near.material.density * problem.material.latent_heat);
    rate.resize(size);
    near_rates(near_u, front, speed, rate);
    far_rates(far_u, front, speed, rate);
    rate[size - 1] = speed;
  }

  void FrontFixing::near_rates(const MappedPhase::Derivatives &u, double front,
                               double speed, Eigen::VectorXd &rate) const
  {
    const double length = front - problem.inner;
    const double diffusivity = near.material.diffusivity();
    for(int i = 0; i < near.unknowns(); ++i)
    {
      const int j = near.first_unknown() + i;
      const double x = near.basis.nodes[j];
      if(near.axis)
        rate[i] = diffusivity * (4 * x * u.second[j] + 2 * (1 + exponent) * u.first[j])
                      / (front * front)
                  + speed / front * (2 * x * u.first[j] + sink_factor);
      else
      {
        const double curvature
            = exponent > 0 ? exponent / (problem.inner + x * length) : 0;
        rate[i] = (diffusivity * (u.second[j] / length + curvature * u.first[j])
                   + speed * x * u.first[j])
                  / length;
      }
    }
  }

  void FrontFixing::far_rates(const MappedPhase::Derivatives &u, double front,
                              double speed, Eigen::VectorXd &rate) const
  {
    const double length = problem.outer - front;
    const double diffusivity = far.material.diffusivity();
    const double displacement = 1 - near.material.density / far.material.density;
    for(int i = 0; i < far.unknowns(); ++i)
    {
      const int j = far.first_unknown() + i;
      const double x = far.basis.nodes[j];
      const double r = front + x * length;
      const double node_speed = speed * (1 - x);
      const double material_speed = displacement * speed * std::pow(front / r, exponent);
      const double curvature = exponent > 0 ? exponent / r : 0;
      rate[near.unknowns() + i]
          = (diffusivity * (u.second[j] / length + curvature * u.first[j])
             + (node_speed - material_speed) * u.first[j])
            / length;
    }
  }

  Eigen::VectorXd FrontFixing::scale(const Eigen::VectorXd &state) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Constant(size, temperature_scale);
    result[size - 1] = std::max(state[size - 1] - problem.inner,
                                1e-3 * (problem.outer - problem.inner));
    return result;
  }

  bool FrontFixing::admissible(const Eigen::VectorXd &state) const
  {
    return state.allFinite() && state[size - 1] > problem.inner
           && state[size - 1] < problem.outer;
  }

  void FrontFixing::check(long step, double time, const Eigen::VectorXd &state) const
  {
    if(!state.allFinite())
      throw NumericalError(name, step, time, "the state", "is not finite");
    const double front = state[size - 1];
    const double gap = thinnest * (problem.outer - problem.inner);
    if(front - problem.inner < gap)
      throw NumericalError(name, step, time, near.solid ? "the solid" : "the liquid",
                           "vanishes: the front has reached the inner end");
    if(problem.outer - front < gap)
      throw NumericalError(name, step, time, far.solid ? "the solid" : "the liquid",
                           "vanishes: the front has reached the outer end");
    if(problem.metastable)
      return;
    const Profile now = profile(time, state);
    double near_excess = 0, far_excess = 0;
    for(int j = near.axis ? 1 : 0; j < near.basis.intervals; ++j)
    {
      const double x = near.basis.nodes[j];
      const double sink = sink_factor == 0 ? 0 : 0.5 * sink_factor * std::log(x);
      near_excess = std::max(near_excess, (near.solid ? 1 : -1) * (now.near[j] + sink));
    }
    for(int j = 1; j <= far.basis.intervals; ++j)
      far_excess = std::max(far_excess, (far.solid ? 1 : -1) * now.far[j]);
    if(std::max(near_excess, far_excess) > 1e-8 * temperature_scale)
      throw NumericalError(name, step, time, "the temperature",
                           "passes the melting point inside a phase: another front "
                           "would form");
  }

  FrontFixing::Defect FrontFixing::resolution_defect(double time,
                                                     const Eigen::VectorXd &state) const
  {
    return {near.basis.tail(near_nodal(time, state).from_front) / temperature_scale,
            far.basis.tail(far_nodal(time, state).from_front) / temperature_scale};
  }

  FrontFixing::Profile FrontFixing::profile(double time,
                                            const Eigen::VectorXd &state) const
  {
    return {time, state[size - 1], near_nodal(time, state).from_front,
            far_nodal(time, state).from_front};
  }

  double FrontFixing::excess(const Profile &profile, double coordinate) const
  {
    const double r = std::clamp(coordinate, problem.inner, problem.outer);
    if(r > profile.front)
      return far.solved ? far.basis.interpolate(
                 profile.far, (r - profile.front) / (problem.outer - profile.front))
                        : 0;
    const double x = (r - problem.inner) / (profile.front - problem.inner);
    return near.basis.interpolate(profile.near, near.axis ? x * x : x);
  }

  double FrontFixing::temperature(const Profile &profile, double coordinate) const
  {
    const double sink
        = coordinate < profile.front ? logarithm(coordinate, profile.front) : 0;
    return problem.material.melting_temperature + excess(profile, coordinate) + sink;
  }

  double FrontFixing::heat_content(const Profile &profile, double lower,
                                   double upper) const
  {
    lower = std::clamp(lower, problem.inner, problem.outer);
    upper = std::clamp(upper, problem.inner, problem.outer);
    const double split = std::clamp(profile.front, lower, upper);
    const double near_length = profile.front - problem.inner;
    const double far_length = problem.outer - profile.front;
    const double stretch = far.basis.stretch;
    const double layer = stretch > 0 ? stretch / std::sinh(stretch) : 1;
    const auto part
        = [&](const MappedPhase &side, double from, double to, const auto &panel)
    {
      const double latent = side.solid
                                ? 0
                                : side.material.density * problem.material.latent_heat
                                      * volume_between(problem.symmetry, from, to);
      return latent
             + side.material.volumetric_heat_capacity()
                   * integrate_panels(
                       problem.symmetry, from, to,
                       [&](double r) { return excess(profile, r); }, panel);
    };
    double heat
        = part(near, lower, split, [&](double) { return near_length / 8; })
          + part(far, split, upper,
                 [&](double r) {
                   return std::min(r - profile.front + layer * far_length, far_length)
                          / 8;
                 });
    if(sink_factor != 0)
    {
      const auto primitive = [&](double r)
      { return r > 0 ? r * r * (std::log(r / profile.front) - 0.5) : 0.; };
      heat += near.material.volumetric_heat_capacity() * std::numbers::pi * sink_factor
              * (primitive(split) - primitive(lower));
    }
    return heat;
  }
} // namespace meltfront::cases::spectral
