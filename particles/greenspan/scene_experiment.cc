#include <cases/demand.h>
#include <cases/error.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/scene_experiment.h>
#include <particles/greenspan/tables.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

    /** The bath as one over all of space, whose heat is counted. */
    BathZone bath_of(const cases::HeatBath &given, double time_step, std::uint64_t seed)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      BathZone zone{-infinity, infinity, {}};
      zone.bath.rate = given.rate;
      zone.bath.seed = seed;
      for(std::size_t k = 0; k < given.times.size(); ++k)
        zone.bath.course.push_back(
            {std::lround(given.times[k] / time_step), given.temperatures[k]});
      return zone;
    }

    Radiation radiation_of(const cases::Light &given)
    {
      Radiation radiation;
      radiation.parallel = given.parallel;
      (given.parallel ? radiation.direction : radiation.position) = given.at;
      radiation.power = given.power;
      radiation.radius = given.radius;
      return radiation;
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
      parameters.drag = solid.drag;
      if(solid.base)
        parameters.base = base_of(*solid.base);
      if(solid.heating)
        parameters.source = source_of(*solid.heating);
      if(solid.bath)
        parameters.zones = {bath_of(*solid.bath, parameters.time_step, resolution.seed)};
      if(solid.light)
        parameters.radiation = radiation_of(*solid.light);
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
      if(!solid.base || !solid.settled)
        return lattice;
      Relaxation relaxation = Relaxation::for_rows(force, rows);
      relaxation.gravity = solid.gravity;
      relaxation.time_step = solid.time_step;
      relaxation.threads = resolution.threads;
      return relax_on_base(lattice, relaxation).state;
    }

    ParticleState table_of(const cases::ParticleSolid &solid, int n)
    {
      ParticleState state
          = read_table(solid.table, solid.errata ? Errata::applied : Errata::as_printed);
      if(static_cast<std::size_t>(n) != state.size())
        throw cases::Refusal(
            fmt::format("table {} has {} particles: n must be {}, not {}", solid.table,
                        state.size(), state.size(), n));
      return state;
    }

    /** Where the particles are at the start. */
    ParticleState places_of(const cases::ParticleSolid &solid,
                            const cases::Resolution &resolution, const PairForce &force)
    {
      using cases::SolidArrangement;
      const int n = resolution.n;
      const double spacing = force.equilibrium_distance(), radius = n * spacing / 2;
      switch(solid.arrangement)
      {
      case SolidArrangement::table:
        return table_of(solid, n);
      case SolidArrangement::disk:
        return HexagonalLattice::disk(radius, spacing);
      case SolidArrangement::outline:
        return HexagonalLattice::within(
            cases::Outline([&](double phi) { return radius * solid.outline(phi); },
                           {0, 0}),
            spacing);
      case SolidArrangement::block:
        return HexagonalLattice::close_packed_box({n, n, n}, spacing);
      case SolidArrangement::ball:
        return HexagonalLattice::close_packed_ball(radius, spacing);
      default:
        return laid_to_rest(solid, resolution, force);
      }
    }

    /** @throws cases::Refusal of a solid that overlaps with its own images */
    void require_room(const ParticleState &state, const std::vector<double> &cell)
    {
      for(std::size_t d = 0; d < cell.size(); ++d)
      {
        const auto [least, largest] = std::ranges::minmax(state.position[d]);
        if(cell[d] > 0 && largest - least >= cell[d])
          throw cases::Refusal(fmt::format(
              "greenspan: the solid is {:.4g} long in direction {}, where space repeats "
              "itself after {:.4g}: it would overlap with its images; take a smaller n "
              "or a larger cell",
              largest - least, d, cell[d]));
      }
    }

    ParticleState start_of(const cases::ParticleSolid &solid,
                           const cases::Resolution &resolution, const PairForce &force)
    {
      ParticleState state = places_of(solid, resolution, force);
      require_room(state, solid.cell);
      if(solid.initial_temperature > 0)
        set_temperature(state, solid.initial_temperature, resolution.seed);
      std::ranges::copy(solid.cell, state.period.begin());
      return state;
    }

    std::vector<RunStage> stages_of(const cases::Scene &scene, double time_step)
    {
      std::vector<RunStage> stages;
      long begin = 0;
      for(const double time : scene.particle_solid->stages)
      {
        const long end = std::lround((time - scene.start_time) / time_step);
        stages.push_back({begin, end});
        begin = end;
      }
      return stages;
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
    force.shifted = law.shifted;
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

  double particles_of(const cases::ParticleSolid &solid, int n)
  {
    using cases::SolidArrangement;
    const double across = n;
    switch(solid.arrangement)
    {
    case SolidArrangement::table:
      return across;
    case SolidArrangement::triangle:
      return across * (across + 1) / 2;
    case SolidArrangement::disk:
    case SolidArrangement::outline: // of the area of its disk, or so
      return std::numbers::pi / 4 * across * across / std::sqrt(0.75);
    case SolidArrangement::block:
      return 4 * std::pow(across, 3);
    case SolidArrangement::ball:
      return std::numbers::pi / 6 * std::pow(across, 3) * std::numbers::sqrt2;
    default:
      return across * solid.rows;
    }
  }

  cases::Demand solid_demand(const cases::Scene &scene,
                             const cases::Resolution &resolution)
  {
    // Neighbours stand in rows as they are found, by name and in slices; among all pairs
    // there is room for a row of everything first.
    constexpr double per_particle = 300, per_neighbour = 12, of_pair = 4;
    const cases::ParticleSolid &solid = *scene.particle_solid;
    const bool bar = scene.problem == cases::ProblemKind::stefan;
    const auto options = cases::read_options(SolidOptions(), resolution.options);
    const double particles = particles_of(solid, resolution.n);
    const bool space = solid.dimension() == 3;
    const double reach
        = (solid.law.cutoff + options.skin) / force_of(solid.law).equilibrium_distance();
    const double neighbours = space ? cases::points_within(3, reach) * std::sqrt(2.)
                                    : cases::points_within(2, reach) * std::sqrt(4. / 3);
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
    experiment.stages = stages_of(scene, experiment.parameters.time_step);
    experiment.steps = std::lround((scene.end_time - scene.start_time)
                                   / experiment.parameters.time_step);
    experiment.interval
        = cases::read_options(SolidOptions(), resolution.options).interval;
    if(solid.test == cases::SolidTest::temperature)
      experiment.test = PhaseTest::temperature;
    if(solid.test == cases::SolidTest::order)
      experiment.test = PhaseTest::order;
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
