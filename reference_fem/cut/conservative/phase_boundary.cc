#include <reference_fem/cut/conservative/phase_context.h>

#include <cases/time_integral.h>
#include <cases/wall_law.h>

#include <algorithm>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** What of a segment lies in a phase: nothing or one piece. */
    std::vector<Segment> parts(const Segment &segment, const LinearFunction &level_set,
                               Phase phase)
    {
      const double begin = level_set(segment.begin), end = level_set(segment.end);
      const bool begins = (begin < 0) == (phase == Phase::solid),
                 ends = (end < 0) == (phase == Phase::solid);
      if(begins && ends)
        return {segment};
      if(!begins && !ends)
        return {};
      const Point zero
          = segment.begin + begin / (begin - end) * (segment.end - segment.begin);
      return {begins ? Segment{segment.begin, zero} : Segment{zero, segment.end}};
    }
  } // namespace

  /** A point of Nitsche's condition unknown + offset = follow psi. */
  void PhaseAssembly::hold(const Context &context, unsigned int number,
                           const Point &point, double weight, const Gradient &normal,
                           double offset, double follow, Operator &result) const
  {
    const double conductivity = context.material.conductivity,
                 penalty = constants.nitsche * conductivity / mesh.spacing;
    const Triangle &triangle = mesh.triangles[number];
    const Remainder bend = remainder(context, number);
    const double known = offset + bend.value(point),
                 known_flux = conductivity * (bend.gradient(point) * normal);
    std::array<double, 3> hat, flux;
    for(std::size_t i = 0; i < 3; ++i)
    {
      hat[i] = triangle.hat(static_cast<int>(i), point);
      flux[i] = conductivity * (triangle.gradients[i] * normal);
    }
    for(std::size_t i = 0; i < 3; ++i)
    {
      const unsigned int node = triangle.nodes[i];
      const double difference = weight * (flux[i] - penalty * hat[i]);
      result.constant[node] += difference * known + weight * hat[i] * known_flux;
      for(std::size_t j = 0; j < 3; ++j)
      {
        const unsigned int other = triangle.nodes[j];
        result.add(node, context.unknown(other),
                   weight * hat[i] * flux[j] + difference * hat[j]);
        if(follow != 0)
          result.add(node, context.frame.displacement[other],
                     -difference * follow * hat[j]);
      }
    }
  }

  /** Call visit(point, weight, flux) with what sources' singular part carries along a
   * normal (W/m^2); the sum is the angle's, to round-off. */
  template <typename Visit>
  void PhaseAssembly::visit_source_flux(const Context &context, const Segment &segment,
                                        const Gradient &normal, const Visit &visit) const
  {
    const double length = segment.length();
    if(!(length > 0))
      return;
    const auto at = [&](const Point &point)
    {
      return context.material.conductivity
             * (sources.gradient(point, context.stage.powers) * normal);
    };
    double missing = sources.flux(segment, normal, context.stage.powers);
    integrate(segment,
              [&](const Point &point, double weight) { missing -= weight * at(point); });
    integrate(segment, [&](const Point &point, double weight)
              { visit(point, weight, at(point) + missing / length); });
  }

  void PhaseAssembly::add_front(const Context &context) const
  {
    const double sense = context.phase == Phase::solid ? 1 : -1;
    for(const CutTriangle &cut : context.front.cut)
    {
      if(!cut.crossed)
        continue;
      const Triangle &triangle = mesh.triangles[cut.triangle];
      const Gradient regular = triangle.gradient(context.guessed());
      integrate(cut.segment,
                [&](const Point &point, double weight)
                {
                  double offset = 0, follow = 0;
                  Gradient gradient = regular;
                  if(context.singular)
                  {
                    offset = sources.value(point, context.stage.powers);
                    gradient += sources.gradient(point, context.stage.powers);
                  }
                  if(context.follow)
                    follow = cut.level_set.gradient * gradient
                             / cut.level_set.gradient.norm_square();
                  hold(context, cut.triangle, point, weight, sense * cut.normal, offset,
                       follow, context.result.front);
                });
      if(context.singular)
        meters.sources.measure([&] { add_source_flux(context, cut); });
    }
  }

  void PhaseAssembly::add_source_flux(const Context &context,
                                      const CutTriangle &cut) const
  {
    visit_source_flux(context, cut.segment, cut.normal,
                      [&](const Point &point, double weight, double flux)
                      {
                        for(std::size_t i = 0; i < 3; ++i)
                          context.result.source_flux[cut.place->nodes[i]]
                              += weight * flux
                                 * cut.place->hat(static_cast<int>(i), point);
                      });
  }

  void PhaseAssembly::add_walls(const Context &context) const
  {
    for(const WallPiece &wall : mesh.walls)
    {
      const Location location = context.front.location[wall.triangle];
      if(CutGeometry::is(location, context.phase))
        add_wall(context, wall, wall.segment);
      else if(location == Location::cut)
        for(const Segment &part :
            parts(wall.segment, context.front.cut_at(wall.triangle).level_set,
                  context.phase))
          add_wall(context, wall, part);
    }
  }

  /** Whether a place is within two cells of a corner of walls that both hold
   * temperatures. */
  bool PhaseAssembly::beside_held_corner(const Point &point) const
  {
    if(scene.domain.round())
      return false;
    constexpr double reach = 2;
    constexpr std::array<std::array<cases::Side, 2>, 2> sides{
        {{cases::Side::x_min, cases::Side::x_max},
         {cases::Side::y_min, cases::Side::y_max}}};
    for(int axis = 0; axis < 2; ++axis)
    {
      const double below = point[axis] - scene.domain.lower[axis],
                   above = scene.domain.upper[axis] - point[axis];
      if(std::min(below, above) > reach * mesh.spacing
         || scene.boundary(sides[axis][below < above ? 0 : 1]).kind
                != cases::BoundaryKind::fixed_temperature)
        return false;
    }
    return true;
  }

  void PhaseAssembly::add_wall(const Context &context, const WallPiece &wall,
                               const Segment &segment) const
  {
    const cases::Boundary &boundary = scene.boundary(wall.side);
    const Triangle &triangle = mesh.triangles[wall.triangle];
    // Beside a corner of a cold and a warm wall the front's foot is at the wall's own
    // datum of the other phase: either sets out from its jump, not from what is held.
    const bool held = boundary.kind == cases::BoundaryKind::fixed_temperature,
               at_foot = held && context.front.location[wall.triangle] == Location::cut
                         && beside_held_corner(segment.begin);
    const double melting = scene.material.melting_temperature;
    Operator &result = context.result.wall;
    if(context.singular)
    {
      context.result.source_wall_power
          += sources.flux(segment, wall.normal, context.stage.powers);
      // Where a wall gives the heat, what the singular part carries is not the unknown's.
      if(!held)
        visit_source_flux(context, segment, wall.normal,
                          [&](const Point &point, double weight, double flux)
                          {
                            for(std::size_t i = 0; i < 3; ++i)
                              result.constant[triangle.nodes[i]]
                                  -= weight * flux
                                     * triangle.hat(static_cast<int>(i), point);
                          });
    }
    if(!held && !cases::prescribes_heat(boundary.kind))
      return;
    const auto at_point = [&](const Point &point, double weight)
    {
      double given = cases::value_at_end(boundary.value, position(point),
                                         context.stage.begin, context.stage.time);
      if(at_foot)
        given = context.phase == Phase::solid ? std::min(given, melting)
                                              : std::max(given, melting);
      const double offset
          = context.singular ? sources.value(point, context.stage.powers) : 0;
      if(held)
        hold(context, wall.triangle, point, weight, wall.normal, offset + melting - given,
             0, result);
      else
        add_exchange(context, boundary, wall.triangle, point, wall.share * weight, given,
                     offset);
    };
    meters.walls[static_cast<std::size_t>(boundary.kind)].measure(
        [&]
        {
          // At nodes, where there are nodes: in the mean over a side a temperature that
          // jumps from wall to wall would be overshot beside the corner. Of a rim the
          // ends of chords alone are not on the circle that the polygon stands for.
          if(held && !scene.domain.round())
            integrate_at_ends(segment, at_point);
          else
            integrate(segment, at_point);
        });
  }

  /** Heat that a wall gives, or exchanges by its law about the guess. */
  void PhaseAssembly::add_exchange(const Context &context,
                                   const cases::Boundary &boundary, unsigned int number,
                                   const Point &point, double weight, double given,
                                   double offset) const
  {
    const Triangle &triangle = mesh.triangles[number];
    double at_rest = given, coefficient = 0;
    if(cases::exchanges_heat(boundary.kind))
    {
      const double melting = scene.material.melting_temperature,
                   known = offset + remainder(context, number).value(point),
                   now = triangle.value(context.guessed(), point);
      const cases::HeatTransfer law
          = cases::heat_transfer_near(boundary, given, melting + known + now);
      coefficient = law.coefficient;
      at_rest = coefficient * (law.ambient - melting - known);
    }
    Operator &result = context.result.wall;
    for(std::size_t i = 0; i < 3; ++i)
    {
      const double share = weight * triangle.hat(static_cast<int>(i), point);
      result.constant[triangle.nodes[i]] += share * at_rest;
      if(coefficient != 0)
        for(std::size_t j = 0; j < 3; ++j)
          result.add(triangle.nodes[i], context.unknown(triangle.nodes[j]),
                     -share * coefficient * triangle.hat(static_cast<int>(j), point));
    }
  }
} // namespace meltfront::reference_fem::cut::conservative
