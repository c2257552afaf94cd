#include <cases/error.h>
#include <particles/sph/time_stepping.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** Fewest steps of a run, so that fronts can be sampled at 100 times. */
    constexpr long fewest_steps = 200;

    long steps_for(double duration, double step)
    {
      return std::max(fewest_steps,
                      static_cast<long>(std::ceil(duration / step * (1 - 1e-12))));
    }
  } // namespace

  double monotone_step(const cases::Material &material, double particle_mass,
                       double largest_row_sum, double largest_front_factor)
  {
    const double solid = material.solid.conductivity;
    const double liquid = material.liquid.conductivity;
    const double mean = solid == liquid ? 0 : 2 * solid * liquid / (solid + liquid);
    return particle_mass / (largest_front_factor * largest_row_sum)
           * std::min(material.solid.specific_heat_capacity / std::max(solid, mean),
                      material.liquid.specific_heat_capacity / std::max(liquid, mean));
  }

  double published_step(const cases::Material &material, double smoothing_length)
  {
    return 0.15 * smoothing_length * smoothing_length
           * std::min(1 / material.solid.diffusivity(),
                      1 / material.liquid.diffusivity());
  }

  double super_step_reach(int stages)
  {
    return (double(stages) * stages + stages - 2) / 4;
  }

  StepPlan plan_steps(const SphParameters &p, const cases::Scene &scene, double monotone,
                      double smoothing_length)
  {
    const double duration = scene.end_time - scene.start_time;
    const double euler = p.step_factor > 0
                             ? p.step_factor * monotone
                             : published_step(scene.material, smoothing_length);
    if(is_implicit(p.time_scheme))
    {
      const long steps
          = std::max(1L, std::lround(std::ceil(duration / euler * (1 - 1e-12))));
      return {steps, duration / steps, 1, monotone, 1, 0};
    }
    if(euler > monotone * (1 + 1e-12))
      throw cases::Refusal(fmt::format(
          "a step of {:.6g} s is {:.4g} times the largest one, {:.6g} s, that keeps the "
          "maximum principle and is certainly stable",
          euler, euler / monotone, monotone));
    StepPlan plan{steps_for(duration, euler), 0, 1, monotone, 1, 8};
    if(p.time_scheme == TimeScheme::rkl2)
    {
      const long steps = steps_for(duration, euler * super_step_reach(p.stages));
      int stages = 3;
      while(super_step_reach(stages) * euler * steps < duration * (1 - 1e-12))
        ++stages;
      // Few stages gain nothing over as many explicit steps.
      if(stages * steps < plan.steps)
      {
        plan.steps = steps;
        plan.stages = stages;
      }
    }
    plan.step = duration / plan.steps;
    plan.euler_substeps
        = std::max(1, static_cast<int>(std::ceil(plan.step / euler * (1 - 1e-12))));
    return plan;
  }

  SuperStep::SuperStep(int s)
  {
    const auto b = [](int j)
    { return j < 2 ? 1. / 3 : (double(j) * j + j - 2) / (2. * j * (j + 1)); };
    const double w = 4 / (double(s) * s + s - 2);
    const auto fraction
        = [w](int j) { return j < 2 ? w / 3 : (double(j) * j + j - 2) * w / 4; };
    first_rate = b(1) * w;
    for(int j = 2; j <= s; ++j)
    {
      SuperStage stage;
      stage.previous = (2. * j - 1) / j * b(j) / b(j - 1);
      stage.before = -(j - 1.) / j * b(j) / b(j - 2);
      stage.start = 1 - stage.previous - stage.before;
      stage.rate = stage.previous * w;
      stage.start_rate = -(1 - b(j - 1)) * stage.rate;
      stage.fraction = fraction(j - 1);
      stages.push_back(stage);
    }
  }
} // namespace meltfront::particles
