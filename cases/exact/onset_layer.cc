#include <cases/error.h>
#include <cases/exact/lagrange_points.h>
#include <cases/exact/onset_layer.h>
#include <cases/exact/planar_neumann.h>
#include <cases/wall_law.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    constexpr int layer_intervals = 38, phase_intervals = 12, before_intervals = 16;
    constexpr int n_points = 14;

    /** What the two highest powers of tau may leave: of the temperature in the old phase,
     * in the new one and of its thickness. */
    constexpr double allowed_tail = 1e-12;

    /** Points of Chebyshev, Radau and Gauss in (0, 1], the last one 1. */
    Eigen::VectorXd radau_points()
    {
      Eigen::VectorXd points(n_points);
      for(int i = 0; i < n_points; ++i)
        points[n_points - 1 - i]
            = (1 + std::cos(2 * std::numbers::pi * i / (2 * n_points - 1))) / 2;
      return points;
    }

    /** Rows: values at the points; columns: Chebyshev polynomials on [0, 1]. */
    Eigen::MatrixXd chebyshev_values(const Eigen::VectorXd &points)
    {
      Eigen::MatrixXd values(points.size(), points.size());
      for(Eigen::Index i = 0; i < points.size(); ++i)
        for(Eigen::Index k = 0; k < points.size(); ++k)
          values(i, k) = std::cos(static_cast<double>(k) * std::acos(2 * points[i] - 1));
      return values;
    }
  } // namespace

  OnsetLayer::OnsetLayer(const OnsetProblem &problem)
    : problem(problem)
    , old_phase(problem.material.liquid)
    , new_phase(problem.material.solid)
    , sign(1)
    , wall(problem.at_inner ? problem.before->inner() : problem.before->outer())
    , along(problem.at_inner ? 1 : -1)
    , exponent(problem.before->symmetry() == Symmetry::planar        ? 0
               : problem.before->symmetry() == Symmetry::cylindrical ? 1
                                                                     : 2)
    , layer_basis(layer_intervals)
    , phase_basis(phase_intervals)
    , before_basis(before_intervals)
    , points(radau_points())
    , differentiation(spectral::differentiation_matrix(points))
  {
    const auto phases = problem.before->fronts(problem.before->start_time()).size();
    const bool old_is_solid
        = problem.before->solid_at_origin() == (problem.at_inner || phases % 2 == 0);
    if(old_is_solid)
    {
      std::swap(old_phase, new_phase);
      sign = -1;
    }
    q = e = problem.onset == Onset::by_wall_law ? 3 : 2;
    g = 2;
    if(problem.onset == Onset::jump || problem.onset == Onset::wall_layer)
      q = 1, e = g = 0;
    double tau = longest_tau();
    const int most_attempts = 20;
    int attempt = 0;
    while(!solve(tau) && ++attempt < most_attempts)
      tau *= 0.75;
    if(attempt == most_attempts)
      throw NumericalError("spectral oracle", 0, problem.time, "what sets in at a wall",
                           "is not resolved however short the time after it");
  }

  double OnsetLayer::longest_tau() const
  {
    const double share_of_domain = 0.45, share_to_front = 0.9;
    const double end = problem.time + problem.longest;
    double room = share_of_domain * (outer() - inner());
    for(const double time : {problem.time, end})
    {
      const std::vector<double> others = problem.before->fronts(time);
      if(!others.empty())
        room = std::min(
            room,
            share_to_front
                * std::abs((problem.at_inner ? others.front() : others.back()) - wall));
    }
    return std::min(std::sqrt(problem.longest),
                    room / (2 * std::sqrt(old_phase.diffusivity()) * last_xi));
  }

  int OnsetLayer::size() const
  {
    return layer_intervals + (grows() ? phase_intervals + 1 : 0);
  }

  OnsetLayer::Unknowns OnsetLayer::unpack(const Eigen::VectorXd &values) const
  {
    Unknowns u{Eigen::VectorXd::Zero(layer_intervals + 1),
               Eigen::VectorXd::Zero(phase_intervals + 1), 0};
    u.v.head(layer_intervals) = values.head(layer_intervals);
    if(grows())
    {
      u.p.head(phase_intervals) = values.segment(layer_intervals, phase_intervals);
      u.sigma = values[size() - 1];
    }
    return u;
  }

  OnsetLayer::Instant OnsetLayer::instant(double tau) const
  {
    const double time = problem.time + tau * tau;
    Instant result{tau, time, 4 * std::sqrt(old_phase.diffusivity()) * last_tau,
                   Eigen::VectorXd(before_intervals + 1),
                   problem.wall.value ? problem.wall.value(time) : 0};
    for(int i = 0; i <= before_intervals; ++i)
      result.old_excess[i]
          = problem.before->temperature(
                wall + along * before_basis.nodes[i] * result.reach, time)
            - problem.material.melting_temperature;
    return result;
  }

  Eigen::VectorXd OnsetLayer::first_guess(const Instant &last) const
  {
    const double melting = problem.material.melting_temperature;
    const double root_a = std::sqrt(old_phase.diffusivity());
    const double latent = old_phase.density * problem.material.latent_heat;
    const double old_wall = last.old_excess[0];
    const double old_slope = before_basis.first.row(0).dot(last.old_excess) / last.reach;
    const double tau = last.tau;
    double sigma = 0, wall_value = 0;
    switch(problem.onset)
    {
    case Onset::wall_layer:
      break;
    case Onset::jump:
    {
      const PlanarNeumann neumann(problem.material, last.given, melting + old_wall);
      sigma = neumann.front(1);
      wall_value = last.given - melting;
      break;
    }
    case Onset::at_melting:
      if(problem.wall.kind == BoundaryKind::fixed_temperature)
      {
        wall_value = (last.given - melting) / (tau * tau);
        const double lost = sign * old_phase.conductivity * old_slope;
        sigma = (std::sqrt(lost * lost
                           - 4 * latent * new_phase.conductivity * sign * wall_value)
                 - lost)
                / (2 * latent);
      }
      else
      {
        const double flux = heat_through(problem.wall.law(), last.given, melting).flux;
        sigma = -sign * flux / latent;
        wall_value = sigma * flux / new_phase.conductivity;
      }
      break;
    case Onset::by_wall_law:
      sigma = -sign * 4 * old_phase.conductivity * old_wall / (tau * tau)
              / (3 * latent * std::sqrt(std::numbers::pi) * root_a);
      wall_value = -sigma * old_phase.conductivity * old_slope / new_phase.conductivity;
    }
    Eigen::VectorXd guess(size());
    for(int i = 0; i < layer_intervals; ++i)
      guess[i] = grows() ? -old_wall / std::pow(tau, g)
                               * std::erfc(last_xi * layer_basis.nodes[i])
                         : 0;
    for(int i = 0; grows() && i < phase_intervals; ++i)
      guess[layer_intervals + i] = wall_value * (1 - phase_basis.nodes[i]);
    if(grows())
      guess[size() - 1] = sigma;
    return guess;
  }

  Eigen::VectorXd OnsetLayer::residual(const Instant &at, const Eigen::VectorXd &values,
                                       const Eigen::VectorXd &slopes) const
  {
    const Unknowns u = unpack(values), slope = unpack(slopes);
    const double tau = at.tau, root_a = std::sqrt(old_phase.diffusivity());
    const double thickness = std::pow(tau, q) * u.sigma;
    const double front_speed = std::pow(tau, q - 1) * (q * u.sigma + slope.sigma);
    const Eigen::VectorXd first = layer_basis.first * u.v / last_xi;
    const Eigen::VectorXd second = layer_basis.second * u.v / (last_xi * last_xi);
    Eigen::VectorXd result(size());
    for(int i = 1; i < layer_intervals; ++i)
    {
      const double xi = last_xi * layer_basis.nodes[i];
      const double r = wall + along * (thickness + 2 * root_a * tau * xi);
      const double curvature = exponent > 0 ? root_a * tau * along * exponent / r : 0;
      result[i] = second[i] / 2 - g * u.v[i] - slope.v[i]
                  + first[i] * (xi + front_speed / (2 * root_a) + curvature);
    }
    if(grows())
    {
      const double at_front
          = before_basis.interpolate(at.old_excess, thickness / at.reach);
      result[0] = u.v[0] + at_front / std::pow(tau, g);
      new_phase_residual(at, u, slope, result);
    }
    else
    {
      const double own = problem.material.melting_temperature + at.old_excess[0] + u.v[0];
      result[0] = problem.wall.kind == BoundaryKind::fixed_temperature
                      ? own - at.given
                      : old_phase.conductivity * first[0] / (2 * root_a)
                            + tau * heat_through(problem.wall.law(), at.given, own).flux;
    }
    return result;
  }

  void OnsetLayer::new_phase_residual(const Instant &at, const Unknowns &u,
                                      const Unknowns &slope,
                                      Eigen::VectorXd &result) const
  {
    const double tau = at.tau, sigma = u.sigma;
    const double melting = problem.material.melting_temperature;
    const double thickness = std::pow(tau, q) * sigma;
    const double root_a = std::sqrt(old_phase.diffusivity());
    const Eigen::VectorXd first = phase_basis.first * u.p,
                          second = phase_basis.second * u.p;
    const double slowness
        = std::pow(tau, 2 * q - 2) * sigma * sigma / (2 * new_phase.diffusivity());
    for(int i = 1; i < phase_intervals; ++i)
    {
      const double x = phase_basis.nodes[i];
      const double curvature
          = exponent > 0 ? along * exponent * thickness / (wall + along * x * thickness)
                         : 0;
      result[layer_intervals + i]
          = second[i] + curvature * first[i]
            - slowness
                  * (e * u.p[i] + slope.p[i] - first[i] * x * (q + slope.sigma / sigma));
    }
    const double power = std::pow(tau, e);
    result[layer_intervals] = problem.wall.kind == BoundaryKind::fixed_temperature
                                  ? u.p[0] - (at.given - melting) / power
                                  : new_phase.conductivity * first[0]
                                        + sigma
                                              * heat_through(problem.wall.law(), at.given,
                                                             melting + power * u.p[0])
                                                    .flux;
    // The old phase's gradient at the front is the polynomial's, by its derivative.
    const Eigen::VectorXd old_first = before_basis.first * at.old_excess / at.reach;
    const double old_gradient = before_basis.interpolate(old_first, thickness / at.reach)
                                + std::pow(tau, g - 1) * layer_basis.first.row(0).dot(u.v)
                                      / last_xi / (2 * root_a);
    const double heat
        = new_phase.conductivity * std::pow(tau, e - q) * first[phase_intervals] / sigma
          - old_phase.conductivity * old_gradient;
    result[size() - 1] = (q * sigma + slope.sigma) / 2
                         - sign * std::pow(tau, 2 - q) * heat
                               / (old_phase.density * problem.material.latent_heat);
  }

  bool OnsetLayer::newton(const std::vector<Instant> &instants)
  {
    const int n = size();
    const int most_iterations = 25;
    double last_update = std::numeric_limits<double>::infinity();
    for(int iteration = 0; iteration < most_iterations; ++iteration)
    {
      const Eigen::MatrixXd slopes
          = points.asDiagonal() * differentiation * solution.transpose();
      Eigen::MatrixXd jacobian(n * n_points, n * n_points);
      Eigen::VectorXd right(n * n_points);
      for(int i = 0; i < n_points; ++i)
      {
        const Eigen::VectorXd values = solution.col(i), slope = slopes.row(i);
        right.segment(n * i, n) = -residual(instants[i], values, slope);
        for(int k = 0; k < n; ++k)
        {
          const double shift = 1e-5 * scale[k];
          const Eigen::VectorXd step = shift * Eigen::VectorXd::Unit(n, k);
          const Eigen::VectorXd by_value = (residual(instants[i], values + step, slope)
                                            - residual(instants[i], values - step, slope))
                                           / (2e-5);
          const Eigen::VectorXd by_slope = (residual(instants[i], values, slope + step)
                                            - residual(instants[i], values, slope - step))
                                           / (2e-5);
          for(int j = 0; j < n_points; ++j)
            jacobian.col(n * j + k).segment(n * i, n)
                = points[i] * differentiation(i, j) * by_slope;
          jacobian.col(n * i + k).segment(n * i, n) += by_value;
        }
      }
      for(int row = 0; row < n * n_points; ++row)
      {
        const double largest = jacobian.row(row).cwiseAbs().maxCoeff();
        jacobian.row(row) /= largest;
        right[row] /= largest;
      }
      const Eigen::VectorXd update = jacobian.partialPivLu().solve(right);
      if(!update.allFinite())
        return false;
      for(int i = 0; i < n_points; ++i)
        solution.col(i) += scale.cwiseProduct(update.segment(n * i, n));
      if(grows() && !(solution.row(n - 1).minCoeff() > 0))
        return false;
      double size = 0;
      for(int i = 0; i < n_points; ++i)
        size = std::max(size, weights_at(i)
                                  .cwiseProduct(update.segment(n * i, n))
                                  .lpNorm<Eigen::Infinity>());
      const double harmless = 1e-9;
      if(size < 1e-14 || (size < harmless && size > 0.3 * last_update))
        return true;
      last_update = size;
    }
    return false;
  }

  Eigen::VectorXd OnsetLayer::weights_at(int point) const
  {
    Eigen::VectorXd weights
        = Eigen::VectorXd::Constant(size(), std::pow(points[point], g));
    if(grows())
    {
      weights.tail(phase_intervals + 1).setConstant(std::pow(points[point], e));
      weights[size() - 1] = std::pow(points[point], q);
    }
    return weights;
  }

  bool OnsetLayer::resolved(double range) const
  {
    // Least squares by polynomials two degrees lower of what v, p and sigma count for: at
    // small tau they are what round-off in U leaves of them, and of no effect.
    const Eigen::MatrixXd basis = chebyshev_values(points).leftCols(n_points - 2);
    Eigen::VectorXd allowed = allowed_tail * scale;
    allowed.head(layer_intervals)
        = allowed.head(layer_intervals)
              .cwiseMax(allowed_tail * range / std::pow(last_tau, g));
    for(Eigen::Index k = 0; k < size(); ++k)
    {
      Eigen::VectorXd weights(n_points);
      for(int i = 0; i < n_points; ++i)
        weights[i] = weights_at(i)[k];
      const Eigen::MatrixXd weighted = weights.asDiagonal() * basis;
      const Eigen::VectorXd values = weights.cwiseProduct(solution.row(k).transpose());
      const Eigen::VectorXd fit = weighted.householderQr().solve(values);
      if((weighted * fit - values).lpNorm<Eigen::Infinity>() > allowed[k])
        return false;
    }
    return true;
  }

  double OnsetLayer::range_of_wall_layer(const Instant &last) const
  {
    const double before = problem.material.melting_temperature + last.old_excess[0];
    if(problem.wall.kind == BoundaryKind::fixed_temperature)
      return std::abs(last.given - before);
    return 2 * std::sqrt(old_phase.diffusivity()) * last.tau
           * std::abs(heat_through(problem.wall.law(), last.given, before).flux)
           / old_phase.conductivity;
  }

  bool OnsetLayer::solve(double tau)
  {
    last_tau = tau;
    std::vector<Instant> instants;
    for(int i = 0; i < n_points; ++i)
      instants.push_back(instant(points[i] * tau));
    const Eigen::VectorXd guess = first_guess(instants.back());
    const double fallback
        = problem.material.latent_heat / old_phase.specific_heat_capacity;
    const double temperatures
        = grows() ? guess.head(layer_intervals).lpNorm<Eigen::Infinity>()
                  : range_of_wall_layer(instants.back());
    scale.resize(size());
    scale.head(layer_intervals).setConstant(temperatures > 0 ? temperatures : fallback);
    if(grows())
    {
      const double phase
          = guess.segment(layer_intervals, phase_intervals).lpNorm<Eigen::Infinity>();
      scale.segment(layer_intervals, phase_intervals)
          .setConstant(phase > 0 ? phase : fallback);
      scale[size() - 1] = guess[size() - 1];
      if(!(scale[size() - 1] > 0))
        return false;
    }
    solution = guess.replicate(1, n_points);
    return newton(instants)
           && resolved(instants.back().old_excess.lpNorm<Eigen::Infinity>());
  }
} // namespace meltfront::cases
