#include <cases/compensated_sum.h>
#include <cases/scene.h>
#include <particles/sph/heat_flow.h>
#include <particles/sph/initial_state.h>
#include <particles/sph/run_report.h>
#include <particles/sph/sph_run.h>
#include <particles/sph/time/stepper.h>
#include <particles/sph/time/time_stepping.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace meltfront::particles
{
  namespace
  {
    class SphRun : public cases::Run
    {
    public:
      SphRun(const SphPolicy &policy, const cases::Scene &scene,
             const cases::EffectSet &effects, const cases::Resolution &resolution)
        : scene(scene)
        , parameters(resolve_parameters(policy, scene, resolution))
        , dis(scene, parameters)
        , n(dis.particles.size())
        , heat_flow(dis, effects, parameters)
        , plan(plan_steps(
              parameters, scene,
              heat_flow.monotone_step(dis.particle_volume * scene.material.solid.density),
              dis.kernel.smoothing_length()))
        , stepper(make_stepper(parameters, heat_flow, dis, plan, initial_enthalpy(dis),
                               policy.name))
        , temperature(n)
        , solid_fraction(n)
        , initial_heat(heat_content())
      {
      }

      cases::RunDescription describe() const override
      {
        return describe_run(dis, parameters, plan, unknowns(), heat_flow.describe());
      }

      cases::Cost cost() const override
      {
        cases::Cost result;
        const StepCounts counts = stepper->counts();
        result.steps = steps;
        result.unknowns = unknowns();
        result.work = heat_flow.work();
        result.solver_iterations = counts.linear_iterations;
        result.most_iterations = counts.most_iterations;
        result.capped_steps = counts.repeated;
        result.effects = heat_flow.effect_costs();
        return result;
      }

    private:
      void take_steps() override
      {
        double time = scene.start_time;
        reached(0, time);
        while(time < scene.end_time)
        {
          time = stepper->advance(++steps, time);
          reached(steps, time);
        }
        if(parameters.step_error > 0)
          note(scene.end_time, fmt::format("{} steps were accepted and {} rejected",
                                           steps, stepper->counts().repeated));
      }

      cases::HeatBudget heat_content() const
      {
        const std::span<const double> enthalpy = stepper->enthalpies();
        const cases::Material &m = scene.material;
        cases::CompensatedSum stored, latent;
        for(std::size_t a = 0; a < n; ++a)
        {
          const double mass = dis.weights[a] * m.solid.density;
          latent.add(mass * std::clamp(enthalpy[a], 0., m.latent_heat));
          stored.add(
              mass
              * (std::min(enthalpy[a], 0.) + std::max(enthalpy[a] - m.latent_heat, 0.)));
        }
        cases::HeatBudget heat;
        heat.stored = stored.value();
        heat.latent = latent.value();
        heat.initial = heat.stored + heat.latent;
        return heat;
      }

      cases::Snapshot snapshot(long step, double time) override
      {
        const cases::Material &m = scene.material;
        const std::span<const double> enthalpy = stepper->enthalpies();
        for(std::size_t a = 0; a < n; ++a)
        {
          temperature[a] = m.temperature(enthalpy[a]);
          solid_fraction[a] = m.solid_fraction(enthalpy[a]);
        }
        cases::Snapshot result
            = particle_snapshot(dis, step, time, temperature, solid_fraction);
        result.heat = heat_content();
        result.heat.initial = initial_heat.initial;
        result.heat.boundary = stepper->boundary_heat();
        result.heat.sources = heat_flow.source_heat(time) / dis.cross_section;
        return result;
      }

      long unknowns() const
      {
        return static_cast<long>(n - dis.dirichlet.size());
      }

      const cases::Scene &scene;
      SphParameters parameters;
      Discretisation dis;
      std::size_t n; ///< particles
      HeatFlow heat_flow;
      StepPlan plan;
      std::unique_ptr<Stepper> stepper;
      long steps = 0;                                  ///< made so far
      std::vector<double> temperature, solid_fraction; ///< for snapshots
      cases::HeatBudget initial_heat;
    };
  } // namespace

  std::unique_ptr<cases::Run> make_sph_run(const SphPolicy &policy,
                                           const cases::Scene &scene,
                                           const cases::EffectSet &effects,
                                           const cases::Resolution &resolution)
  {
    return std::make_unique<SphRun>(policy, scene, effects, resolution);
  }
} // namespace meltfront::particles
