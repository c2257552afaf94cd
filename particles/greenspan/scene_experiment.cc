#include <cases/demand.h>
#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/scene_experiment.h>
#include <particles/greenspan/tables.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    Base base_of(const cases::SolidBase &given)
    {
      Base base;
      base.restitution = given.restitution;
      if(given.hot)
      {
        base.hot_half_width = given.hot->half_width;
        base.hot_left = given.hot->left;
        base.hot_slope = given.hot->slope;
      }
      return base;
    }

    HeatSource source_of(const cases::PointHeating &given)
    {
      HeatSource source;
      source.position = given.position;
      source.power = given.power;
      source.reach = given.reach;
      for(const cases::HeatingStage &stage : given.stages)
        source.stages.push_back({stage.steps, stage.strength});
      return source;
    }

    MotionParameters parameters_of(const cases::ParticleSolid &solid,
                                   const cases::Resolution &resolution)
    {
      const auto options = cases::read_options(SolidOptions(), resolution.options);
      MotionParameters parameters;
      parameters.force = force_of(solid.law);
      const double factor = options.step_factor;
      if(factor != 1 && (solid.base || solid.heating))
        throw cases::Refusal("step_factor scales the time step, but a base and a source "
                             "act once in each step: with another step they are another "
                             "model; leave it 1");
      parameters.time_step = factor * solid.time_step;
      parameters.gravity = solid.gravity;
      if(solid.base)
        parameters.base = base_of(*solid.base);
      if(solid.heating)
        parameters.source = source_of(*solid.heating);
      parameters.temperatures = solid.test == cases::SolidTest::temperature;
      parameters.skin = options.skin;
      parameters.search = options.search;
      parameters.threads = resolution.threads;
      return parameters;
    }

    ParticleState laid_to_rest(const cases::ParticleSolid &solid,
                               const cases::Resolution &resolution,
                               const PairForce &force)
    {
      const double spacing = force.equilibrium_distance();
      const bool triangle = solid.arrangement == cases::SolidArrangement::triangle;
      const int rows = triangle ? resolution.n : solid.rows;
      if(resolution.n < 2)
        throw cases::Refusal("a solid needs two particles on its base: n = 2 or more");
      const ParticleState lattice
          = triangle ? HexagonalLattice::triangle(resolution.n, spacing)
                     : HexagonalLattice::rectangle(resolution.n, rows, spacing);
      if(!solid.base)
        return lattice;
      Relaxation relaxation = Relaxation::for_rows(force, rows);
      relaxation.gravity = solid.gravity;
      relaxation.time_step = solid.time_step;
      relaxation.threads = resolution.threads;
      return relax_on_base(lattice, relaxation).state;
    }

    ParticleState start_of(const cases::ParticleSolid &solid,
                           const cases::Resolution &resolution, const PairForce &force)
    {
      if(solid.arrangement != cases::SolidArrangement::table)
        return laid_to_rest(solid, resolution, force);
      ParticleState state
          = read_table(solid.table, solid.errata ? Errata::applied : Errata::as_printed);
      if(static_cast<std::size_t>(resolution.n) != state.size())
        throw cases::Refusal(
            fmt::format("table {} has {} particles: n must be {}, not {}", solid.table,
                        state.size(), state.size(), resolution.n));
      return state;
    }
  } // namespace

  PairForce force_of(const cases::PairLaw &law)
  {
    PairForce force;
    force.attraction = law.attraction;
    force.repulsion = law.repulsion;
    force.attraction_exponent = law.attraction_exponent;
    force.repulsion_exponent = law.repulsion_exponent;
    force.cutoff = law.cutoff;
    return force;
  }

  void SolidOptions::bind(cases::OptionBinder &options)
  {
    options.add("interval", interval,
                "Steps from one look at the particles to the next; divides 1000.", 1,
                1000);
    options.add("skin", skin, "Neighbours are kept that much beyond the cutoff.", 0, 2);
    options.add("neighbours", search,
                "How neighbours are found: cells for large solids, or all pairs.",
                {{"automatic", NeighbourRows::Search::automatic},
                 {"all-pairs", NeighbourRows::Search::among_all}});
    options.add("step_factor", step_factor,
                "Time step over that of the scene, where nothing acts once per step.",
                0.01, 10);
    options.add("checkpoint", checkpoint,
                "File that a run is saved to and goes on from, bit for bit, removed at "
                "its end; empty: none.");
    options.add("checkpoint_interval", checkpoint_interval,
                "Steps from one checkpoint to the next, a multiple of the interval.", 1,
                1e9);
  }

  cases::Demand solid_demand(const cases::Scene &scene,
                             const cases::Resolution &resolution)
  {
    using cases::SolidArrangement;
    // Neighbours stand in rows as they are found, by name and in slices; among all pairs
    // there is room for a row of everything first.
    constexpr double per_particle = 300, per_neighbour = 12, of_pair = 4;
    const cases::ParticleSolid &solid = *scene.particle_solid;
    const bool bar = scene.problem == cases::ProblemKind::stefan;
    const auto options = cases::read_options(SolidOptions(), resolution.options);
    const double n = resolution.n;
    const double particles = solid.arrangement == SolidArrangement::table ? n
                             : solid.arrangement == SolidArrangement::triangle
                                 ? n * (n + 1) / 2
                                 : n * solid.rows;
    const double reach
        = (solid.law.cutoff + options.skin) / force_of(solid.law).equilibrium_distance();
    const double neighbours = cases::points_within(2, reach) * std::sqrt(4. / 3);
    const bool all_pairs = !bar && options.search == NeighbourRows::Search::among_all;
    const double step = solid.time_step * (bar ? 1 : options.step_factor);
    return {cases::program_bytes
                + particles
                      * (per_particle + per_neighbour * neighbours
                         + (all_pairs ? of_pair * particles : 0)),
            (scene.end_time - scene.start_time) / step};
  }

  Experiment experiment_of(const cases::Scene &scene, const cases::Resolution &resolution)
  {
    const cases::ParticleSolid &solid = *scene.particle_solid;
    Experiment experiment;
    experiment.name = scene.name;
    experiment.parameters = parameters_of(solid, resolution);
    experiment.start = start_of(solid, resolution, experiment.parameters.force);
    if(solid.disturbance > 0)
      disturb(experiment.start, solid.disturbance, resolution.seed);
    experiment.steps = std::lround((scene.end_time - scene.start_time)
                                   / experiment.parameters.time_step);
    experiment.interval
        = cases::read_options(SolidOptions(), resolution.options).interval;
    if(solid.test == cases::SolidTest::temperature)
      experiment.test = PhaseTest::temperature;
    for(const int corner : solid.corners)
    {
      if(static_cast<std::size_t>(corner) > experiment.start.size())
        throw cases::Refusal(fmt::format("there is no particle {} whose last bond could "
                                         "be looked for: there are {}",
                                         corner, experiment.start.size()));
      experiment.corners.push_back(static_cast<std::uint32_t>(corner));
    }
    if(!solid.corners.empty())
      experiment.parameters.temperatures = true;
    return experiment;
  }
} // namespace meltfront::particles::greenspan
