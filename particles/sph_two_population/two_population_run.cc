#include <cases/compensated_sum.h>
#include <cases/error.h>
#include <cases/scene.h>
#include <cases/step_ends.h>
#include <cases/stopwatch.h>
#include <cases/temperature_slack.h>
#include <cases/time_integral.h>
#include <particles/sph/run_report.h>
#include <particles/sph_two_population/two_population_flow.h>
#include <particles/sph_two_population/two_population_run.h>
#include <particles/sph_two_population/two_population_stepper.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace meltfront::particles
{
  namespace
  {
    /** Fewest steps of a run, so that its course can be sampled at 100 times. */
    constexpr long fewest_steps = 200;

    constexpr int samples_in_time = 257;

    /**
     * New ice that is spread over the kernel cannot be melted again where it came from:
     * a scene in which a wall may melt ice is refused.
     */
    void require_freezing(const TwoPopulationParameters &parameters,
                          const cases::Scene &scene, const AlloySubstance &substance,
                          const MixtureState &initial)
    {
      if(std::isfinite(substance.eutectic_excess)
         && (parameters.new_ice == NewIce::kernel || parameters.constant_latent_heat))
        throw cases::Refusal(fmt::format(
            "{} freezes at a eutectic temperature only with new_ice = site and "
            "latent_heat = energy_function",
            parameters.name));
      if(parameters.new_ice == NewIce::site)
        return;
      const auto refuse = [&](const std::string &why)
      {
        throw cases::Refusal(
            fmt::format("{} spreads new ice over the kernel and cannot melt it: {}",
                        parameters.name, why));
      };
      for(std::size_t a = 0; a < initial.enthalpy.size(); ++a)
      {
        const auto content = [&](std::size_t s)
        { return s < initial.concentration.size() ? initial.concentration[s][a] : 0.; };
        if(substance.diagram.equilibrium(initial.enthalpy[a], content(0), content(1))
               .liquid_fraction
           < 1)
          refuse("the scene holds ice at the start");
      }
      for(const cases::Side side : scene.sides())
      {
        const cases::Boundary &wall = scene.boundary(side);
        if(wall.kind != cases::BoundaryKind::fixed_temperature || wall.value.constant)
          continue;
        cases::Position place = scene.domain.lower;
        if(static_cast<int>(side) % 2 == 1)
          place = scene.domain.upper;
        const auto at = [&](int i)
        {
          return wall.value(place, scene.start_time
                                       + (scene.end_time - scene.start_time) * i
                                             / (samples_in_time - 1));
        };
        double warmest = at(0);
        for(int i = 1; i < samples_in_time; ++i)
        {
          if(at(i) > warmest && at(i - 1) < scene.material.melting_temperature)
            refuse(fmt::format("the wall {} gets warmer", cases::to_string(side)));
          warmest = std::min(warmest, at(i));
        }
      }
    }

    class TwoPopulationRun : public cases::Run
    {
    public:
      TwoPopulationRun(const TwoPopulationPolicy &policy, const cases::Scene &scene,
                       const cases::EffectSet &effects,
                       const cases::Resolution &resolution)
        : scene(scene)
        , parameters(resolve_two_population_parameters(policy, scene, resolution))
        , dis(scene, parameters.sph)
        , n(dis.particles.size())
        , substance(scene, parameters.name)
        , initial(dis, substance)
        , sites(dis, substance, parameters, initial, (n + 7) / 8 * 8)
        , flows(dis, substance, effects, parameters, sites)
        , bounds(initial.bounds(scene, substance))
        , plan(make_plan())
        , stepper(parameters, plan, bounds, flows, sites)
        , temperature(n)
        , solid_fraction(n)
      {
        require_freezing(parameters, scene, substance, initial);
        weights = dis.weights;
        for(const std::uint32_t a : dis.dirichlet)
          weights[a] = 0; // holds a boundary value only
        flows.prepare_step(scene.start_time,
                           cases::end_of_piece(plan.ends, scene.start_time, time_of(1)));
        flows.hold_walls(0);
        sites.update();
        initial_heat = sites.heat_content(dis.cross_section).initial;
        initial_mass = sites.total_mass();
        for(std::size_t s = 0; s < substance.n_solutes(); ++s)
          initial_solute[s] = sites.total_of(s);
      }

      cases::RunDescription describe() const override
      {
        cases::RunDescription description
            = describe_particles(dis, parameters.sph, plan.step, unknowns());
        const std::vector<cases::Parameter> own = {
            {"sites", fmt::format("{}", n), "1"},
            {"interactions per site",
             fmt::format("{:.4g}", double(flows.interactions()) / n), "1"},
            {"second moment divided out", fmt::format("{:.10g}", flows.second_moment()),
             "1"},
            {"exchange between ice and liquid",
             parameters.exchange == PhaseExchange::corrected ? "corrected"
                                                             : "as published",
             ""},
            {"new ice goes to",
             parameters.new_ice == NewIce::site ? "its site" : "the kernel", ""},
            {"latent heat",
             parameters.constant_latent_heat ? "constant"
                                             : "as the heat capacities demand",
             ""},
            {"time scheme", describe_scheme(parameters.sph.time_scheme, plan.stages), ""},
            {"largest explicit step that keeps the maximum principle",
             fmt::format("{:.6g}", plan.limits.monotone), "s"}};
        description.parameters.insert(description.parameters.end(), own.begin(),
                                      own.end());
        return description;
      }

      cases::Cost cost() const override
      {
        cases::Cost result;
        result.steps = plan.steps;
        result.unknowns = unknowns();
        result.work = flows.work();
        result.capped_steps = stepper.repeated_steps();
        result.solver_iterations = stepper.solver_iterations();
        result.effects = flows.effect_costs(n * sizeof(double));
        return result;
      }

    private:
      void take_steps() override
      {
        reached(0, scene.start_time);
        for(long step = 1; step <= plan.steps; ++step)
        {
          const double end = time_of(step);
          for(double begin = time_of(step - 1); begin < end;)
          {
            const double next = cases::end_of_piece(plan.ends, begin, end);
            boundary_heat.add(stepper.advance(step, begin, next) / dis.cross_section);
            begin = next;
          }
          check(step, end);
          reached(step, end);
        }
      }

      StepPlan make_plan() const
      {
        if(!parameters.as_published)
          return plan_steps(
              parameters.sph, scene,
              flows.step_limits(scene, parameters.sph.step_limit, dis.dirichlet),
              dis.kernel.smoothing_length());
        const cases::Material &m = scene.material;
        const double h = dis.kernel.smoothing_length();
        double longest = parameters.sph.step_factor * h * h
                         * std::min(substance.density * m.liquid.specific_heat_capacity
                                        / m.liquid.conductivity,
                                    sites.crystal_density * m.solid.specific_heat_capacity
                                        / m.solid.conductivity);
        if(parameters.sph.step_limit == StepLimit::monotone)
          longest = std::min(longest, flows.monotone_step());
        const double duration = scene.end_time - scene.start_time;
        const long steps = std::max(
            fewest_steps, static_cast<long>(std::ceil(duration / longest * (1 - 1e-12))));
        return {steps,
                duration / steps,
                1,
                {flows.monotone_step()},
                1,
                0,
                cases::step_ends(scene, parameters.sph.n, duration / steps)};
      }

      /** Time after a step; the end exactly. */
      double time_of(long step) const
      {
        return step == plan.steps ? scene.end_time
                                  : cases::snap_to_breakpoint(
                                      plan.ends, scene.start_time + step * plan.step);
      }

      /** The maximum principle, for every particle that has mass; a known liquidus. */
      void check(long step, double time) const
      {
        const double melting = scene.material.melting_temperature;
        const double slack = cases::temperature_slack(bounds, 1e-9);
        const auto check_one = [&](const Population &population, const char *what)
        {
          for(std::size_t a = 0; a < n; ++a)
          {
            const double value = melting + population.excess[a];
            if(value >= bounds.lower - slack && value <= bounds.upper + slack)
              continue;
            const std::string quantity
                = fmt::format("temperature of the {} particle {} at x = {:.6g} m", what,
                              a, dis.particles.position[0][a]);
            throw cases::NumericalError(
                parameters.name, step, time, quantity,
                std::isfinite(value)
                    ? fmt::format("is {:.9g}, beyond the initial and wall values {:.9g} "
                                  "and {:.9g} (maximum principle)",
                                  value, bounds.lower, bounds.upper)
                    : "is not finite");
          }
        };
        check_one(sites.liquid, "liquid");
        check_one(sites.ice, "ice");
        if(const std::optional<std::size_t> a = sites.beyond_liquidus())
          throw cases::NumericalError(
              parameters.name, step, time,
              fmt::format(
                  "mass fraction of solute in the liquid particle {} at x = {:.6g} "
                  "m",
                  *a, dis.particles.position[0][*a]),
              fmt::format(
                  "is {:.6g}, and the liquidus is known up to {:.6g}: extend it or "
                  "state the eutectic temperature",
                  sites.dissolved(*a) / sites.liquid.mass[*a],
                  sites.curved_liquidus()->largest_concentration()));
      }

      cases::Snapshot snapshot(long step, double time) override
      {
        for(std::size_t a = 0; a < n; ++a)
        {
          // What both take on when they even out: it holds the site's sensible heat.
          const double ice = sites.ice.mass[a];
          const double of_liquid
              = sites.liquid.mass[a] * scene.material.liquid.specific_heat_capacity,
              of_ice = ice * scene.material.solid.specific_heat_capacity;
          temperature[a]
              = scene.material.melting_temperature
                + (of_liquid * sites.liquid.excess[a] + of_ice * sites.ice.excess[a])
                      / (of_liquid + of_ice);
          if(sites.is_dirichlet[a])
            solid_fraction[a] = 1;
          else if(parameters.new_ice == NewIce::site)
            solid_fraction[a] = std::min(ice / sites.site_mass, 1.);
          else // ice that the kernel carries elsewhere takes its volume along
          {
            const double mass = sites.liquid.mass[a] + ice;
            weights[a] = dis.weights[a] * mass / sites.site_mass;
            solid_fraction[a] = ice / mass;
          }
        }
        cases::Snapshot result
            = particle_snapshot(dis, step, time, temperature, solid_fraction);
        result.weights = weights;
        result.heat = sites.heat_content(dis.cross_section);
        result.heat.initial = initial_heat;
        result.heat.boundary = boundary_heat.value();
        const double measure = dis.cross_section;
        result.mass = {sites.total_mass() / measure, initial_mass / measure};
        for(std::size_t s = 0; s < substance.n_solutes(); ++s)
        {
          result.concentration[substance.numbers[s]] = sites.concentration[s];
          result.solute[substance.numbers[s]]
              = {sites.total_of(s) / measure, initial_solute[s] / measure};
        }
        return result;
      }

      long unknowns() const
      {
        return static_cast<long>((n - dis.dirichlet.size())
                                 * (4 + substance.n_solutes()));
      }

      const cases::Scene &scene;
      TwoPopulationParameters parameters;
      Discretisation dis;
      std::size_t n; ///< sites
      AlloySubstance substance;
      MixtureState initial;
      Sites sites;
      TwoPopulationFlow flows;
      cases::TemperatureBounds bounds;
      StepPlan plan;
      TwoPopulationStepper stepper;
      std::vector<double> weights, temperature, solid_fraction; ///< for snapshots
      double initial_heat = 0, initial_mass = 0;
      std::array<double, cases::most_solutes> initial_solute{};
      cases::CompensatedSum boundary_heat;
    };
  } // namespace

  std::unique_ptr<cases::Run> make_two_population_run(const TwoPopulationPolicy &policy,
                                                      const cases::Scene &scene,
                                                      const cases::EffectSet &effects,
                                                      const cases::Resolution &resolution)
  {
    return std::make_unique<TwoPopulationRun>(policy, scene, effects, resolution);
  }
} // namespace meltfront::particles
