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
      const double step = 1e-6, slope = excess(step) / step;
      const double spacing = slope > 0 ? 12 * range / slope : 1;
      double stretch = 0;
      while(stretch < 12 && (stretch > 0 ? stretch / std::sinh(stretch) : 1) > spacing)
        stretch += 0.25;
      return stretch;
    }
  } // namespace

  FrontFixing::FrontFixing(const OracleProblem &problem, int near_intervals,
                           int far_intervals)
    : problem(problem)
    , near_basis(near_intervals)
    , far_basis(far_intervals, far_stretch(problem))
    , exponent(problem.symmetry == Symmetry::planar        ? 0
               : problem.symmetry == Symmetry::cylindrical ? 1
                                                           : 2)
  {
    const Material &material = problem.material;
    near.solid = problem.solid_at_origin;
    near.material = near.solid ? material.solid : material.liquid;
    near.wall = problem.inner_wall;
    near.solved = true;
    near.centre = exponent > 0 && problem.inner == 0;
    near.first = near.centre ? 0 : 1;
    near.unknowns = near_intervals - near.first;
    near.offset = 0;

    far.solid = !near.solid;
    far.material = far.solid ? material.solid : material.liquid;
    far.wall = problem.outer_wall;
    far.solved = !problem.one_phase;
    far.centre = false;
    far.first = 1;
    far.unknowns = far.solved ? far_intervals - 1 : 0;
    far.offset = near.unknowns;
    size = near.unknowns + far.unknowns + 1;
    sink_factor = problem.line_sink / (2 * std::numbers::pi * near.material.conductivity);

    find_temperature_scale();
  }

  void FrontFixing::find_temperature_scale()
  {
    const double melting = problem.material.melting_temperature;
    temperature_scale = initial_state().head(size - 1).lpNorm<Eigen::Infinity>();
    const int samples = 64;
    for(const Side *side : {&near, &far})
      if(side->solved && !side->centre
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
    for(int i = 0; i < near.unknowns; ++i)
    {
      const double x = near_basis.nodes[near.first + i];
      // Just off a sink, where its logarithm has no value: smooth in r^2, the rest has
      // not changed there to round-off.
      const double r = near.centre
                           ? front * std::max(std::sqrt(x), sink_factor == 0 ? 0 : 1e-8)
                           : problem.inner + x * (front - problem.inner);
      state[near.offset + i]
          = initial_temperature(problem, r) - melting - logarithm(r, front);
    }
    for(int i = 0; i < far.unknowns; ++i)
      state[far.offset + i]
          = initial_temperature(
                problem, front + far_basis.nodes[far.first + i] * (problem.outer - front))
            - melting;
    state[size - 1] = front;
    return state;
  }

  void FrontFixing::set_wall(const Side &side, const ChebyshevBasis &basis, int node,
                             double time, double length, Eigen::VectorXd &values) const
  {
    if(side.wall.kind == BoundaryKind::fixed_temperature)
    {
      values[node] = side.wall.value(time) - problem.material.melting_temperature;
      return;
    }
    // The outward derivative in the mapped coordinate is flux times length over k.
    const double flux = side.wall.kind == BoundaryKind::flux ? side.wall.value(time) : 0;
    const double outward = node == 0 ? -1 : 1;
    values[node] = 0;
    values[node] = (outward * flux * length / side.material.conductivity
                    - basis.first.row(node).dot(values))
                   / basis.first(node, node);
  }

  Eigen::VectorXd FrontFixing::near_values(double time,
                                           const Eigen::VectorXd &state) const
  {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(near_basis.intervals + 1);
    values.segment(near.first, near.unknowns) = state.segment(near.offset, near.unknowns);
    if(!near.centre)
      set_wall(near, near_basis, 0, time, state[size - 1] - problem.inner, values);
    return values;
  }

  Eigen::VectorXd FrontFixing::far_values(double time, const Eigen::VectorXd &state) const
  {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(far_basis.intervals + 1);
    if(far.solved)
    {
      values.segment(far.first, far.unknowns) = state.segment(far.offset, far.unknowns);
      set_wall(far, far_basis, far_basis.intervals, time, problem.outer - state[size - 1],
               values);
    }
    return values;
  }

  void FrontFixing::rate(double time, const Eigen::VectorXd &state,
                         Eigen::VectorXd &rate) const
  {
    const double front = state[size - 1];
    const double near_length = front - problem.inner, far_length = problem.outer - front;
    const Eigen::VectorXd near_u = near_values(time, state),
                          far_u = far_values(time, state);
    const Eigen::VectorXd near_x = near_basis.first * near_u,
                          near_xx = near_basis.second * near_u;
    const Eigen::VectorXd far_x = far_basis.first * far_u,
                          far_xx = far_basis.second * far_u;

    const double near_gradient
        = (near.centre ? 2 : 1) * near_x[near_basis.intervals] / near_length
          + sink_factor / front;
    const double far_gradient = far_x[0] / far_length;
    const double heat_to_near = near.material.conductivity * near_gradient
                                - far.material.conductivity * far_gradient;
    const double speed = (near.solid ? 1 : -1) * heat_to_near
                         / (near.material.density * problem.material.latent_heat);

    rate.resize(size);
    rate[size - 1] = speed;
    const double near_a = near.material.diffusivity(), far_a = far.material.diffusivity();
    for(int i = 0; i < near.unknowns; ++i)
    {
      const int j = near.first + i;
      const double x = near_basis.nodes[j];
      if(near.centre)
        rate[near.offset + i]
            = near_a * (4 * x * near_xx[j] + 2 * (1 + exponent) * near_x[j])
                  / (front * front)
              + speed / front * (2 * x * near_x[j] + sink_factor);
      else
      {
        const double r = problem.inner + x * near_length;
        rate[near.offset + i] = near_a
                                    * (near_xx[j] / near_length
                                       + (exponent > 0 ? exponent / r : 0) * near_x[j])
                                    / near_length
                                + speed * x * near_x[j] / near_length;
      }
    }
    const double displacement = 1 - near.material.density / far.material.density;
    for(int i = 0; i < far.unknowns; ++i)
    {
      const int j = far.first + i;
      const double x = far_basis.nodes[j];
      const double r = front + x * far_length;
      const double node_speed = speed * (1 - x);
      const double material_speed = displacement * speed * std::pow(front / r, exponent);
      rate[far.offset + i] = (far_a * (far_xx[j] / far_length + exponent / r * far_x[j])
                              + (node_speed - material_speed) * far_x[j])
                             / far_length;
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
    for(int j = near.centre ? 1 : 0; j < near_basis.intervals; ++j)
    {
      const double x = near_basis.nodes[j];
      const double sink = sink_factor == 0 ? 0 : 0.5 * sink_factor * std::log(x);
      near_excess = std::max(near_excess, (near.solid ? 1 : -1) * (now.near[j] + sink));
    }
    for(int j = 1; j <= far_basis.intervals; ++j)
      far_excess = std::max(far_excess, (far.solid ? 1 : -1) * now.far[j]);
    if(std::max(near_excess, far_excess) > 1e-8 * temperature_scale)
      throw NumericalError(name, step, time, "the temperature",
                           "passes the melting point inside a phase: another front "
                           "would form");
  }

  FrontFixing::Defect FrontFixing::resolution_defect(double time,
                                                     const Eigen::VectorXd &state) const
  {
    return {near_basis.tail(near_values(time, state)) / temperature_scale,
            far_basis.tail(far_values(time, state)) / temperature_scale};
  }

  FrontFixing::Profile FrontFixing::profile(double time,
                                            const Eigen::VectorXd &state) const
  {
    return {time, state[size - 1], near_values(time, state), far_values(time, state)};
  }

  double FrontFixing::excess(const Profile &profile, double coordinate) const
  {
    const double r = std::clamp(coordinate, problem.inner, problem.outer);
    if(r > profile.front)
      return far.solved ? far_basis.interpolate(
                 profile.far, (r - profile.front) / (problem.outer - profile.front))
                        : 0;
    const double x = (r - problem.inner) / (profile.front - problem.inner);
    return near_basis.interpolate(profile.near, near.centre ? x * x : x);
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
    const double stretch = far_basis.stretch;
    const double layer = stretch > 0 ? stretch / std::sinh(stretch) : 1;
    const auto part = [&](const Side &side, double from, double to, const auto &panel)
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
