#include <cases/compensated_sum.h>
#include <cases/error.h>
#include <cases/scene.h>
#include <cases/snapshot.h>
#include <cases/stopwatch.h>
#include <cases/temperature_slack.h>
#include <cases/time_integral.h>
#include <particles/alloy/mixture_state.h>
#include <particles/sph/run_report.h>
#include <particles/sph/time/explicit_scheme.h>
#include <particles/sph/time/implicit_scheme.h>
#include <particles/sph_mixture/implicit_mixture.h>
#include <particles/sph_mixture/mixture_flow.h>
#include <particles/sph_mixture/mixture_run.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace meltfront::particles
{
  namespace
  {
    constexpr const char *method_name = "sph-mixture";

    class MixtureRun : public cases::Run, private ImplicitScheme::Subject
    {
    public:
      MixtureRun(const cases::Scene &scene, const cases::EffectSet &effects,
                 const cases::Resolution &resolution)
        : scene(scene)
        , parameters(resolve_mixture_parameters(scene, resolution))
        , dis(scene, parameters.sph)
        , n(dis.particles.size())
        , substance(scene, method_name)
        , initial(dis, substance)
        , flows(dis, substance, effects, parameters, initial.uniform())
        , size(flows.padded_size())
        , bounds(initial.bounds(scene, substance))
        , particle_mass(dis.particle_volume * substance.density)
        , plan(plan_steps(parameters.sph, scene,
                          flows.step_limits(scene, particle_mass,
                                            parameters.sph.step_limit, dis.dirichlet),
                          dis.kernel.smoothing_length()))
        , temperature(n)
        , solid_fraction(n)
      {
        const std::size_t solutes = substance.n_solutes();
        // Without diffusion concentrations never change: they take no part in the steps.
        fields = 1 + (flows.diffuses() ? solutes : 0);
        state_of_all.assign(fields * size, 0.);
        std::copy(initial.enthalpy.begin(), initial.enthalpy.end(), state_of_all.begin());
        for(std::size_t s = 0; flows.diffuses() && s < solutes; ++s)
          std::copy(initial.concentration[s].begin(), initial.concentration[s].end(),
                    state_of_all.begin() + (s + 1) * size);
        if(is_implicit(parameters.sph.time_scheme))
        {
          implicit_scheme.emplace(parameters.sph, plan, scene, fields, method_name);
          implicit_mixture.emplace(flows, substance, n, particle_mass);
        }
        else
          scheme.emplace(plan, state_of_all.size(), state_of_all.size(), flows.threads());
        flows.prepare_step(scene.start_time,
                           cases::end_of_piece(plan.ends, scene.start_time, time_of(1)));
        flows.hold_walls(0, view());
        extremes = flows.follow(view());
        initial_heat = heat_content();
        for(std::size_t s = 0; s < solutes; ++s)
          initial_solute[s] = mass_of(s);
        initial_mass = mass();
      }

      cases::RunDescription describe() const override
      {
        return describe_run(dis, parameters.sph, plan, unknowns(), flows.describe());
      }

      cases::Cost cost() const override
      {
        cases::Cost result;
        result.steps = steps;
        result.unknowns = unknowns();
        result.work = flows.work();
        result.capped_steps = repeated_steps;
        if(implicit_scheme)
        {
          result.capped_steps = implicit_scheme->repeated();
          result.solver_iterations = implicit_mixture->equations().linear_iterations();
          result.most_iterations = implicit_mixture->equations().most_iterations();
        }
        const std::size_t arrays = flows.diffuses() ? (plan.stages > 1 ? 6 : 3) : 1;
        result.effects = flows.effect_costs(arrays * size * sizeof(double));
        return result;
      }

    private:
      void take_steps() override
      {
        double time = scene.start_time;
        reached(0, time);
        while(time < scene.end_time)
        {
          time = advance(++steps, time);
          check(steps, time);
          reached(steps, time);
        }
        if(parameters.sph.step_error > 0)
          note(scene.end_time, fmt::format("{} steps were accepted and {} rejected",
                                           steps, implicit_scheme->repeated()));
      }

      /** Time after a step; the end exactly. */
      double time_of(long step) const
      {
        return step == plan.steps ? scene.end_time
                                  : cases::snap_to_breakpoint(
                                      plan.ends, scene.start_time + step * plan.step);
      }

      std::span<const double> concentration(std::size_t solute) const
      {
        return flows.diffuses()
                   ? std::span<const double>(state_of_all).subspan((solute + 1) * size, n)
                   : std::span<const double>(initial.concentration[solute]);
      }

      MixtureView view()
      {
        const std::size_t solutes = substance.n_solutes();
        for(std::size_t s = 0; s < solutes; ++s)
          composition[s] = concentration(s);
        return {std::span(state_of_all).first(n), std::span(composition).first(solutes)};
      }

      /** @return the end of the step. */
      double advance(long step, double begin)
      {
        WallHeat heat;
        double end = time_of(step);
        if(implicit_scheme)
          end = implicit_scheme->make_step(*this, step, begin, heat);
        else
          while(begin < end)
          {
            const double next = cases::end_of_piece(plan.ends, begin, end);
            advance_explicitly(step, begin, next, heat);
            begin = next;
          }
        boundary_heat.add(heat.through / dis.cross_section);
        boundary_heat.add(heat.dirichlet);
        return end;
      }

      void advance_explicitly(long step, double begin, double end, WallHeat &heat)
      {
        flows.prepare_step(begin, end);
        const bool super = plan.stages > 1 && step > plan.resolved_steps;
        double through
            = super ? take_super_step(end - begin) : take_euler_steps(end - begin);
        double dirichlet = finish_step();
        if(super && breaks_bounds())
        {
          // Only convex combinations keep the maximum principle for certain: repeat the
          // step with these.
          scheme->restore(state_of_all);
          flows.follow(view());
          through = take_euler_steps(end - begin);
          dirichlet = finish_step();
          ++repeated_steps;
        }
        heat.through += through;
        heat.dirichlet += dirichlet;
      }

      std::vector<double> &state() override
      {
        return state_of_all;
      }

      bool attempt(double begin, double end, TimeScheme with, WallHeat &heat) override
      {
        const std::span<double> all(state_of_all);
        if(!implicit_mixture->take_step(view(), all.subspan(size), begin, end, with,
                                        heat))
          return false;
        heat.dirichlet += finish_step();
        return !breaks_bounds();
      }

      /** @return heat from the walls that particles hold. */
      double finish_step()
      {
        const double dirichlet = flows.hold_walls(1, view());
        extremes = flows.follow(view());
        return dirichlet;
      }

      /** @return heat through walls. */
      double take_euler_steps(double duration)
      {
        return scheme->take_euler_steps(
            state_of_all, duration, plan.euler_substeps, 1., particle_mass,
            [this] { flows.follow(view()); },
            [this](double fraction, std::vector<double> &flow)
            { return flows.evaluate(fraction, flow); });
      }

      /** @return heat through walls. */
      double take_super_step(double duration)
      {
        return scheme->take_super_step(
            state_of_all, duration, 1., particle_mass, [this] { flows.follow(view()); },
            [this](double fraction, std::vector<double> &flow)
            { return flows.evaluate(fraction, flow); });
      }

      static constexpr double bound_tolerance = 1e-9;

      bool breaks_bounds() const
      {
        const double slack = 0.5 * cases::temperature_slack(bounds, bound_tolerance);
        return !extremes.finite || extremes.lowest < bounds.lower - slack
               || extremes.highest > bounds.upper + slack || least_concentration() < 0;
      }

      double least_concentration() const
      {
        double least = 0;
        for(std::size_t field = 1; field < fields; ++field)
          for(std::size_t a = 0; a < n; ++a)
            least = std::min(least, state_of_all[field * size + a]);
        return least;
      }

      void check(long step, double time) const
      {
        constexpr double broken = std::numeric_limits<double>::quiet_NaN();
        cases::check_temperature(bounds, extremes.finite ? extremes.lowest : broken,
                                 extremes.finite ? extremes.highest : broken, method_name,
                                 step, time, bound_tolerance);
        const double least = least_concentration();
        if(least < -1e-12)
          throw cases::NumericalError(method_name, step, time, "concentration",
                                      fmt::format("is {:.6g}, below zero", least));
      }

      double mass() const
      {
        cases::CompensatedSum sum;
        for(std::size_t a = 0; a < n; ++a)
          sum.add(dis.weights[a] * substance.density);
        return sum.value();
      }

      double mass_of(std::size_t solute) const
      {
        const std::span<const double> c = concentration(solute);
        cases::CompensatedSum sum;
        for(std::size_t a = 0; a < n; ++a)
          sum.add(dis.weights[a] * substance.density * c[a]);
        return sum.value();
      }

      cases::HeatBudget heat_content() const
      {
        const double latent_heat = scene.material.latent_heat;
        const std::span<const double> liquid = flows.liquid_fraction();
        cases::CompensatedSum stored, latent;
        for(std::size_t a = 0; a < n; ++a)
        {
          const double weight = dis.weights[a] * substance.density;
          latent.add(weight * latent_heat * liquid[a]);
          stored.add(weight * (state_of_all[a] - latent_heat * liquid[a]));
        }
        cases::HeatBudget heat;
        heat.stored = stored.value();
        heat.latent = latent.value();
        heat.initial = heat.stored + heat.latent;
        return heat;
      }

      cases::Snapshot snapshot(long step, double time) override
      {
        const std::span<const double> excess = flows.temperature_excess();
        const std::span<const double> liquid = flows.liquid_fraction();
        for(std::size_t a = 0; a < n; ++a)
        {
          temperature[a] = scene.material.melting_temperature + excess[a];
          solid_fraction[a] = 1 - liquid[a];
        }
        cases::Snapshot result
            = particle_snapshot(dis, step, time, temperature, solid_fraction);
        result.heat = heat_content();
        result.heat.initial = initial_heat.initial;
        result.heat.boundary = boundary_heat.value();
        result.heat.sources = flows.source_heat(time) / dis.cross_section;
        if(substance.n_solutes() == 0)
          return result;
        result.mass = {mass(), initial_mass};
        for(std::size_t s = 0; s < substance.n_solutes(); ++s)
        {
          result.concentration[substance.numbers[s]] = concentration(s);
          result.solute[substance.numbers[s]] = {mass_of(s), initial_solute[s]};
        }
        return result;
      }

      long unknowns() const
      {
        return static_cast<long>(fields * (n - dis.dirichlet.size()));
      }

      const cases::Scene &scene;
      MixtureParameters parameters;
      Discretisation dis;
      std::size_t n; ///< particles
      AlloySubstance substance;
      MixtureState initial;
      MixtureFlow flows;
      std::size_t size; ///< of an array with its padding
      cases::TemperatureBounds bounds;
      double particle_mass;
      StepPlan plan;

      std::size_t fields; ///< that steps change: enthalpy, then concentrations
      std::vector<double> state_of_all; ///< field after field
      std::optional<ExplicitScheme> scheme;
      std::optional<ImplicitScheme> implicit_scheme;
      std::optional<ImplicitMixture> implicit_mixture;
      long steps = 0; ///< made so far
      std::array<std::span<const double>, cases::most_solutes> composition;
      std::vector<double> temperature, solid_fraction; ///< for snapshots
      Extremes extremes{};                             ///< of the temperature
      cases::HeatBudget initial_heat;
      double initial_mass = 0;
      std::array<double, cases::most_solutes> initial_solute{};
      cases::CompensatedSum boundary_heat;
      long repeated_steps = 0;
    };
  } // namespace

  std::unique_ptr<cases::Run> make_mixture_run(const cases::Scene &scene,
                                               const cases::EffectSet &effects,
                                               const cases::Resolution &resolution)
  {
    return std::make_unique<MixtureRun>(scene, effects, resolution);
  }
} // namespace meltfront::particles
