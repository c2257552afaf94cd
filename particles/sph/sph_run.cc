#include <cases/scene.h>
#include <cases/stopwatch.h>
#include <particles/sph/careful_sum.h>
#include <particles/sph/heat_flow.h>
#include <particles/sph/initial_state.h>
#include <particles/sph/sph_run.h>
#include <particles/sph/time_stepping.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    /** One run: the state and its advance in time. */
    class SphRun
    {
    public:
      SphRun(const SphPolicy &policy, const cases::Scene &scene,
             const cases::EffectSet &effects, const cases::Resolution &resolution)
        : name(policy.name)
        , scene(scene)
        , parameters(resolve_parameters(policy, scene, resolution))
        , dis(scene, parameters)
        , n(dis.particles.size())
        , heat_flow(dis, effects, parameters)
        , bounds(cases::temperature_bounds(scene))
        , particle_mass(dis.particle_volume * scene.material.solid.density)
        , plan(plan_steps(parameters, scene, heat_flow.monotone_step(particle_mass),
                          dis.kernel.smoothing_length()))
        , super_step(plan.stages)
        , temperature(n)
        , solid_fraction(n)
      {
        const std::size_t size = heat_flow.padded_size();
        enthalpy = initial_enthalpy(dis);
        enthalpy.resize(size, 0.);
        flow.resize(size);
        if(plan.stages > 1)
          for(auto *array : {&start, &before, &start_flow})
            array->resize(size);
        heat_flow.prepare_step(scene.start_time, time_of(1));
        heat_flow.hold_walls(0, enthalpy);
        heat_flow.follow(enthalpy);
        initial_heat = heat_content();
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

      void advance(long step, double begin, double end)
      {
        heat_flow.prepare_step(begin, end);
        const bool super = plan.stages > 1 && step > plan.resolved_steps;
        double wall_heat = super ? take_super_step(end - begin)
                                 : take_euler_steps(end - begin, plan.euler_substeps);
        finish_step();
        if(super && breaks_bounds())
        {
          // Only convex combinations keep the maximum principle for certain: repeat the
          // step with these.
          std::swap(enthalpy, start);
          heat_flow.follow(enthalpy);
          wall_heat = take_euler_steps(end - begin, plan.euler_substeps);
          finish_step();
          ++repeated_steps;
        }
        boundary_heat.add(wall_heat / dis.cross_section);
        boundary_heat.add(held_heat);
      }

      void finish_step()
      {
        held_heat = heat_flow.hold_walls(1, enthalpy);
        heat_flow.follow(enthalpy);
        extremes = heat_flow.temperatures(enthalpy);
      }

      /** @return heat through walls. */
      double take_euler_steps(double duration, int steps)
      {
        const double step = duration / steps * heat_flow.scale();
        double wall_heat = 0;
        for(int i = 0; i < steps; ++i)
        {
          if(i > 0)
            heat_flow.follow(enthalpy);
          wall_heat += step * heat_flow.evaluate(enthalpy, double(i) / steps, flow);
          add_flow(enthalpy, step / particle_mass, flow);
        }
        return wall_heat;
      }

      /** One step of RKL2. @return heat through walls, by the same recursion. */
      double take_super_step(double duration)
      {
        const double step = duration * heat_flow.scale();
        const double factor = step / particle_mass;
        start = enthalpy;
        before = enthalpy;
        const double start_rate = heat_flow.evaluate(enthalpy, 0, start_flow);
        double wall_before = 0;
        double wall = super_step.first_rate * step * start_rate;
        add_flow(enthalpy, super_step.first_rate * factor, start_flow);
        for(const SuperStage &stage : super_step.stages)
        {
          heat_flow.follow(enthalpy);
          const double rate = heat_flow.evaluate(enthalpy, stage.fraction, flow);
          combine(stage, factor);
          std::swap(before, enthalpy);
          const double wall_next
              = stage.previous * wall + stage.before * wall_before
                + step * (stage.rate * rate + stage.start_rate * start_rate);
          wall_before = wall;
          wall = wall_next;
        }
        return wall;
      }

      void add_flow(std::vector<double> &array, double factor,
                    const std::vector<double> &added) const
      {
        const int threads = heat_flow.threads();
        double *h = array.data();
        const double *f = added.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)
        for(std::size_t a = 0; a < n; ++a)
          h[a] += factor * f[a];
      }

      /** Y_j, into the array of Y_(j-2). */
      void combine(const SuperStage &stage, double factor)
      {
        const int threads = heat_flow.threads();
        const double *previous = enthalpy.data(), *first = start.data();
        const double *f = flow.data(), *first_flow = start_flow.data();
        double *next = before.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)
        for(std::size_t a = 0; a < n; ++a)
          next[a] = stage.previous * previous[a] + stage.before * next[a]
                    + stage.start * first[a]
                    + factor * (stage.rate * f[a] + stage.start_rate * first_flow[a]);
      }

      static constexpr double bound_tolerance = 1e-9;

      bool breaks_bounds() const
      {
        const double span = bounds.upper - bounds.lower;
        const double slack = 0.5 * bound_tolerance * (std::isfinite(span) ? span : 0);
        return !extremes.finite || extremes.lowest < bounds.lower - slack
               || extremes.highest > bounds.upper + slack;
      }

      void check(long step, double time) const
      {
        constexpr double broken = std::numeric_limits<double>::quiet_NaN();
        cases::check_temperature(bounds, extremes.finite ? extremes.lowest : broken,
                                 extremes.finite ? extremes.highest : broken, name, step,
                                 time, bound_tolerance);
      }

      cases::HeatBudget heat_content() const
      {
        const cases::Material &m = scene.material;
        CarefulSum stored, latent;
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

      cases::Snapshot snapshot(long step, double time)
      {
        const cases::Material &m = scene.material;
        for(std::size_t a = 0; a < n; ++a)
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
        result.heat.sources = heat_flow.source_heat(time) / dis.cross_section;
        return result;
      }

      long unknowns() const
      {
        return static_cast<long>(n - dis.held.size());
      }

      cases::RunDescription describe() const
      {
        cases::RunDescription description;
        description.dimension = dis.dimension;
        description.spacing = dis.spacing;
        description.smoothing_length = dis.kernel.smoothing_length();
        description.time_step = plan.step;
        description.unknowns = unknowns();
        const auto add
            = [&](const char *what, const std::string &value, const char *unit) {
                description.parameters.push_back({what, value, unit});
              };
        add("kernel", kernel_names()[static_cast<std::size_t>(parameters.kernel)], "");
        add("smoothing length / spacing", fmt::format("{:.6g}", parameters.smoothing),
            "1");
        add("layout",
            dis.layout == LatticeLayout::on_edge ? "particles on the edge"
                                                 : "cell-centred",
            "");
        if(dis.displaced)
          add("jitter", fmt::format("{:.6g}", parameters.jitter), "spacings");
        add("particles", fmt::format("{}", n), "1");
        for(const cases::Parameter &parameter : heat_flow.describe())
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
        cases::Cost result;
        result.setup_wall = setup.wall;
        result.setup_cpu = setup.cpu;
        result.stepping_wall = stepping.wall;
        result.stepping_cpu = stepping.cpu;
        result.steps = plan.steps;
        result.unknowns = unknowns();
        result.work = heat_flow.work();
        result.capped_steps = repeated_steps;
        result.effects = heat_flow.effect_costs();
        return result;
      }

      std::string name;
      const cases::Scene &scene;
      SphParameters parameters;
      Discretisation dis;
      std::size_t n; ///< particles
      HeatFlow heat_flow;
      cases::TemperatureBounds bounds;
      double particle_mass;
      StepPlan plan;
      SuperStep super_step;

      std::vector<double> enthalpy;                    ///< per mass, the state (J/kg)
      std::vector<double> flow;                        ///< heat flow into each particle
      std::vector<double> start, before, start_flow;   ///< Y_0, Y_(j-2), F(Y_0) of RKL2
      std::vector<double> temperature, solid_fraction; ///< for snapshots
      Extremes extremes{};                             ///< of the temperature
      cases::HeatBudget initial_heat;
      CarefulSum boundary_heat;
      double held_heat = 0; ///< of the step's new wall temperatures
      long repeated_steps = 0;
    };
  } // namespace

  cases::Cost run_sph(const SphPolicy &policy, const cases::Scene &scene,
                      const cases::EffectSet &effects,
                      const cases::Resolution &resolution, cases::Observer &observer)
  {
    const cases::Stopwatch setup;
    SphRun run(policy, scene, effects, resolution);
    return run.run(observer, setup);
  }
} // namespace meltfront::particles
