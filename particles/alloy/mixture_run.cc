#include <cases/error.h>
#include <cases/scene.h>
#include <cases/snapshot.h>
#include <cases/stopwatch.h>
#include <particles/alloy/mixture_flow.h>
#include <particles/alloy/mixture_run.h>
#include <particles/alloy/mixture_state.h>
#include <particles/sph/careful_sum.h>
#include <particles/sph/explicit_scheme.h>
#include <particles/sph/run_report.h>

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

    /** One run: the state and its advance in time. */
    class MixtureRun
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
        , plan(plan_steps(parameters.sph, scene, flows.monotone_step(particle_mass),
                          dis.kernel.smoothing_length()))
        , temperature(n)
        , solid_fraction(n)
      {
        const std::size_t solutes = substance.n_solutes();
        // Without diffusion concentrations never change: they take no part in the steps.
        fields = 1 + (flows.diffuses() ? solutes : 0);
        state.assign(fields * size, 0.);
        std::copy(initial.enthalpy.begin(), initial.enthalpy.end(), state.begin());
        for(std::size_t s = 0; flows.diffuses() && s < solutes; ++s)
          std::copy(initial.concentration[s].begin(), initial.concentration[s].end(),
                    state.begin() + (s + 1) * size);
        scheme.emplace(plan, state.size(), state.size(), flows.threads());
        flows.prepare_step(scene.start_time, time_of(1));
        flows.hold_walls(0, view());
        extremes = flows.follow(view());
        initial_heat = heat_content();
        for(std::size_t s = 0; s < solutes; ++s)
          initial_solute[s] = mass_of(s);
        initial_mass = mass();
      }

      cases::Cost run(cases::Observer &observer, const cases::Stopwatch &watch)
      {
        const cases::Stopwatch::Seconds setup = watch.elapsed();
        observer.begin(describe());
        observer.observe(snapshot(0, scene.start_time));
        cases::Stopwatch stepping;
        for(long step = 1; step <= plan.steps; ++step)
        {
          const double end = time_of(step);
          advance(step, time_of(step - 1), end);
          check(step, end);
          if(observer.wants(step, end) || step == plan.steps)
            stepping.without([&] { observer.observe(snapshot(step, end)); });
        }
        return cost(setup, stepping.elapsed());
      }

    private:
      /** Time after a step; the end exactly. */
      double time_of(long step) const
      {
        return step == plan.steps ? scene.end_time : scene.start_time + step * plan.step;
      }

      std::span<const double> concentration(std::size_t solute) const
      {
        return flows.diffuses()
                   ? std::span<const double>(state).subspan((solute + 1) * size, n)
                   : std::span<const double>(initial.concentration[solute]);
      }

      MixtureView view()
      {
        const std::size_t solutes = substance.n_solutes();
        for(std::size_t s = 0; s < solutes; ++s)
          composition[s] = concentration(s);
        return {std::span(state).first(n), std::span(composition).first(solutes)};
      }

      void advance(long step, double begin, double end)
      {
        flows.prepare_step(begin, end);
        const bool super = plan.stages > 1 && step > plan.resolved_steps;
        double wall_heat
            = super ? take_super_step(end - begin) : take_euler_steps(end - begin);
        finish_step();
        if(super && breaks_bounds())
        {
          // Only convex combinations keep the maximum principle for certain: repeat the
          // step with these.
          scheme->restore(state);
          flows.follow(view());
          wall_heat = take_euler_steps(end - begin);
          finish_step();
          ++repeated_steps;
        }
        boundary_heat.add(wall_heat / dis.cross_section);
        boundary_heat.add(held_heat);
      }

      void finish_step()
      {
        held_heat = flows.hold_walls(1, view());
        extremes = flows.follow(view());
      }

      /** Flows of heat and solutes. @return heat flow through walls. */
      double evaluate(double fraction, std::vector<double> &result)
      {
        const std::span<double> all(result);
        const double walls = flows.heat(fraction, all.first(size));
        for(std::size_t field = 1; field < fields; ++field)
          flows.solute(field - 1, all.subspan(field * size, size));
        return walls;
      }

      /** @return heat through walls. */
      double take_euler_steps(double duration)
      {
        return scheme->take_euler_steps(
            state, duration, plan.euler_substeps, 1., particle_mass,
            [this] { flows.follow(view()); },
            [this](double fraction, std::vector<double> &flow)
            { return evaluate(fraction, flow); });
      }

      /** @return heat through walls. */
      double take_super_step(double duration)
      {
        return scheme->take_super_step(
            state, duration, 1., particle_mass, [this] { flows.follow(view()); },
            [this](double fraction, std::vector<double> &flow)
            { return evaluate(fraction, flow); });
      }

      static constexpr double bound_tolerance = 1e-9;

      bool breaks_bounds() const
      {
        const double span = bounds.upper - bounds.lower;
        const double slack = 0.5 * bound_tolerance * (std::isfinite(span) ? span : 0);
        return !extremes.finite || extremes.lowest < bounds.lower - slack
               || extremes.highest > bounds.upper + slack || least_concentration() < 0;
      }

      double least_concentration() const
      {
        double least = 0;
        for(std::size_t field = 1; field < fields; ++field)
          for(std::size_t a = 0; a < n; ++a)
            least = std::min(least, state[field * size + a]);
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
        CarefulSum sum;
        for(std::size_t a = 0; a < n; ++a)
          sum.add(dis.weights[a] * substance.density);
        return sum.value();
      }

      double mass_of(std::size_t solute) const
      {
        const std::span<const double> c = concentration(solute);
        CarefulSum sum;
        for(std::size_t a = 0; a < n; ++a)
          sum.add(dis.weights[a] * substance.density * c[a]);
        return sum.value();
      }

      cases::HeatBudget heat_content() const
      {
        const double latent_heat = scene.material.latent_heat;
        const std::span<const double> liquid = flows.liquid_fraction();
        CarefulSum stored, latent;
        for(std::size_t a = 0; a < n; ++a)
        {
          const double weight = dis.weights[a] * substance.density;
          latent.add(weight * latent_heat * liquid[a]);
          stored.add(weight * (state[a] - latent_heat * liquid[a]));
        }
        cases::HeatBudget heat;
        heat.stored = stored.value();
        heat.latent = latent.value();
        heat.initial = heat.stored + heat.latent;
        return heat;
      }

      cases::Snapshot snapshot(long step, double time)
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
        return static_cast<long>(fields * (n - dis.held.size()));
      }

      cases::RunDescription describe() const
      {
        cases::RunDescription description
            = describe_particles(dis, parameters.sph, plan.step, unknowns());
        const auto add
            = [&](const char *what, const std::string &value, const char *unit) {
                description.parameters.push_back({what, value, unit});
              };
        add("particles", fmt::format("{}", n), "1");
        for(const cases::Parameter &parameter : flows.describe())
          description.parameters.push_back(parameter);
        add("time scheme",
            plan.stages > 1 ? fmt::format("RKL2, {} stages", plan.stages)
                            : "explicit Euler",
            "");
        add("largest explicit step that keeps the maximum principle",
            fmt::format("{:.6g}", plan.monotone), "s");
        return description;
      }

      cases::Cost cost(const cases::Stopwatch::Seconds &setup,
                       const cases::Stopwatch::Seconds &stepping) const
      {
        cases::Cost result = timed_cost(setup, stepping);
        result.steps = plan.steps;
        result.unknowns = unknowns();
        result.work = flows.work();
        result.capped_steps = repeated_steps;
        const std::size_t arrays = flows.diffuses() ? (plan.stages > 1 ? 6 : 3) : 1;
        result.effects = flows.effect_costs(arrays * size * sizeof(double));
        return result;
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

      std::size_t fields;        ///< that steps change: enthalpy, then concentrations
      std::vector<double> state; ///< field after field
      std::optional<ExplicitScheme> scheme;
      std::array<std::span<const double>, cases::most_solutes> composition;
      std::vector<double> temperature, solid_fraction; ///< for snapshots
      Extremes extremes{};                             ///< of the temperature
      cases::HeatBudget initial_heat;
      double initial_mass = 0;
      std::array<double, cases::most_solutes> initial_solute{};
      CarefulSum boundary_heat;
      double held_heat = 0; ///< of the step's new wall temperatures
      long repeated_steps = 0;
    };
  } // namespace

  cases::Cost run_mixture(const cases::Scene &scene, const cases::EffectSet &effects,
                          const cases::Resolution &resolution, cases::Observer &observer)
  {
    const cases::Stopwatch setup;
    MixtureRun run(scene, effects, resolution);
    return run.run(observer, setup);
  }
} // namespace meltfront::particles
