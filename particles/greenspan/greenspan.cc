#include <cases/error.h>
#include <cases/numbers.h>
#include <cases/reported_scalars.h>
#include <cases/run.h>
#include <cases/scene.h>
#include <particles/greenspan/bar/bar_run.h>
#include <particles/greenspan/checkpoint.h>
#include <particles/greenspan/diagnostics.h>
#include <particles/greenspan/greenspan.h>
#include <particles/greenspan/scene_experiment.h>
#include <particles/greenspan/structure.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace meltfront::particles
{
  namespace
  {
    using namespace greenspan;

    using cases::nan;

    class SolidRun : public cases::Run
    {
    public:
      SolidRun(const cases::Scene &scene, const cases::EffectSet &effects,
               const cases::Resolution &resolution)
        : scene(scene)
        , effects(effects)
        , experiment(experiment_of(scene, resolution))
        , options(cases::read_options(SolidOptions(), resolution.options))
        , resumed(options.checkpoint.empty()
                      ? std::optional<Checkpoint>()
                      : read_checkpoint(options.checkpoint, experiment))
        , motion(experiment.parameters, resumed ? resumed->state : experiment.start)
        , diagnostics(experiment)
        , balanced(!experiment.parameters.base && !experiment.parameters.source
                   && experiment.parameters.drag == 0)
        , conserves_energy(balanced && experiment.parameters.zones.empty()
                           && !experiment.parameters.radiation)
      {
        if(!experiment.stages.empty())
          structure.emplace(experiment);
        if(!options.checkpoint.empty()
           && (structure || repeats(experiment.start.period)
               || !experiment.parameters.zones.empty()
               || experiment.parameters.radiation))
          throw cases::Refusal("a checkpoint keeps neither what a bath and light have "
                               "given nor the means of stages nor a cell; leave "
                               "'checkpoint' empty");
        if(options.checkpoint_interval % experiment.interval != 0)
          throw cases::Refusal(fmt::format("checkpoint_interval = {} is no multiple of "
                                           "interval = {}",
                                           options.checkpoint_interval,
                                           experiment.interval));
      }

      cases::RunDescription describe() const override
      {
        const MotionParameters &parameters = experiment.parameters;
        cases::RunDescription result;
        result.dimension = experiment.start.dimension;
        result.spacing = parameters.force.equilibrium_distance();
        result.time_step = parameters.time_step;
        result.unknowns = unknowns();
        const auto add = [&](const char *name, double value) {
          result.parameters.push_back({name, fmt::format("{:.6g}", value), ""});
        };
        add("particles", static_cast<double>(motion.size()));
        add("work that breaks a bond", parameters.force.bond_work());
        add("stable time step",
            parameters.force.stable_time_step(experiment.start.dimension));
        add("steps between looks", static_cast<double>(experiment.interval));
        return result;
      }

      cases::Cost cost() const override
      {
        cases::Cost result;
        result.steps = experiment.steps;
        result.unknowns = unknowns();
        result.work = experiment.steps * static_cast<long>(motion.size());
        for(const cases::EffectDecision &decision : effects.decisions())
          if(decision.on)
            result.effects.push_back(motion.cost(decision.effect));
        return result;
      }

    private:
      void take_steps() override
      {
        if(resumed)
          go_on();
        else
        {
          initial_energy = motion.energy().total();
          look();
        }
        while(motion.step() < experiment.steps)
        {
          motion.advance(std::min(experiment.interval, experiment.steps - motion.step()));
          look();
          keep_checkpoint();
        }
        if(!options.checkpoint.empty())
          std::filesystem::remove(options.checkpoint); // it has served
        tell_reported_scalars();
      }

      long unknowns() const
      {
        return static_cast<long>(2 * motion.size()) * experiment.start.dimension;
      }

      double time() const
      {
        return motion.step() == experiment.steps ? scene.end_time
                                                 : scene.start_time + motion.time();
      }

      void go_on()
      {
        diagnostics.remember(resumed->memory);
        initial_energy = resumed->initial_energy;
        energy_error = resumed->energy_error;
        state = motion.state();
        reached(motion.step(), time());
        note(time(),
             fmt::format("goes on from the checkpoint of step {}; what was before "
                         "is not sampled again",
                         motion.step()));
      }

      void keep_checkpoint()
      {
        if(options.checkpoint.empty() || motion.step() % options.checkpoint_interval != 0)
          return;
        write_checkpoint(options.checkpoint,
                         {run_fingerprint(experiment), motion.state(),
                          diagnostics.memory(), initial_energy, energy_error});
      }

      void look()
      {
        state = motion.state();
        diagnostics.look(state);
        if(conserves_energy || structure)
        {
          const double energy = motion.energy().total();
          energy_error = std::max(energy_error, std::abs(energy - initial_energy));
          if(structure)
            structure->look(state, energy, diagnostics.solid());
        }
        reached(motion.step(), time());
      }

      cases::Snapshot snapshot(long step, double time) override
      {
        weights.assign(state.size(), 1);
        solid.assign(diagnostics.solid().begin(), diagnostics.solid().end());
        temperature.resize(state.size());
        if(!state.kinetic_sum.empty() && state.step > 0)
          temperature = temperatures(state);
        else
          for(std::size_t i = 0; i < state.size(); ++i)
          {
            temperature[i] = 0;
            for(int d = 0; d < state.dimension; ++d)
              temperature[i] += state.velocity[d][i] * state.velocity[d][i] / 2;
          }
        cases::Snapshot snapshot;
        snapshot.step = step;
        snapshot.time = time;
        snapshot.dimension = state.dimension;
        for(int d = 0; d < state.dimension; ++d)
        {
          snapshot.positions[d] = place(d);
          snapshot.velocity[d] = state.velocity[d];
        }
        snapshot.weights = weights;
        snapshot.temperature = temperature;
        snapshot.solid_fraction = solid;
        snapshot.heat.conservative = false;
        return snapshot;
      }

      /** Coordinates, in a cell about where the start lay. */
      std::span<const double> place(int d)
      {
        const double period = state.period[d];
        if(period == 0)
          return state.position[d];
        const auto [lowest, highest] = std::ranges::minmax(experiment.start.position[d]);
        const double edge = (lowest + highest - period) / 2;
        in_cell[d].resize(state.size());
        for(std::size_t i = 0; i < state.size(); ++i)
          in_cell[d][i] = edge + wrapped(state.position[d][i] - edge, period);
        return in_cell[d];
      }

      void tell_reported_scalars()
      {
        const RunRecord &record = diagnostics.record();
        const auto step = [&](const char *name, long value)
        { report(name, value < 0 ? nan : static_cast<double>(value)); };
        step("first_break", record.first_break);
        step("first_fluid", record.first_fluid);
        step("unheated_from", record.unheated);
        step("all_fluid_at", record.all_fluid);
        const std::vector<std::uint32_t> &fluid = record.final_fluid;
        const std::pair<const char *, double> counts[]
            = {{"least_solid", record.least_solid},
               {"fluid_end", static_cast<double>(fluid.size())},
               {"bonds_kept", record.old_bonds},
               {"whole_until_broken",
                record.first_break < 0 ? experiment.steps : record.first_break},
               {"all_solid_end", fluid.empty()},
               {"all_fluid", record.all_fluid >= 0},
               {"base_buckled", record.base_buckled},
               {"left_lobe_longer", -record.lowest_x > record.highest_x},
               {"lowest_x", record.lowest_x},
               {"highest_x", record.highest_x},
               {"highest_y", record.highest_y},
               {"kinetic_energy_end", record.kinetic_energy}};
        for(const auto &[name, value] : counts)
          report(name, value);
        tell_heat();
        tell_extent();
        if(structure)
          for(const auto &[name, value] : structure->report())
            report(name, value);
        if(experiment.parameters.temperatures)
          report("mean_temperature_end", record.mean_temperature);
        if(conserves_energy)
          report("energy_error", energy_error);
        for(std::size_t c = 0; c < record.corners.size(); ++c)
        {
          const bool lost = record.corners[c].step >= 0;
          report(fmt::format("corner_{}_temperature", c + 1),
                 lost ? record.corners[c].temperature : nan);
          report(fmt::format("corner_{}_step", c + 1),
                 lost ? static_cast<double>(record.corners[c].step) : nan);
        }
        if(motion.size() <= cases::most_named_particles)
          for(std::uint32_t particle = 1; particle <= motion.size(); ++particle)
            report(fmt::format("fluid_end_{}", particle),
                   std::ranges::find(fluid, particle) != fluid.end());
      }

      /** What was given and whether the energy has it. */
      void tell_heat()
      {
        const auto n = static_cast<double>(motion.size());
        double given = 0;
        if(!motion.zone_heat().empty())
        {
          given = motion.zone_heat().front();
          report("heat_from_bath", given / n);
        }
        if(const auto &light = experiment.parameters.radiation)
        {
          given += motion.absorbed();
          report("light_absorbed", motion.absorbed() / n);
          report("light_caught", motion.absorbed() / (light->power * motion.time()));
        }
        if(balanced && !conserves_energy)
          report("energy_defect",
                 std::abs(motion.energy().total() - initial_energy - given)
                     / std::max(std::abs(given),
                                n * experiment.parameters.force.bond_work()));
      }

      /** How large a solid is that was made here. */
      void tell_extent()
      {
        if(scene.particle_solid->arrangement == cases::SolidArrangement::table)
          return;
        const RunRecord &record = diagnostics.record();
        report("width_end", record.highest_x - record.lowest_x);
        report("height_end", std::ranges::max(state.position[1]));
        const auto [shortest, longest]
            = bond_lengths(state, BondGraph(state, experiment.parameters.force.cutoff));
        report("shortest_bond_end", shortest);
        report("longest_bond_end", longest);
      }

      const cases::Scene &scene;
      const cases::EffectSet &effects;
      Experiment experiment;
      SolidOptions options;
      std::optional<Checkpoint> resumed;
      Motion motion;
      Diagnostics diagnostics;
      std::optional<Structure> structure;
      bool balanced; ///< what the energy changes by is known
      bool conserves_energy;
      double initial_energy = 0;
      double energy_error = 0;
      ParticleState state; ///< at the last look
      std::vector<double> weights, solid, temperature;
      std::array<std::vector<double>, 3> in_cell;
    };

    class Greenspan : public cases::Method
    {
    public:
      Greenspan()
        : Method("greenspan",
                 "A solid of particles that bind each other, moved by leapfrog; it melts "
                 "where they are driven apart (Greenspan 1976).")
      {
      }

      std::vector<cases::Capabilities> capabilities() const override
      {
        using cases::Effect;
        return {{.form = "as a solid of particles",
                 .problems = {cases::ProblemKind::particle_solid},
                 .effects = {Effect::gravity, Effect::base, Effect::hot_base,
                             Effect::point_heating, Effect::drag, Effect::heat_bath,
                             Effect::light},
                 .most_threads = cases::any_number_of_threads},
                {.form = "as a bar that conducts heat",
                 .needs_particle_solid = true,
                 .problems = {cases::ProblemKind::stefan},
                 .effects = {Effect::phase_change, Effect::phase_conductivity,
                             Effect::phase_heat_capacity, Effect::wall_temperature},
                 .shapes = {{cases::DomainShape::slab,
                             {1},
                             {cases::BoundaryKind::fixed_temperature}}},
                 .front_origins = {cases::FrontOrigin::wall},
                 .most_fronts = 1,
                 .most_threads = cases::any_number_of_threads}};
      }

      std::vector<cases::OptionDeclaration> option_declarations() const override
      {
        return cases::options_of(SolidOptions());
      }

      cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &,
                           const cases::Resolution &resolution) const override
      {
        return scene.particle_solid ? solid_demand(scene, resolution) : cases::Demand();
      }

      std::unique_ptr<cases::Run>
      set_up(const cases::Scene &scene, const cases::EffectSet &effects,
             const cases::Resolution &resolution) const override
      {
        if(scene.problem == cases::ProblemKind::stefan)
          return make_bar_run(scene, effects, resolution);
        return std::make_unique<SolidRun>(scene, effects, resolution);
      }
    };
  } // namespace

  std::unique_ptr<cases::Method> make_greenspan()
  {
    return std::make_unique<Greenspan>();
  }
} // namespace meltfront::particles
