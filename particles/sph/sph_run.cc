#include <cases/scene.h>
#include <particles/sph/conductivity_contrast.h>
#include <particles/sph/heat_flow.h>
#include <particles/sph/initial_state.h>
#include <particles/sph/ranks/share_among_ranks.h>
#include <particles/sph/run_report.h>
#include <particles/sph/sph_run.h>
#include <particles/sph/time/stepper.h>
#include <particles/sph/time/time_stepping.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace meltfront::particles
{
  namespace
  {
    class SphRun : public cases::SharedRun
    {
    public:
      SphRun(const SphPolicy &policy, const cases::Scene &in_space,
             const cases::EffectSet &effects, const cases::Resolution &resolution,
             int ranks)
        : parameters(resolve_parameters(policy, in_space, resolution))
        , mass_coordinates(in_mass_coordinates(in_space, effects, parameters))
        , liquid_balance(balance_of_liquid(in_space, effects, parameters))
        , scene(mass_coordinates ? mass_coordinates->at_rest
                : liquid_balance ? liquid_balance->at_rest
                                 : in_space)
        , dis(scene, parameters)
        , n(share(ranks, effects))
        , heat_flow(dis, effects, parameters, mass_coordinates.get())
        , plan(make_plan(effects))
        , stepper(make_stepper(parameters, heat_flow, dis, plan, start(), policy.name))
        , temperature(n)
        , solid_fraction(n)
      {
        require_moderate_contrast(dis, parameters.front, stepper->enthalpies(),
                                  policy.name);
        if(liquid_balance)
          heat_flow.let_liquid_flow(*liquid_balance, dis, stepper->enthalpies(),
                                    longest_euler_step(plan));
        for(std::size_t i = 0; dis.own.shared() && i < dis.own.size(); ++i)
          numbers.push_back(dis.own.first_number + i);
        weigh();
        initial_heat = heat_content();
        initial_mass = mass();
      }

      cases::RunDescription describe() const override
      {
        cases::RunDescription description
            = describe_run(dis, parameters, plan, unknowns(), heat_flow.describe());
        if(!why_these_steps.empty())
          description.parameters.push_back({"steps", why_these_steps, ""});
        return description;
      }

      cases::Cost cost() const override
      {
        cases::Cost result;
        const StepCounts counts = stepper->counts();
        result.steps = steps;
        result.unknowns = unknowns();
        result.work = std::lround(dis.own.total(double(heat_flow.work())));
        result.solver_iterations = counts.linear_iterations;
        result.most_iterations = counts.most_iterations;
        result.capped_steps = counts.repeated;
        result.effects = heat_flow.effect_costs();
        if(dis.own.shared())
          add_up(result);
        return result;
      }

      cases::RankPart part() const override
      {
        return {dis.own.size(), numbers};
      }

    private:
      /** Bytes and seconds of all ranks, calls of one; what they told each other. */
      void add_up(cases::Cost &cost) const
      {
        const OwnParticles &own = dis.own;
        const auto per_step
            = [this](long count) { return double(count) / double(std::max(steps, 1L)); };
        cost.evidence = {{"ranks", own.exchange->ranks()},
                         {"exchanges per step", per_step(own.exchange->exchanges())},
                         {"reductions per step", per_step(own.exchange->reductions())}};
        for(cases::EffectCost &effect : cost.effects)
        {
          effect.bytes = std::lround(own.total(double(effect.bytes)));
          effect.seconds = own.total(effect.seconds);
        }
        cost.evidence["bytes sent per step"]
            = cost.evidence["exchanges per step"]
              * own.total(double(own.exchange->sent() * sizeof(double)));
        cost.evidence["particles that several ranks hold"]
            = own.total(double(n)) - double(own.all);
      }

      /** Share the particles out. @return those at hand */
      std::size_t share(int ranks, const cases::EffectSet &effects)
      {
        if(ranks > 0)
          share_among_ranks(dis, parameters, effects, ranks);
        return dis.particles.size();
      }

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

      /** Settles the time scheme, too. */
      StepPlan make_plan(const cases::EffectSet &effects)
      {
        const StepLimits limits
            = heat_flow.step_limits(dis.particle_volume * scene.material.solid.density,
                                    parameters.step_limit, dis.dirichlet);
        why_these_steps = settle_time_scheme(
            parameters,
            {scene.end_time - scene.start_time, parameters.step_factor * limits.monotone,
             heat_flow.half_bandwidth(), effects.contains(cases::Effect::liquid_motion),
             effects.contains(cases::Effect::moving_source)});
        return plan_steps(parameters, scene, limits, dis.kernel.smoothing_length());
      }

      static std::unique_ptr<const MassCoordinates>
      in_mass_coordinates(const cases::Scene &in_space, const cases::EffectSet &effects,
                          SphParameters &parameters)
      {
        if(!effects.contains(cases::Effect::liquid_motion) || parameters.dimension > 1)
          return nullptr;
        auto result = std::make_unique<const MassCoordinates>(in_space, parameters);
        parameters.n = result->particles;
        return result;
      }

      static std::unique_ptr<const LiquidBalance>
      balance_of_liquid(const cases::Scene &in_space, const cases::EffectSet &effects,
                        const SphParameters &parameters)
      {
        if(!effects.contains(cases::Effect::liquid_motion) || parameters.dimension == 1)
          return nullptr;
        return std::make_unique<const LiquidBalance>(in_space, parameters);
      }

      /** Where liquid flows past the particles, of all matter; else 0. */
      double mass() const
      {
        const LiquidFlow *liquid = heat_flow.flowing_liquid();
        return liquid ? liquid->mass() : 0;
      }

      std::vector<double> start() const
      {
        std::vector<double> enthalpy = initial_enthalpy(dis);
        if(const OpenEnd *end = heat_flow.open_end())
          end->hide(enthalpy);
        return enthalpy;
      }

      /** Where the domain's end moves over the particles, what they stand for. */
      void weigh()
      {
        if(const OpenEnd *end = heat_flow.open_end())
          end->weigh(dis.weights);
      }

      cases::HeatBudget heat_content() const
      {
        const std::span<const double> enthalpy = stepper->enthalpies();
        const cases::Material &m = scene.material;
        if(m.curves)
          return heat_by_curves(*m.curves);
        ExactSum stored, latent;
        for(std::size_t a = dis.own.begin; a < dis.own.end; ++a)
        {
          const double mass = dis.weights[a] * m.solid.density;
          latent.add(mass * std::clamp(enthalpy[a], 0., m.latent_heat));
          stored.add(
              mass
              * (std::min(enthalpy[a], 0.) + std::max(enthalpy[a] - m.latent_heat, 0.)));
        }
        cases::HeatBudget heat;
        heat.stored = dis.own.total(stored);
        heat.latent
            = dis.own.total(latent) * (liquid_balance ? liquid_balance->in_space() : 1.);
        heat.initial = heat.stored + heat.latent;
        return heat;
      }

      /** The latent heat of what is liquid, and the rest. */
      cases::HeatBudget heat_by_curves(const cases::ThermalCurves &curves) const
      {
        const std::span<const double> enthalpy = stepper->enthalpies();
        const double latent_heat = scene.material.latent_heat;
        ExactSum stored, latent;
        for(std::size_t a = dis.own.begin; a < dis.own.end; ++a)
        {
          const double mass = dis.weights[a] * scene.material.solid.density;
          const double molten
              = latent_heat * (1 - curves.at_enthalpy(enthalpy[a]).solid_fraction);
          latent.add(mass * molten);
          stored.add(mass * (enthalpy[a] - molten));
        }
        cases::HeatBudget heat;
        heat.stored = dis.own.total(stored);
        heat.latent = dis.own.total(latent);
        heat.initial = heat.stored + heat.latent;
        return heat;
      }

      cases::Snapshot snapshot(long step, double time) override
      {
        const cases::Material &m = scene.material;
        const std::span<const double> enthalpy = stepper->enthalpies();
        for(std::size_t a = dis.own.begin; a < dis.own.end; ++a)
        {
          temperature[a] = m.temperature(enthalpy[a]);
          solid_fraction[a] = m.solid_fraction(enthalpy[a]);
        }
        weigh();
        cases::Snapshot result
            = particle_snapshot(dis, step, time, temperature, solid_fraction);
        if(mass_coordinates)
          return_to_space(result);
        result.heat = heat_content();
        result.heat.initial = initial_heat.initial;
        result.heat.boundary = stepper->boundary_heat();
        result.heat.sources = heat_flow.source_heat(time) / dis.cross_section;
        result.mass = {mass(), initial_mass};
        return result;
      }

      /** Put the particles within the open end where they are in space, with the volumes
       * that they have there and the share of them that is solid. */
      void return_to_space(cases::Snapshot &snapshot)
      {
        const std::size_t live = heat_flow.open_end()->last() + 1;
        place.resize(live);
        width.resize(live);
        double reached = mass_coordinates->lowest;
        for(std::size_t a = 0; a < live; ++a)
        {
          const double solid = dis.weights[a] * solid_fraction[a];
          width[a] = mass_coordinates->width(dis.weights[a], solid_fraction[a]);
          solid_fraction[a] = solid / width[a];
          place[a] = reached + 0.5 * width[a];
          reached += width[a];
        }
        snapshot.positions[0] = place;
        snapshot.weights = width;
        snapshot.temperature = snapshot.temperature.first(live);
        snapshot.solid_fraction = snapshot.solid_fraction.first(live);
      }

      long unknowns() const
      {
        return static_cast<long>(dis.own.all - dis.dirichlet.size());
      }

      SphParameters parameters;
      /** Where freezing displaces liquid along a line; else null. */
      std::unique_ptr<const MassCoordinates> mass_coordinates;
      /** Where it does so in the plane or in space; else null. */
      std::unique_ptr<const LiquidBalance> liquid_balance;
      const cases::Scene &scene; ///< of the particles; at rest if liquid is displaced
      Discretisation dis;
      std::size_t n;                      ///< particles at hand
      std::vector<std::uint64_t> numbers; ///< of own particles, where ranks share a run
      HeatFlow heat_flow;
      std::string why_these_steps; ///< of automatic, for the record
      StepPlan plan;
      std::unique_ptr<Stepper> stepper;
      long steps = 0;                                  ///< made so far
      std::vector<double> temperature, solid_fraction; ///< for snapshots
      std::vector<double> place, width;                ///< likewise, in space
      cases::HeatBudget initial_heat;
      double initial_mass = 0;
    };
  } // namespace

  std::unique_ptr<cases::Run> make_sph_run(const SphPolicy &policy,
                                           const cases::Scene &scene,
                                           const cases::EffectSet &effects,
                                           const cases::Resolution &resolution)
  {
    return std::make_unique<SphRun>(policy, scene, effects, resolution, 0);
  }

  std::unique_ptr<cases::SharedRun>
  make_shared_sph_run(const SphPolicy &policy, const cases::Scene &scene,
                      const cases::EffectSet &effects,
                      const cases::Resolution &resolution, int ranks)
  {
    return std::make_unique<SphRun>(policy, scene, effects, resolution, ranks);
  }
} // namespace meltfront::particles
