#include <reference_fem/fitted/events/phase_check.h>

#include <cases/overshoot.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::BoundaryKind;
    using dealii::Vector;

    /** Times within a step at which a wall of fixed temperature is looked at. */
    constexpr int looks = 16;

    /** Of the temperature scale: what a wall's value is rounded by. */
    constexpr double round_off = 1e-12;

    /** What exact solutions that keep a wall at the melting point miss it by, of the
     * melting temperature, and what Newton's method leaves, of the scale. */
    constexpr double margin_of_melting = 1e-9, margin_of_scale = 1e-9;

    /** Where released heat leads a phase beyond the melting temperature, so much, of the
     * scale, is no overshoot of elements. */
    constexpr double led_beyond = 1e-3;

    /** A source of less than this share of its largest strength is none. */
    constexpr double no_source = 1e-9;

    const cases::Boundary &wall_of(const FittedProblem &problem, bool inner)
    {
      return inner ? problem.physics().inner_wall : problem.physics().outer_wall;
    }
  } // namespace

  PhaseCheck::PhaseCheck(const EventScene &setting, std::string method)
    : setting(setting)
    , method(std::move(method))
  {
    constexpr int samples = 64;
    const cases::Scene &scene = setting.scene;
    for(const cases::PointSource &source : scene.sources)
      for(int i = 0; i <= samples; ++i)
        largest_power = std::max(
            largest_power,
            std::abs(source.power(scene.start_time
                                  + (scene.end_time - scene.start_time) * i / samples)));
  }

  void PhaseCheck::start(const FittedProblem &problem, double time,
                         const Vector<double> &u)
  {
    if(!setting.effects.contains(cases::Effect::metastable_phase))
      return;
    const RayMesh &mesh = problem.mesh();
    const double slack = margin_of_scale * problem.physics().temperature_scale;
    for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
      for(unsigned int level = 0; level < mesh.n_levels(); ++level)
      {
        if(mesh.front_at(level) != RayMesh::none)
          continue;
        const unsigned int interval = mesh.interval_of(level);
        const bool solid = problem.phase(interval).solid;
        const double r = problem.coordinate(ray, level, u);
        if(r == 0 && problem.physics().power)
          continue;
        const double excess
            = u[mesh.node(ray, level)] + problem.source(interval, time).value(r);
        if(beyond(solid, excess) > slack)
          metastable[solid ? 0 : 1] = true;
      }
  }

  bool PhaseCheck::has_passed(const FittedProblem &problem, bool inner, unsigned int ray,
                              double time, const Vector<double> &u) const
  {
    const RayMesh &mesh = problem.mesh();
    const Physics &physics = problem.physics();
    const bool solid = problem.phase(inner ? 0 : mesh.n_fronts()).solid;
    if(metastable[solid ? 0 : 1])
      return false;
    const cases::Boundary &wall = wall_of(problem, inner);
    const cases::Position place = mesh.position(ray, inner ? mesh.inner : mesh.outer);
    if(wall.kind == BoundaryKind::fixed_temperature)
    {
      const double excess
          = beyond(solid, wall.value(place, time) - physics.melting_temperature);
      return excess > round_off * physics.temperature_scale
             && (!wall.exact
                 || excess > margin_of_melting * std::abs(physics.melting_temperature));
    }
    const double excess = problem.wall_excess(inner, ray, time, u);
    const double flux
        = cases::heat_through(wall, place, time, physics.melting_temperature + excess)
              .flux;
    // Elements overshoot also at a wall; it passes the melting temperature where heat
    // leads it there.
    return beyond(solid, excess)
           > (beyond(solid, flux) > 0 ? margin_of_scale : overshoot())
                 * physics.temperature_scale;
  }

  double PhaseCheck::overshoot() const
  {
    const cases::Domain &domain = setting.scene.domain;
    return cases::allowed_overshoot(fitted::overshoot,
                                    domain.side() / setting.options.cells, domain);
  }

  bool PhaseCheck::is_dirichlet_beyond(const FittedProblem &problem, bool inner,
                                       double time) const
  {
    const cases::Boundary &wall = wall_of(problem, inner);
    if(wall.kind != BoundaryKind::fixed_temperature)
      return false;
    for(unsigned int ray = 0; ray < problem.mesh().surface.n_rays(); ++ray)
      if(has_passed(problem, inner, ray, time, {}))
        return true;
    return false;
  }

  std::vector<WallCrossing> PhaseCheck::wall_crossings(const FittedProblem &problem,
                                                       double from, double to,
                                                       const Vector<double> &u) const
  {
    const RayMesh &mesh = problem.mesh();
    const Clock &clock = problem.physics().clock;
    std::vector<WallCrossing> result;
    for(const bool inner : {true, false})
    {
      const cases::Boundary &wall = wall_of(problem, inner);
      if((inner && mesh.has_centre()) || wall.kind == BoundaryKind::insulated)
        continue;
      std::optional<double> at;
      const bool varies
          = wall.kind == BoundaryKind::fixed_temperature && !wall.value.constant;
      for(int k = 1; k < looks && varies && !at; ++k)
      {
        const double there = from + (to - from) * k / looks;
        if(is_dirichlet_beyond(problem, inner, clock.time(there)))
          at = there;
      }
      for(unsigned int ray = 0; ray < mesh.surface.n_rays() && !at; ++ray)
        if(has_passed(problem, inner, ray, clock.time(to), u))
          at = to;
      if(at)
        result.push_back({inner, *at});
    }
    return result;
  }

  void PhaseCheck::check(const FittedProblem &problem, long step, double time,
                         const Vector<double> &u) const
  {
    check_source(problem, time);
    check_nodes(problem, step, time, u);
  }

  void PhaseCheck::refuse(bool inner, double time) const
  {
    throw cases::Refusal(
        fmt::format("fem-fitted follows one front in more than one dimension; at t = "
                    "{:.6g} the wall {} has passed the melting temperature, where a "
                    "second one starts",
                    time, to_string(side_at(setting.scene, inner))));
  }

  void PhaseCheck::check_source(const FittedProblem &problem, double time) const
  {
    const Physics &physics = problem.physics();
    if(!physics.power || is_metastable(physics.phases[0].solid))
      return;
    const double power = physics.power(time);
    if(beyond(physics.phases[0].solid, power) > no_source * largest_power)
      throw cases::Refusal(fmt::format(
          "fem-fitted follows fronts that walls start; at t = {:.6g} the source at the "
          "centre {} around it, where another one starts",
          time, physics.phases[0].solid ? "melts the solid" : "freezes the liquid"));
  }

  void PhaseCheck::check_nodes(const FittedProblem &problem, long step, double time,
                               const Vector<double> &u) const
  {
    const RayMesh &mesh = problem.mesh();
    const Physics &physics = problem.physics();
    for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
      for(unsigned int level = 0; level < mesh.n_levels(); ++level)
      {
        const unsigned int interval = mesh.interval_of(level);
        const bool solid = problem.phase(interval).solid;
        const double r = problem.coordinate(ray, level, u);
        if(mesh.front_at(level) != RayMesh::none || metastable[solid ? 0 : 1]
           || (r == 0 && physics.power))
          continue;
        const double excess
            = u[mesh.node(ray, level)] + problem.source(interval, time).value(r);
        const bool led
            = physics.volumetric_source.value
              && beyond(solid, physics.volumetric_source(mesh.position(ray, r), time))
                     > 0;
        const double allowed = led ? std::min(led_beyond, overshoot()) : overshoot();
        if(!(beyond(solid, excess) > allowed * physics.temperature_scale))
          continue;
        if(step == 0)
          throw cases::Refusal(fmt::format(
              "fem-fitted takes {} {} its melting point ({:.6g} at r = {:.6g}) only with "
              "the effect metastable_phase, which is off",
              solid ? "solid" : "liquid", solid ? "above" : "below",
              physics.melting_temperature + excess, r));
        if(physics.volumetric_source.value)
          throw cases::Refusal(fmt::format("fem-fitted follows fronts that walls start; "
                                           "at t = {:.6g} the heat released "
                                           "throughout {} at r = {:.6g} away from them",
                                           time, solid ? "melts solid" : "freezes liquid",
                                           r));
        throw cases::NumericalError(
            method, step, time, fmt::format("the temperature at r = {:.6g}", r),
            fmt::format("is {:.6g}, {} the melting point in {} away from the front; "
                        "more cells or steps may help",
                        physics.melting_temperature + excess, solid ? "above" : "below",
                        solid ? "solid" : "liquid"));
      }
  }
} // namespace meltfront::reference_fem::fitted
