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
    /** A step of BDF2 that is long beside the time in which a phase evens out overshoots,
     * whatever the spacing. It may use up so much of the overshoot that is allowed;
     * beyond that it is halved as long as this leaves less than a share of it. */
    constexpr double overshoot_of_step = 0.25;
    constexpr double worth_halving = 0.75;

    /** Cells: what there is of a phase, at the start or at its end, is not resolved where
     * it is nowhere deeper. */
    constexpr double least_depth = 2.5;

    /** Of the bounds' span: walls that meet in a corner differ by more than anything
     * counts. */
    constexpr double least_corner_jump = 1e-3;

  } // namespace

  /** How deep solid and liquid are at their deepest (m). */
  std::array<double, 2> CutRun::depths(const State &of) const
  {
    double lowest = 0, highest = 0;
    for(std::size_t cell = 0; cell < of.mesh->cells.size(); ++cell)
      if(of.geometry->location[cell] != Location::outside)
        for(const unsigned int dof : of.mesh->cells[cell].level_set_dofs)
        {
          lowest = std::min(lowest, of.level_set[dof]);
          highest = std::max(highest, of.level_set[dof]);
        }
    return {-lowest, highest};
  }

  void CutRun::require_resolved() const
  {
    const double spacing = state.mesh->spacing, least = least_depth * spacing;
    const auto [solid, liquid] = depths(state);
    if(!(solid >= least && liquid >= least))
      throw cases::Refusal(fmt::format(
          "fem-cut does not resolve the front at the start: solid is {:.3g} m deep and "
          "liquid {:.3g} m, with cells of {:.3g} m; {} cells are needed",
          solid, liquid, spacing, least_depth));
  }

  CutRun::VertexValue CutRun::at_vertex(const State &of, unsigned int number,
                                        unsigned int vertex) const
  {
    const Cell &cell = of.mesh->cells[number];
    Point point = of.mesh->positions[cell.dofs[vertex]];
    if(const double radius = point.norm(); scene.domain.round() && radius > 0)
      point
          *= std::clamp(radius, scene.domain.inner_radius, scene.domain.radius) / radius;
    const bool solid = of.level_set[cell.level_set_dofs[vertex]] < 0;
    return {point, solid,
            heat.temperature(of, solid ? Phase::solid : Phase::liquid, number,
                             cell.unit(point))};
  }

  /** Call `visit(vertex)` for each vertex of the cells inside the domain, and of those
   * that its rim cuts if @p rim. */
  template <typename Visit>
  void CutRun::visit_vertices(const State &of, const bool rim, const Visit &visit) const
  {
    for(unsigned int number = 0; number < of.mesh->cells.size(); ++number)
      if(of.mesh->place[number] == Place::inside
         || (rim && of.mesh->place[number] == Place::on_rim))
        for(unsigned int vertex = 0; vertex < 1u << dim; ++vertex)
          visit(at_vertex(of, number, vertex));
  }

  /** By how much temperatures are beyond what bounds them, and phases beyond the melting
   * temperature (K). */
  double CutRun::overshoot(const State &of) const
  {
    const double melting = scene.material.melting_temperature;
    const bool stable = !cases::metastable_initial_phase(scene);
    double most = 0;
    visit_vertices(of, false,
                   [&](const VertexValue &vertex)
                   {
                     const double value = vertex.temperature;
                     most = std::max({most, bounds.lower - value, value - bounds.upper});
                     if(stable)
                       most = std::max(most,
                                       vertex.solid ? value - melting : melting - value);
                   });
    return most;
  }

  double CutRun::tolerated_overshoot() const
  {
    double lowest = scene.material.melting_temperature, highest = lowest;
    visit_vertices(state, false,
                   [&](const VertexValue &vertex)
                   {
                     lowest = std::min(lowest, vertex.temperature);
                     highest = std::max(highest, vertex.temperature);
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

  /** By how much held temperatures differ where two walls of a box meet (K). */
  double CutRun::corner_jump(double time) const
  {
    using cases::Side;
    const auto held = [&](Side side)
    { return scene.boundary(side).kind == cases::BoundaryKind::fixed_temperature; };
    double most = 0;
    if(scene.domain.round())
      return most;
    for(const Side x : {Side::x_min, Side::x_max})
      for(const Side y : {Side::y_min, Side::y_max})
        if(held(x) && held(y))
        {
          const cases::Position corner{
              (x == Side::x_min ? scene.domain.lower : scene.domain.upper)[0],
              (y == Side::y_min ? scene.domain.lower : scene.domain.upper)[1], 0};
          most = std::max(most, std::abs(scene.boundary(x).value(corner, time)
                                         - scene.boundary(y).value(corner, time)));
        }
    return most;
  }

  /** Whether the last of a phase is too small for the cells, in words; else empty. */
  std::string CutRun::why_last_body_is_lost(const State &checked) const
  {
    const auto [solid, liquid] = depths(checked);
    const double least = least_depth * checked.mesh->spacing;
    if(!checked.geometry->has(Phase::solid) || !checked.geometry->has(Phase::liquid)
       || !(std::min(solid, liquid) < least))
      return {};
    return fmt::format("the last {} is {:.2g} cells deep, and what is left of a phase is "
                       "not resolved below {:.2g}",
                       solid < liquid ? "solid" : "liquid",
                       std::min(solid, liquid) / checked.mesh->spacing, least_depth);
  }

  /** What of the method explains temperatures beyond the bounds, empty if nothing does.
   */
  std::string CutRun::why_beyond_bounds(const State &checked) const
  {
    if(wall_jump > 0)
      return fmt::format("what a wall gives jumped by what is worth {:.3g} K, and "
                         "temperatures overshoot while its layer is thinner than a cell: "
                         "let it change in some time, or take other cells",
                         wall_jump);
    const double corner = corner_jump(checked.time);
    if(corner > least_corner_jump * (bounds.upper - bounds.lower))
      return fmt::format("walls are held weakly, and beside a corner where two differ by "
                         "{:.3g} K temperatures overshoot",
                         corner);
    return why_last_body_is_lost(checked);
  }

  void CutRun::check(const State &checked) const
  {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    // The judge of snapshots sees the rim, too, and does not know of the jump.
    visit_vertices(checked, wall_jump > 0,
                   [&](const VertexValue &vertex)
                   {
                     // A comparison passes over what is not a number.
                     if(!std::isfinite(vertex.temperature))
                       lowest = highest = vertex.temperature;
                     lowest = std::min(lowest, vertex.temperature);
                     highest = std::max(highest, vertex.temperature);
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
      const std::string reason = why_beyond_bounds(checked);
      if(reason.empty() || !std::isfinite(lowest))
        throw;
      throw cases::Refusal(fmt::format("{}; {}", error.what(), reason));
    }
    for(const Point &place : heat.sinks.places)
      if(!heat.in_solid(checked, place))
        throw cases::Refusal(fmt::format(
            "fem-cut: the source at ({:.6g}, {:.6g}) does not lie in the solid, at least "
            "a cell from the front, at time {:.6g}",
            place[0], place[1], checked.time));
  }
} // namespace meltfront::reference_fem::cut
