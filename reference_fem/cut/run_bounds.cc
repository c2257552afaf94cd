#include <cases/error.h>
#include <cases/overshoot.h>
#include <reference_fem/cut/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    constexpr const char *method_name = "fem-cut";

    /** A step of BDF2 that is long beside the time in which a phase evens out overshoots,
     * whatever the spacing. It may use up so much of the overshoot that is allowed;
     * beyond that it is halved as long as this leaves less than a share of it. */
    constexpr double overshoot_of_step = 0.25;
    constexpr double worth_halving = 0.75;
  } // namespace

  /** Call `visit(solid, temperature)` for each vertex of the cells inside the domain. */
  template <typename Visit>
  void CutRun::visit_vertices(const State &of, const Visit &visit) const
  {
    const BackgroundMesh &mesh = *of.mesh;
    for(unsigned int number = 0; number < mesh.cells.size(); ++number)
    {
      if(mesh.place[number] != Place::inside)
        continue;
      const Cell &cell = mesh.cells[number];
      for(unsigned int vertex = 0; vertex < 1u << dim; ++vertex)
      {
        const bool solid = of.level_set[cell.level_set_dofs[vertex]] < 0;
        visit(solid, heat.temperature(of, solid ? Phase::solid : Phase::liquid, number,
                                      mesh.element.unit_support_point(vertex)));
      }
    }
  }

  /** By how much temperatures are beyond what bounds them, and phases beyond the melting
   * temperature (K). */
  double CutRun::overshoot(const State &of) const
  {
    const double melting = scene.material.melting_temperature;
    const bool stable = !cases::metastable_initial_phase(scene);
    double most = 0;
    visit_vertices(of,
                   [&](const bool solid, const double value)
                   {
                     most = std::max({most, bounds.lower - value, value - bounds.upper});
                     if(stable)
                       most = std::max(most, solid ? value - melting : melting - value);
                   });
    return most;
  }

  double CutRun::tolerated_overshoot() const
  {
    double lowest = scene.material.melting_temperature, highest = lowest;
    visit_vertices(state,
                   [&](bool, const double value)
                   {
                     lowest = std::min(lowest, value);
                     highest = std::max(highest, value);
                   });
    const double span = (std::isfinite(bounds.upper) ? bounds.upper : highest)
                        - (std::isfinite(bounds.lower) ? bounds.lower : lowest);
    return overshoot_of_step * span
           * cases::allowed_overshoot(cut::overshoot, state.mesh->spacing, scene.domain);
  }

  double CutRun::shorten_to_bounds(double step, State &next)
  {
    const double tolerated = std::max(overshoot(state), tolerated_overshoot());
    double beyond = overshoot(next);
    while(beyond > tolerated)
    {
      State shorter;
      shorter.mesh = state.mesh;
      if(!attempt(step / 2, false, shorter))
        break;
      const double left = overshoot(shorter);
      if(left > worth_halving * beyond)
        break;
      ++halved_steps;
      step /= 2;
      beyond = left;
      next = std::move(shorter);
    }
    return step;
  }

  void CutRun::check(const State &checked) const
  {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    visit_vertices(checked,
                   [&](bool, const double temperature)
                   {
                     // A comparison passes over what is not a number.
                     if(!std::isfinite(temperature))
                       lowest = highest = temperature;
                     lowest = std::min(lowest, temperature);
                     highest = std::max(highest, temperature);
                   });
    cases::require_sinks(scene, checked.time, method_name);
    try
    {
      cases::check_temperature(
          bounds, lowest, highest, method_name, step_number, checked.time,
          cases::allowed_overshoot(cut::overshoot, checked.mesh->spacing, scene.domain));
    }
    catch(const cases::NumericalError &error)
    {
      if(wall_jump == 0 || !std::isfinite(lowest))
        throw;
      throw cases::Refusal(fmt::format(
          "{}; walls are held weakly, and the jump of one by {:.3g} K overshoots while "
          "its layer is thinner than a cell: let it change in some time, or take other "
          "cells",
          error.what(), wall_jump));
    }
    for(const Point &place : heat.sinks.places)
      if(!heat.in_solid(checked, place))
        throw cases::Refusal(fmt::format(
            "fem-cut: the source at ({:.6g}, {:.6g}) does not lie in the solid, at least "
            "a cell from the front, at time {:.6g}",
            place[0], place[1], checked.time));
  }
} // namespace meltfront::reference_fem::cut
