#include <cases/exact/planar_neumann.h>
#include <particles/core/arrangement.h>
#include <particles/rkpm_tracked/line/tests/cases.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  cases::Material bar_material(double conductivity_ratio, double latent_heat,
                               double density_ratio)
  {
    cases::Material material;
    material.melting_temperature = 430;
    material.latent_heat = latent_heat;
    material.solid.conductivity = conductivity_ratio;
    material.solid.density = density_ratio;
    return material;
  }

  double ExactLine::time_of(double place) const
  {
    const double share = place / front(1.);
    return share * share;
  }

  ExactLine neumann(const cases::Material &material)
  {
    const auto exact = std::make_shared<cases::PlanarNeumann>(material, hot, cold);
    return {[exact](double t) { return exact->front(t); },
            [exact](double x, double t) { return exact->temperature(x, t); }};
  }

  ExactLine neumann_with_open_wall(const cases::Material &material)
  {
    using std::erf, std::erfc, std::exp, std::sqrt;
    const double a_l = material.liquid.diffusivity(), a_s = material.solid.diffusivity();
    const double r = material.solid.density / material.liquid.density;
    const double nu = sqrt(a_l / a_s), melting = material.melting_temperature;
    const auto defect = [=](double lambda)
    {
      const double q = (1 - r) * lambda;
      const double liquid = material.liquid.conductivity * (hot - melting)
                            * exp(-r * r * lambda * lambda)
                            / (sqrt(std::numbers::pi * a_l) * (erf(r * lambda) + erf(q)));
      const double solid = material.solid.conductivity * (melting - cold)
                           * exp(-nu * nu * lambda * lambda)
                           / (sqrt(std::numbers::pi * a_s) * erfc(nu * lambda));
      return material.solid.density * material.latent_heat * lambda * sqrt(a_l) - liquid
             + solid;
    };
    double lower = 1e-9, upper = 4 / std::max(r, 1.);
    for(int i = 0; i < 200; ++i)
      (defect((lower + upper) / 2) < 0 ? lower : upper) = (lower + upper) / 2;
    const double lambda = lower;
    return {[=](double t) { return 2 * lambda * sqrt(a_l * t); },
            [=](double x, double t)
            {
              const double q = (1 - r) * lambda, eta = x / (2 * sqrt(a_l * t));
              if(eta < lambda)
                return hot
                       + (melting - hot) * (erf(eta - q) + erf(q))
                             / (erf(r * lambda) + erf(q));
              return cold
                     + (melting - cold) * erfc(x / (2 * sqrt(a_s * t)))
                           / erfc(nu * lambda);
            }};
  }

  LineProblem unit_slab(const cases::Material &material, int n,
                        std::function<double(double)> lower_wall,
                        std::function<double(double)> upper_wall, double displacement)
  {
    LineProblem problem;
    problem.material = material;
    problem.spacing = 1. / n;
    ParticleStorage places;
    places.dimension = 1;
    for(int i = 0; i <= n; ++i)
      places.add({static_cast<double>(i) / n, 0, 0});
    if(displacement > 0)
      jitter(places, displacement / n, 1,
             [](const std::array<double, 3> &p) { return p[0] > 0 && p[0] < 1; });
    problem.nodes = places.position[0];
    const auto held = cases::BoundaryKind::fixed_temperature;
    problem.walls[0] = {held, std::move(lower_wall), 0};
    problem.walls[1] = {held, std::move(upper_wall), 0};
    return problem;
  }

  LineState state_of(const ExactLine &exact, const LineProblem &problem, double time)
  {
    LineState state;
    state.time = time;
    state.solid_first = false;
    state.fronts = {exact.front(time)};
    for(const double x : problem.nodes)
      state.temperature.push_back(exact.temperature(x, time));
    return state;
  }

  MeltingResult melt(const MeltingRun &run)
  {
    const double begin = run.exact.time_of(0.06), end = run.exact.time_of(0.18);
    const auto far = [&run](double t) { return run.exact.temperature(1., t); };
    LineProblem problem = unit_slab(
        run.material, run.n, [](double) { return hot; }, far, run.jitter);
    problem.displaced = run.displaced;
    problem.form = Form::collocation;
    const LineSettings settings{run.basis_order, default_dilation(run.basis_order),
                                run.interpolation_distance, run.time_order};
    LineSolver solver(problem, settings);
    const double step = (end - begin) / run.steps;
    solver.restart(state_of(run.exact, problem, begin));
    for(int k = 1; k < run.time_order && begin - k * step > 0; ++k)
      solver.add_older(state_of(run.exact, problem, begin - k * step));
    for(int k = 1; k <= run.steps; ++k)
      EXPECT_EQ(solver.step_to(begin + k * step), StepOutcome::accepted);
    MeltingResult result;
    result.front = solver.state().fronts[0];
    result.front_error = result.front - run.exact.front(solver.state().time);
    for(std::size_t i = 0; i < problem.nodes.size(); ++i)
      result.temperature_error
          = std::max(result.temperature_error,
                     std::abs(solver.state().temperature[i]
                              - run.exact.temperature(problem.nodes[i], end)));
    return result;
  }

  double fitted_order(const std::vector<double> &errors)
  {
    const auto n = static_cast<double>(errors.size());
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for(std::size_t i = 0; i < errors.size(); ++i)
    {
      const double x = static_cast<double>(i), y = -std::log2(std::abs(errors[i]));
      sum_x += x;
      sum_y += y;
      sum_xx += x * x;
      sum_xy += x * y;
    }
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
  }

  double default_dilation(int basis_order)
  {
    return std::min(basis_order + 0.6, 3.6);
  }
} // namespace meltfront::particles::rkpm_tracked
