#include <cases/error.h>
#include <cases/step_ends.h>
#include <cases/time_integral.h>
#include <particles/sph/time/time_stepping.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    bool guarded(const SphParameters &p)
    {
      return p.step_limit == StepLimit::monotone;
    }

    /** Equal steps of at most some length. @throws cases::Refusal for too many. */
    long steps_within(double duration, double step)
    {
      const double steps = std::ceil(duration / step * (1 - 1e-12));
      if(!(steps <= cases::most_steps))
        throw cases::Refusal(fmt::format("steps of {:.3g} s would be {:.3g} in number, "
                                         "and at most {:.0e} are possible",
                                         step, steps, cases::most_steps));
      return std::max(1L, static_cast<long>(steps));
    }

    long steps_for(double duration, double step)
    {
      return std::max(fewest_steps, steps_within(duration, step));
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

  double monotone_step(const cases::Scene &scene, double particle_mass,
                       double largest_row_sum, double largest_front_factor)
  {
    const auto &curves = scene.material.curves;
    if(!curves)
      return monotone_step(scene.material, particle_mass, largest_row_sum,
                           largest_front_factor);
    const cases::TemperatureBounds bounds = cases::temperature_bounds(scene);
    return particle_mass / (largest_front_factor * largest_row_sum)
           * curves->least_slope(bounds.lower, bounds.upper);
  }

  double stable_step(const cases::Scene &scene, double particle_mass,
                     double largest_eigenvalue)
  {
    const cases::Material &m = scene.material;
    double slope = std::min(m.solid.specific_heat_capacity / m.solid.conductivity,
                            m.liquid.specific_heat_capacity / m.liquid.conductivity);
    if(m.curves)
    {
      const cases::TemperatureBounds bounds = cases::temperature_bounds(scene);
      slope = m.curves->least_slope(bounds.lower, bounds.upper);
    }
    return 2 * particle_mass * slope / largest_eigenvalue;
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

  double work_of_newton_iteration(std::size_t half_bandwidth)
  {
    return 3 + (2. * half_bandwidth + 1);
  }

  namespace
  {
    /** Why steps cannot be chosen by an error; null if they can. */
    const char *why_equal_steps(const SphParameters &p, const TimeSchemeDemand &demand)
    {
      if(p.steps > 0)
        return "their number is given";
      if(!guarded(p) || p.step_factor == 0)
        return "their length is given";
      if(demand.displaces_liquid)
        return "liquid is displaced after each of them";
      if(demand.moves_sources)
        return "a source moves on with each of them";
      if(demand.half_bandwidth == 0)
        return "particles are not along a line";
      return nullptr;
    }

    /** Share of a particle by which a front may be elsewhere after a step, if that were
     * of first order. */
    constexpr double usual_step_error = 0.01;
  } // namespace

  std::string settle_time_scheme(SphParameters &p, const TimeSchemeDemand &demand)
  {
    if(p.time_scheme != TimeScheme::automatic)
      return "";
    const char *reason = why_equal_steps(p, demand);
    if(reason && p.step_error > 0)
      throw cases::Refusal(fmt::format(
          "steps cannot be chosen by an error (step_error) with time_scheme = automatic, "
          "for {}; the implicit schemes may do so",
          reason));
    const double super_work
        = demand.duration / demand.explicit_step * p.stages / super_step_reach(p.stages);
    const double implicit_work = fewest_steps * usual_newton_iterations
                                 * work_of_newton_iteration(demand.half_bandwidth);
    if(!reason && p.step_error == 0 && super_work <= implicit_work)
      reason = "implicit ones would cost more";
    if(!reason)
    {
      if(p.step_error == 0)
        p.step_error = usual_step_error;
      return "as long as an error allows, by RKL2 or two implicit stages, whichever "
             "costs "
             "less";
    }
    p.time_scheme = TimeScheme::rkl2;
    return fmt::format("equal, for {}", reason);
  }

  int stages_reaching(double reach)
  {
    // (s^2 + s - 2)/4 = reach
    const double root = std::sqrt(2.25 + 4 * reach * (1 - 1e-12)) - 0.5;
    return static_cast<int>(std::ceil(std::clamp(root, 3., 1e9)));
  }

  double longest_euler_step(const StepPlan &plan)
  {
    return plan.stages > 1 ? std::max(plan.step / plan.euler_substeps,
                                      plan.step / super_step_reach(plan.stages))
                           : plan.step;
  }

  namespace
  {
    /** Steps that are to be too long are not made shorter for the sake of samples. */
    long steps_for(const SphParameters &p, double duration, double step)
    {
      return guarded(p) ? steps_for(duration, step) : steps_within(duration, step);
    }

    void refuse_unstable_step(double step, double monotone)
    {
      if(step > monotone * (1 + 1e-12))
        throw cases::Refusal(fmt::format(
            "a step of {:.6g} s is {:.4g} times the largest one, {:.6g} s, that keeps "
            "the maximum principle and is certainly stable",
            step, step / monotone, monotone));
    }

    /** So many equal steps; super steps with the fewest stages that reach so far. */
    StepPlan plan_given_steps(const SphParameters &p, double duration, double euler,
                              const StepLimits &limits)
    {
      StepPlan plan{p.steps, duration / p.steps, 1, limits, 1, 0};
      if(p.time_scheme == TimeScheme::euler && guarded(p))
        refuse_unstable_step(plan.step, limits.monotone);
      if(p.time_scheme == TimeScheme::rkl2)
      {
        plan.stages = stages_reaching(plan.step / euler);
        if(plan.stages > p.stages)
          throw cases::Refusal(fmt::format(
              "a step of {:.6g} s needs super steps of {} stages, and at most {} are "
              "allowed",
              plan.step, plan.stages, p.stages));
        plan.resolved_steps = std::min<long>(8, p.steps);
      }
      return plan;
    }

    StepPlan plan_long_steps(const SphParameters &p, double duration, double euler,
                             const StepLimits &limits)
    {
      StepPlan plan{steps_for(p, duration, euler), 0, 1, limits, 1, 8};
      if(p.time_scheme != TimeScheme::rkl2)
        return plan;
      const long steps = steps_for(p, duration, euler * super_step_reach(p.stages));
      const int stages = stages_reaching(duration / (euler * steps));
      // Few stages gain nothing over as many explicit steps.
      if(stages * steps < plan.steps)
      {
        plan.steps = steps;
        plan.stages = stages;
      }
      return plan;
    }
    StepPlan plan_lengths(const SphParameters &p, const cases::Scene &scene,
                          const StepLimits &limits, double smoothing_length)
    {
      const double duration = scene.end_time - scene.start_time;
      const double euler
          = p.step_factor > 0
                ? p.step_factor * (guarded(p) ? limits.monotone : limits.stable)
                : published_step(scene.material, smoothing_length);
      if(p.time_scheme == TimeScheme::automatic)
        return {0, std::min(euler, duration / fewest_steps), 1, limits, 1, 0};
      if(is_implicit(p.time_scheme) && p.steps == 0)
      {
        const long steps = steps_within(duration, euler);
        return {steps, duration / steps, 1, limits, 1, 0};
      }
      if(!is_implicit(p.time_scheme) && guarded(p))
        refuse_unstable_step(euler, limits.monotone);
      StepPlan plan = p.steps > 0 ? plan_given_steps(p, duration, euler, limits)
                                  : plan_long_steps(p, duration, euler, limits);
      plan.step = duration / plan.steps;
      plan.euler_substeps = static_cast<int>(steps_within(plan.step, euler));
      return plan;
    }

    /** Of the steps that a plan may lead to. */
    double longest_step(const SphParameters &p, const StepPlan &plan, double duration)
    {
      if(p.time_scheme == TimeScheme::automatic)
        return duration / fewest_steps;
      return p.step_error > 0 ? duration : plan.step;
    }
  } // namespace

  StepPlan plan_steps(const SphParameters &p, const cases::Scene &scene,
                      const StepLimits &limits, double smoothing_length)
  {
    StepPlan plan = plan_lengths(p, scene, limits, smoothing_length);
    plan.ends = p.steps > 0 ? cases::breakpoints_of(scene)
                            : cases::step_ends(
                                scene, p.n,
                                longest_step(p, plan, scene.end_time - scene.start_time));
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
