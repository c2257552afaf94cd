#include <cases/scene.h>
#include <particles/sph/heat_sources.h>
#include <particles/sph/initial_state.h>
#include <particles/sph/phase_conductivity.h>
#include <particles/sph/sph_run.h>
#include <particles/sph/stopwatch.h>
#include <particles/sph/time_stepping.h>
#include <particles/sph/wall_flux.h>
#include <particles/sph/wall_temperature.h>

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace meltfront::particles
{
  using cases::Effect;

  namespace
  {
    /** A sum that keeps the digits its additions would lose (Neumaier 1974). */
    class CarefulSum
    {
    public:
      void
      add(double value)
      {
        const double next = sum + value;
        lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value
                                                 : (value - next) + sum;
        sum = next;
      }

      double
      value() const
      {
        return sum + lost;
      }

    private:
      double sum = 0;
      double lost = 0;
    };

    /** One run: the state, and the passes that the scene's effects call for. */
    class SphRun
    {
    public:
      SphRun(const SphPolicy &policy, const cases::Scene &scene,
             const cases::EffectSet &effects, const cases::Resolution &resolution)
          : name(policy.name), scene(scene), effects(effects),
            parameters(resolve_parameters(policy, scene, resolution)),
            dis(scene, parameters), conduction(dis, parameters.moment_correction),
            variable(scene.material, effects), bounds(cases::temperature_bounds(scene)),
            particle_mass(dis.particle_volume * scene.material.solid.density),
            plan(plan_steps(
                parameters, scene,
                monotone_step(scene.material, particle_mass, conduction.largest_row_sum),
                dis.kernel.smoothing_length())),
            super_step(plan.stages)
      {
        compose();
        allocate();
      }

      cases::RunDescription describe() const;

      cases::Cost
      run(cases::Observer &observer, Stopwatch &setup)
      {
        setup.pause();
        observer.begin(describe());
        observer.observe(snapshot(0, scene.start_time));
        Stopwatch stepping;
        for(long step = 1; step <= plan.steps; ++step)
        {
          const double begin = time_of(step - 1), end = time_of(step);
          advance(begin, end);
          check(step, end);
          if(observer.wants(step, end) || step == plan.steps)
          {
            stepping.pause();
            observer.observe(snapshot(step, end));
            stepping.resume();
          }
        }
        stepping.pause();
        return cost(setup, stepping);
      }

    private:
      /** Build the passes of the effects at hand, and no others. */
      void
      compose()
      {
        if(effects.contains(Effect::phase_conductivity))
          phase_conductivity.emplace(scene.material, parameters.melting_conductivity,
                                     conduction.rows);
        if(effects.contains(Effect::heat_sources))
          heat_sources.emplace(dis);
        if(effects.contains(Effect::wall_temperature))
          wall_temperature.emplace(dis, conduction, variable);
        if(effects.contains(Effect::wall_flux))
          wall_flux.emplace(dis, conduction);
      }

      void
      allocate()
      {
        const std::size_t padded = conduction.rows.padded_rows();
        enthalpy = initial_enthalpy(dis);
        enthalpy.resize(padded, 0.);
        flow.resize(padded);
        if(variable.mapped())
          mapped.resize(padded);
        if(plan.stages > 1)
          for(auto *array : {&start, &before, &start_flow})
            array->resize(padded);
        if(wall_temperature)
        {
          wall_temperature->prepare_step(scene.start_time, time_of(1));
          wall_temperature->hold(0, enthalpy);
        }
        extremes = update_variable();
        temperature.resize(dis.particles.size());
        solid_fraction.resize(dis.particles.size());
        initial_heat = heat_content();
      }

      /** Time after a step; the end exactly. */
      double
      time_of(long step) const
      {
        return step == plan.steps ? scene.end_time : scene.start_time + step * plan.step;
      }

      std::span<double>
      particles_of(std::vector<double> &array) const
      {
        return std::span(array).first(dis.particles.size());
      }

      /** Bring the conduction variable up to date with the enthalpy. */
      Extremes
      update_variable()
      {
        return variable.mapped() ? variable.map(particles_of(enthalpy),
                                                particles_of(mapped), parameters.threads)
                                 : Extremes{};
      }

      std::span<const double>
      conducted() const
      {
        return variable.mapped() ? mapped : enthalpy;
      }

      /**
       * Heat flow into each particle at a fraction of the step, in units of the
       * variable's flow scale.
       * @return heat flow through walls, likewise.
       */
      double
      evaluate(double fraction, std::vector<double> &into)
      {
        const auto w = conducted();
        conduction.rows.apply(w, into, parameters.threads);
        ++evaluations;
        if(phase_conductivity)
          phase_conductivity->apply(conduction.rows, w, into);
        if(heat_sources)
          heat_sources->add(into, variable.flow_scale());
        double through_walls = 0;
        if(wall_flux)
          through_walls += wall_flux->add(fraction, into, variable.flow_scale());
        if(wall_temperature)
        {
          if(phase_conductivity)
            through_walls += phase_conductivity->with_pair(
                [&](const auto &pair)
                { return wall_temperature->add(pair, fraction, w, into); });
          else
            through_walls += wall_temperature->add(
                [](double own, double wall) { return wall - own; }, fraction, w, into);
        }
        return through_walls;
      }

      void
      advance(double begin, double end)
      {
        if(heat_sources)
          heat_sources->prepare_step(begin, end);
        if(wall_temperature)
          wall_temperature->prepare_step(begin, end);
        if(wall_flux)
          wall_flux->prepare_step(begin, end);
        const double duration = end - begin;
        double wall_heat
            = plan.stages > 1 ? take_super_step(duration) : take_euler_steps(duration, 1);
        finish_step();
        if(plan.stages > 1 && breaks_bounds())
        {
          // Only convex combinations keep the maximum principle for certain: repeat the
          // step with these.
          std::swap(enthalpy, start);
          update_variable();
          wall_heat = take_euler_steps(duration, plan.euler_substeps);
          finish_step();
          ++repeated_steps;
        }
        boundary_heat.add(wall_heat / dis.cross_section);
        boundary_heat.add(held_heat);
      }

      void
      finish_step()
      {
        held_heat = wall_temperature ? wall_temperature->hold(1, enthalpy) : 0;
        extremes = update_variable();
        if(!variable.mapped())
          extremes = find_extremes(particles_of(enthalpy), parameters.threads);
      }

      /** @return heat through walls. */
      double
      take_euler_steps(double duration, int steps)
      {
        const double step = duration / steps;
        double wall_heat = 0;
        for(int i = 0; i < steps; ++i)
        {
          if(i > 0)
            update_variable();
          wall_heat += step * variable.flow_scale() * evaluate(double(i) / steps, flow);
          const double factor = step * variable.flow_scale() / particle_mass;
          double *h = enthalpy.data();
          const double *f = flow.data();
          const std::size_t n = dis.particles.size();
#pragma omp parallel for simd schedule(static)                                           \
    num_threads(parameters.threads) if(parameters.threads > 1)
          for(std::size_t a = 0; a < n; ++a)
            h[a] += factor * f[a];
        }
        return wall_heat;
      }

      /** One step of RKL2. @return heat through walls, by the same recursion. */
      double
      take_super_step(double duration)
      {
        const double scale = duration * variable.flow_scale();
        const double factor = scale / particle_mass;
        const std::size_t n = dis.particles.size();
        start = enthalpy;
        before = enthalpy;
        const double start_rate = evaluate(0, start_flow);
        double wall_before = 0;
        double wall = super_step.first_rate * scale * start_rate;
        for(std::size_t a = 0; a < n; ++a)
          enthalpy[a] = start[a] + super_step.first_rate * factor * start_flow[a];
        for(const SuperStage &stage : super_step.stages)
        {
          update_variable();
          const double rate = evaluate(stage.fraction, flow);
          combine(stage, factor, n);
          std::swap(before, enthalpy);
          const double wall_next
              = stage.previous * wall + stage.before * wall_before
                + scale * (stage.rate * rate + stage.start_rate * start_rate);
          wall_before = wall;
          wall = wall_next;
        }
        return wall;
      }

      /** Y_j, into the array of Y_(j-2). */
      void
      combine(const SuperStage &stage, double factor, std::size_t n)
      {
        const double *previous = enthalpy.data(), *first = start.data();
        const double *f = flow.data(), *first_flow = start_flow.data();
        double *next = before.data();
#pragma omp parallel for simd schedule(static)                                           \
    num_threads(parameters.threads) if(parameters.threads > 1)
        for(std::size_t a = 0; a < n; ++a)
          next[a] = stage.previous * previous[a] + stage.before * next[a]
                    + stage.start * first[a]
                    + factor * (stage.rate * f[a] + stage.start_rate * first_flow[a]);
      }

      static constexpr double bound_tolerance = 1e-9;

      bool
      breaks_bounds() const
      {
        const double span = bounds.upper - bounds.lower;
        const double slack = 0.5 * bound_tolerance * (std::isfinite(span) ? span : 0);
        return !extremes.finite
               || variable.temperature(extremes.lowest) < bounds.lower - slack
               || variable.temperature(extremes.highest) > bounds.upper + slack;
      }

      void
      check(long step, double time) const
      {
        const double broken = std::numeric_limits<double>::quiet_NaN();
        cases::check_temperature(
            bounds, extremes.finite ? variable.temperature(extremes.lowest) : broken,
            extremes.finite ? variable.temperature(extremes.highest) : broken, name, step,
            time, bound_tolerance);
      }

      cases::HeatBudget
      heat_content() const
      {
        const cases::Material &m = scene.material;
        CarefulSum stored, latent;
        for(std::size_t a = 0; a < dis.particles.size(); ++a)
        {
          const double mass = dis.weights[a] * m.solid.density;
          const double molten = m.latent_heat > 0 ? 1 - m.solid_fraction(enthalpy[a]) : 0;
          latent.add(mass * m.latent_heat * molten);
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

      cases::Snapshot
      snapshot(long step, double time)
      {
        const cases::Material &m = scene.material;
        for(std::size_t a = 0; a < dis.particles.size(); ++a)
        {
          temperature[a] = m.temperature(enthalpy[a]);
          solid_fraction[a] = m.solid_fraction(enthalpy[a]);
        }
        cases::Snapshot result;
        result.step = step;
        result.time = time;
        result.dimension = dis.dimension;
        for(int d = 0; d < dis.dimension; ++d)
          result.positions[d] = dis.particles.position[d];
        result.weights = dis.weights;
        result.temperature = temperature;
        result.solid_fraction = solid_fraction;
        result.heat = heat_content();
        result.heat.initial = initial_heat.initial;
        result.heat.boundary = boundary_heat.value();
        if(heat_sources)
          result.heat.sources = heat_sources->heat(time) / dis.cross_section;
        return result;
      }

      cases::Cost cost(const Stopwatch &setup, const Stopwatch &stepping) const;

      std::string name;
      const cases::Scene &scene;
      const cases::EffectSet &effects;
      SphParameters parameters;
      Discretisation dis;
      ConductionRows conduction;
      ConductionVariable variable;
      cases::TemperatureBounds bounds;
      double particle_mass;
      StepPlan plan;
      SuperStep super_step;

      std::optional<PhaseConductivity> phase_conductivity;
      std::optional<HeatSources> heat_sources;
      std::optional<WallTemperature> wall_temperature;
      std::optional<WallFlux> wall_flux;

      std::vector<double> enthalpy; ///< per mass, the state (J/kg)
      std::vector<double> mapped;   ///< conduction variable, where it is not the enthalpy
      std::vector<double> flow;     ///< heat flow into each particle
      std::vector<double> start, before, start_flow;   ///< Y_0, Y_(j-2), F(Y_0) of RKL2
      Extremes extremes{};                             ///< of the conduction variable
      std::vector<double> temperature, solid_fraction; ///< for snapshots
      cases::HeatBudget initial_heat;
      CarefulSum boundary_heat;
      double held_heat = 0; ///< of the step's new wall temperatures
      long evaluations = 0;
      long repeated_steps = 0;
    };

    cases::RunDescription
    SphRun::describe() const
    {
      cases::RunDescription description;
      description.dimension = dis.dimension;
      description.spacing = dis.spacing;
      description.smoothing_length = dis.kernel.smoothing_length();
      description.time_step = plan.step;
      description.unknowns = static_cast<long>(dis.particles.size() - dis.held.size());
      const auto add = [&](const char *what, const std::string &value, const char *unit) {
        description.parameters.push_back({what, value, unit});
      };
      add("kernel", kernel_names()[static_cast<std::size_t>(parameters.kernel)], "");
      add("smoothing length / spacing", fmt::format("{:.6g}", parameters.smoothing), "1");
      add("layout",
          dis.layout == LatticeLayout::on_edge ? "particles on the edge" : "cell-centred",
          "");
      add("particles", fmt::format("{}", dis.particles.size()), "1");
      add("interactions per particle",
          fmt::format("{:.4g}",
                      double(conduction.rows.interactions()) / dis.particles.size()),
          "1");
      add("second moment divided out", fmt::format("{:.10g}", conduction.second_moment),
          "1");
      if(phase_conductivity)
        add("conductivity at the melting temperature",
            parameters.melting_conductivity == MeltingConductivity::partner
                ? "the partner's"
                : "the liquid's until frozen",
            "");
      add("time scheme",
          plan.stages > 1 ? fmt::format("RKL2, {} stages", plan.stages)
                          : "explicit Euler",
          "");
      add("largest explicit step that keeps the maximum principle",
          fmt::format("{:.6g}", plan.monotone), "s");
      if(dis.displaced)
        add("jitter", fmt::format("{:.6g}", parameters.jitter), "spacings");
      return description;
    }

    cases::Cost
    SphRun::cost(const Stopwatch &setup, const Stopwatch &stepping) const
    {
      cases::Cost result;
      result.setup_wall = setup.wall();
      result.setup_cpu = setup.cpu();
      result.stepping_wall = stepping.wall();
      result.stepping_cpu = stepping.cpu();
      result.steps = plan.steps;
      result.unknowns = static_cast<long>(dis.particles.size() - dis.held.size());
      result.capped_steps = repeated_steps;
      std::size_t per_evaluation = conduction.rows.interactions();
      if(wall_temperature)
        per_evaluation += wall_temperature->size();
      if(wall_flux)
        per_evaluation += wall_flux->size();
      result.work = evaluations * static_cast<long>(per_evaluation);
      result.effects = variable.costs(effects, mapped.size() * sizeof(double));
      if(phase_conductivity)
      {
        result.work += phase_conductivity->work();
        result.effects.push_back(phase_conductivity->cost());
      }
      if(heat_sources)
        result.effects.push_back(heat_sources->cost());
      if(wall_temperature)
        result.effects.push_back(wall_temperature->cost());
      if(wall_flux)
        result.effects.push_back(wall_flux->cost());
      return result;
    }
  } // namespace

  cases::Cost
  run_sph(const SphPolicy &policy, const cases::Scene &scene,
          const cases::EffectSet &effects, const cases::Resolution &resolution,
          cases::Observer &observer)
  {
    Stopwatch setup;
    SphRun run(policy, scene, effects, resolution);
    return run.run(observer, setup);
  }
} // namespace meltfront::particles
