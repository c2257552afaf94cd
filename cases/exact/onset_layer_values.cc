#include <cases/error.h>
#include <cases/exact/heat_quadrature.h>
#include <cases/exact/lagrange_points.h>
#include <cases/exact/onset_layer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  std::string OnsetLayer::description() const
  {
    const char *what = sign > 0 ? "freezing" : "melting";
    return fmt::format("{} at the {} wall from t = {:.12g} on, {}",
                       grows() ? what : "a layer", problem.at_inner ? "inner" : "outer",
                       problem.time, problem.before->description());
  }

  Symmetry OnsetLayer::symmetry() const
  {
    return problem.before->symmetry();
  }

  double OnsetLayer::start_time() const
  {
    return problem.before->start_time();
  }

  double OnsetLayer::end_time() const
  {
    return problem.time + last_tau * last_tau;
  }

  bool OnsetLayer::solid_at_origin() const
  {
    return problem.before->solid_at_origin() != (grows() && problem.at_inner);
  }

  double OnsetLayer::inner() const
  {
    return problem.before->inner();
  }

  double OnsetLayer::outer() const
  {
    return problem.before->outer();
  }

  double OnsetLayer::root_of_time(double time) const
  {
    const double slack = 1e-9 * (end_time() - start_time());
    if(!(time <= end_time() + slack))
      throw InputError(
          fmt::format("spectral oracle: time {} is after {}", time, end_time()));
    return std::sqrt(std::max(time - problem.time, 0.));
  }

  Eigen::VectorXd OnsetLayer::at(double tau) const
  {
    return solution
           * spectral::interpolation_weights(
               points, spectral::barycentric_weights(points), tau / last_tau);
  }

  std::vector<double> OnsetLayer::fronts(double time) const
  {
    std::vector<double> result = problem.before->fronts(time);
    if(!grows())
      return result;
    const double tau = root_of_time(time);
    const double thickness = tau > 0 ? std::pow(tau, q) * unpack(at(tau)).sigma : 0;
    result.insert(problem.at_inner ? result.begin() : result.end(),
                  wall + along * thickness);
    return result;
  }

  double OnsetLayer::layer_excess(const Unknowns &u, double tau, double thickness,
                                  double distance) const
  {
    const double x = (distance - thickness)
                     / (2 * std::sqrt(old_phase.diffusivity()) * tau * last_xi);
    return x < 1 ? std::pow(tau, g) * layer_basis.interpolate(u.v, x) : 0;
  }

  double OnsetLayer::temperature(double coordinate, double time) const
  {
    const double tau = root_of_time(time);
    const double r = std::clamp(coordinate, inner(), outer());
    if(tau == 0)
      return problem.before->temperature(r, time);
    const Unknowns u = unpack(at(tau));
    const double thickness = std::pow(tau, q) * u.sigma;
    const double distance = std::abs(r - wall);
    if(grows() && distance < thickness)
      return problem.material.melting_temperature
             + std::pow(tau, e) * phase_basis.interpolate(u.p, distance / thickness);
    return problem.before->temperature(r, time)
           + layer_excess(u, tau, thickness, distance);
  }

  double OnsetLayer::heat_content(double lower, double upper, double time) const
  {
    lower = std::clamp(lower, inner(), outer());
    upper = std::clamp(upper, inner(), outer());
    const double tau = root_of_time(time);
    if(tau == 0)
      return problem.before->heat_content(lower, upper, time);
    const Unknowns u = unpack(at(tau));
    const double thickness = std::pow(tau, q) * u.sigma;
    const double front = wall + along * thickness;
    const double split = std::clamp(front, lower, upper);
    const double layer = 2 * std::sqrt(old_phase.diffusivity()) * tau * last_xi;
    const double from = problem.at_inner ? lower : split,
                 to = problem.at_inner ? split : upper;
    const double beyond_from = problem.at_inner ? split : lower,
                 beyond_to = problem.at_inner ? upper : split;
    const double layer_from
        = std::clamp(std::min(front, front + along * layer), beyond_from, beyond_to),
        layer_to
        = std::clamp(std::max(front, front + along * layer), beyond_from, beyond_to);
    const double latent = sign > 0 ? 0
                                   : new_phase.density * problem.material.latent_heat
                                         * volume_between(symmetry(), from, to);
    return latent
           + new_phase.volumetric_heat_capacity()
                 * integrate_panels(
                     symmetry(), from, to,
                     [&](double r)
                     {
                       return std::pow(tau, e)
                              * phase_basis.interpolate(u.p,
                                                        std::abs(r - wall) / thickness);
                     },
                     [&](double) { return thickness; })
           + problem.before->heat_content(beyond_from, beyond_to, time)
           + old_phase.volumetric_heat_capacity()
                 * integrate_panels(
                     symmetry(), layer_from, layer_to,
                     [&](double r)
                     { return layer_excess(u, tau, thickness, std::abs(r - wall)); },
                     [&](double) { return layer / 8; });
  }
} // namespace meltfront::cases
