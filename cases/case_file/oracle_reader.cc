#include <cases/case_file/exact_construction.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/oracle_reader.h>
#include <cases/exact/axisymmetric_view.h>
#include <cases/exact/flux_freezing.h>
#include <cases/exact/one_phase_start.h>
#include <cases/exact/oracle.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    OracleWall oracle_wall(const PrmFile &prm, const Scene &scene, Side side)
    {
      const Boundary &wall = scene.boundary(side);
      const std::string here = std::string("Scene/Walls/") + to_string(side);
      if(wall.exact)
        throw prm.error(here, "kind",
                        "cannot be 'exact' where the exact solution is the oracle, which "
                        "takes its walls from the scene");
      if(wall.kind == BoundaryKind::periodic)
        throw prm.error(here, "kind", "cannot be periodic for the oracle");
      if(wall.kind == BoundaryKind::insulated)
        return {};
      const Domain &domain = scene.domain;
      const Position position = side == Side::outer ? Position{domain.radius, 0, 0}
                                : side == Side::inner
                                    ? Position{domain.inner_radius, 0, 0}
                                : side == Side::x_min ? domain.lower
                                                      : domain.upper;
      return {
          wall.kind,
          [value = wall.value, position](double time) { return value(position, time); },
          wall.heat_transfer_coefficient, wall.emission_coefficient, wall.absolute_zero};
    }

    /** Heat that a line sink on the axis removes; 0 without one. */
    double line_sink_strength(const PrmFile &prm, const Scene &scene,
                              const KnownSolution &start)
    {
      if(scene.sources.empty())
        return 0;
      if(scene.symmetry != Symmetry::cylindrical || scene.sources.size() != 1)
        throw prm.error(exact_keys, "kind",
                        "cannot be 'oracle' with sources other than "
                        "one line on the axis of a disk");
      const auto &power = scene.sources.front().power;
      return power ? -power(scene.start_time)
                   : (start.power ? -start.power(scene.start_time) : 0.);
    }

    bool &far_phase_at_melting(OracleProblem &problem)
    {
      return problem.solid_at_origin ? problem.liquid_at_melting
                                     : problem.solid_at_melting;
    }

    /** The oracle starts from the scene's initial temperature with a given front. */
    void start_from_initial_state(const PrmFile &prm, const Scene &scene,
                                  OracleProblem &problem)
    {
      prm.require(exact_keys, "initial front",
                  "an oracle that starts from the initial state needs it");
      prm.forbid(exact_keys, "start time",
                 "an oracle from the initial state starts with the scene");
      if(!scene.initial.temperature.value)
        throw prm.error(exact_keys, "start",
                        "cannot be 'initial state' where that is 'exact'");
      problem.start_time = scene.start_time;
      const double front = prm.get_number(exact_keys, "initial front");
      if(front <= problem.inner || front >= problem.outer)
        throw prm.error(exact_keys, "initial front", "lies outside the domain");
      problem.initial_fronts = {front};
      problem.initial_temperature = [field = scene.initial.temperature,
                                     time = scene.start_time](double coordinate) {
        return field({coordinate, 0, 0}, time);
      };
      const double melting = scene.material.melting_temperature;
      problem.solid_at_origin = problem.initial_temperature(problem.inner) < melting;
      bool far_at_melting = true;
      constexpr int probes = 8;
      for(int i = 1; i <= probes; ++i)
      {
        const double coordinate = front + (problem.outer - front) * i / probes;
        if(problem.initial_temperature(coordinate) != melting)
          far_at_melting = false;
      }
      far_phase_at_melting(problem) = far_at_melting;
    }

    /** The oracle starts soon after a flux has brought the wall to the melting point. */
    void start_from_wall_flux(const PrmFile &prm, const Scene &scene,
                              OracleProblem &problem)
    {
      for(const char *key : {"start time", "initial front"})
        prm.forbid(exact_keys, key, "the wall's flux decides when ice appears");
      const Boundary &wall = scene.boundary(Side::x_min);
      if(wall.kind != BoundaryKind::flux || !wall.value.constant
         || scene.boundary(Side::x_max).kind != BoundaryKind::insulated)
        throw prm.error(exact_keys, "start",
                        "cannot be 'wall flux' but where x_min has the kind 'flux', "
                        "constant in time, and x_max is insulated");
      if(!scene.initial.temperature.value)
        throw prm.error(exact_keys, "start",
                        "cannot be 'wall flux' where the initial state is 'exact'");
      const double flux = -wall.value({}, scene.start_time);
      const double far = scene.initial.temperature(scene.domain.upper, scene.start_time);
      const auto start = construct<FluxFreezing>(prm, scene.material, scene.domain.side(),
                                                 flux, far, scene.start_time);
      problem.start = start;
      problem.start_time = start->end_time();
    }

    /** One phase fills the domain until its walls make another one appear. */
    std::shared_ptr<const ExactSolution>
    from_one_phase(const PrmFile &prm, const Scene &scene, OracleProblem problem)
    {
      for(const char *key :
          {"start time", "initial front", "wall temperature", "far temperature"})
        prm.forbid(exact_keys, key, "the walls decide when another phase appears");
      if(!scene.initial.temperature.value || scene.initial.front)
        throw prm.error(exact_keys, "start",
                        "cannot be 'one phase' where the initial state is 'exact' or has "
                        "a front");
      if(!scene.sources.empty())
        throw prm.error(exact_keys, "start", "cannot be 'one phase' with sources");
      problem.start_time = scene.start_time;
      problem.initial_temperature = [field = scene.initial.temperature,
                                     time = scene.start_time](double coordinate) {
        return field({coordinate, 0, 0}, time);
      };
      const double melting = scene.material.melting_temperature;
      bool solid = false, liquid = false;
      constexpr int probes = 64;
      for(int i = 0; i <= probes; ++i)
      {
        const double excess
            = problem.initial_temperature(std::lerp(problem.inner, problem.outer,
                                                    static_cast<double>(i) / probes))
              - melting;
        solid |= excess < 0;
        liquid |= excess > 0;
      }
      if(solid && liquid)
        throw prm.error(exact_keys, "start",
                        "cannot be 'one phase' where the initial temperature is on both "
                        "sides of the melting temperature");
      problem.solid_at_origin
          = solid || (!liquid && scene.initial.solid_fraction_at_melting == 1);
      try
      {
        return solve_from_one_phase(problem);
      }
      catch(const std::exception &error)
      {
        throw prm.error(exact_keys, "kind",
                        fmt::format("gives no solution: {}", error.what()));
      }
    }
  } // namespace

  KnownSolution read_oracle(const PrmFile &prm, const Scene &scene)
  {
    if(scene.symmetry == Symmetry::none)
      throw prm.error(exact_keys, "kind",
                      "cannot be 'oracle' for a scene without symmetry");
    const Domain &domain = scene.domain;
    OracleProblem problem;
    problem.symmetry = scene.symmetry;
    problem.material = scene.material;
    problem.inner = domain.inner_radius;
    problem.outer = domain.round() ? domain.radius : domain.side();
    if(domain.shape != DomainShape::ball)
      problem.inner_wall
          = oracle_wall(prm, scene, domain.round() ? Side::inner : Side::x_min);
    problem.outer_wall
        = oracle_wall(prm, scene, domain.round() ? Side::outer : Side::x_max);
    problem.end_time = scene.end_time;
    KnownSolution start;
    const std::string word = prm.get_text(exact_keys, "start");
    if(scene.domain.shape != DomainShape::slab && word == "wall flux")
      throw prm.error(exact_keys, "start", "cannot be 'wall flux' but in a slab");
    if(word == "one phase")
      return {from_one_phase(prm, scene, problem), true, {}, {}};
    if(word == "initial state")
      start_from_initial_state(prm, scene, problem);
    else if(word == "wall flux")
      start_from_wall_flux(prm, scene, problem);
    else
    {
      prm.require(exact_keys, "start time",
                  "an oracle that starts from a similarity solution needs it");
      prm.forbid(exact_keys, "initial front",
                 "the oracle starts from a similarity solution");
      start = closed_form(prm, scene, "start");
      problem.start = start.solution;
      problem.solid_at_origin = start.solution->solid_at_origin();
      problem.start_time = prm.get_number(exact_keys, "start time");
      if(!(problem.start_time < scene.end_time))
        throw prm.error(exact_keys, "start time", "must come before the scene's end");
      far_phase_at_melting(problem)
          = far_temperature(prm, scene) == scene.material.melting_temperature;
    }
    problem.line_sink = line_sink_strength(prm, scene, start);
    return {construct<SpectralOracle>(prm, problem), true, start.power, start.energy};
  }
  /** The oracle of the cylindrical scene that an axisymmetric one is along its radius.
   */
  KnownSolution read_oracle_in_half_section(const PrmFile &prm, const Scene &scene)
  {
    for(const Side side : {Side::y_min, Side::y_max})
      if(scene.boundary(side).kind != BoundaryKind::insulated
         && scene.boundary(side).kind != BoundaryKind::periodic)
        throw prm.error(wall_keys(scene.domain, side), "kind",
                        "must be insulated or periodic for the oracle, which knows "
                        "nothing that varies along the axis");
    Scene disk = scene;
    disk.symmetry = Symmetry::cylindrical;
    disk.domain.inner_radius = scene.domain.lower[0];
    disk.domain.radius = scene.domain.upper[0];
    disk.domain.shape
        = disk.domain.inner_radius > 0 ? DomainShape::shell : DomainShape::ball;
    disk.boundaries = {};
    const auto wall = [](auto &walls, Side side) -> auto &
    {
      return walls[static_cast<std::size_t>(side)];
    };
    wall(disk.boundaries, Side::outer) = scene.boundary(Side::x_max);
    if(disk.domain.inner_radius > 0)
      wall(disk.boundaries, Side::inner) = scene.boundary(Side::x_min);
    KnownSolution known = read_oracle(prm, disk);
    known.solution = AxisymmetricView::of_cylinder(
        known.solution, disk.domain.inner_radius, disk.domain.radius,
        scene.domain.upper[1] - scene.domain.lower[1]);
    return known;
  }
} // namespace meltfront::cases
