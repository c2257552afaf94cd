#include <reference_fem/cut/conservative/phase_operators.h>

#include <cases/time_integral.h>
#include <cases/wall_law.h>

#include <cmath>
#include <stdexcept>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Of edges of the parts of a cut triangle: where what is released jumps at the front
     * of an exact solution, a jump is not at the front found. */
    constexpr int divisions_of_released = 4;

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

  struct PhaseAssembly::Context
  {
    Phase phase;
    const StepFrame &frame;
    const Front &front;
    const StageTime &stage;
    const Temperatures &guess;
    bool follow;
    const cases::PhaseProperties &material;
    bool singular; ///< the unknown lacks the singular part of sources
    PhaseOperators &result;

    int unknown(unsigned int node) const
    {
      return frame.temperature[index(phase)][node];
    }
  };

  PhaseOperators::PhaseOperators(std::size_t nodes)
    : mass(nodes)
    , interior(nodes)
    , wall(nodes)
    , front(nodes)
    , source_flux(nodes)
  {
  }

  PhaseAssembly::PhaseAssembly(const cases::Scene &scene, const TriangleMesh &mesh,
                               const LineSources &sources, const Constants &constants)
    : scene(scene)
    , mesh(mesh)
    , sources(sources)
    , constants(constants)
    , inner_square(mesh.squares.size())
  {
    for(std::size_t square = 0; square < mesh.squares.size(); ++square)
      inner_square[square]
          = mesh.triangles[2 * square].whole && mesh.triangles[2 * square + 1].whole;
    for(const WallPiece &wall : mesh.walls)
      inner_square[wall.triangle / 2] = false;
    forget_stage();
  }

  void PhaseAssembly::forget_stage()
  {
    was_parted.fill(std::vector<char>(mesh.triangles.size(), false));
    if(!scene.volumetric_source)
      return;
    released.resize(mesh.triangles.size());
    released_known.assign(mesh.triangles.size(), false);
  }

  const cases::PhaseProperties &PhaseAssembly::properties(Phase phase) const
  {
    return phase == Phase::solid ? scene.material.solid : scene.material.liquid;
  }

  double PhaseAssembly::temperature(Phase phase, unsigned int triangle,
                                    const Point &point, const Temperatures &temperatures,
                                    const std::vector<double> &powers) const
  {
    const double value
        = mesh.triangles[triangle].value(temperatures[index(phase)], point);
    return phase == Phase::solid && !powers.empty() ? value + sources.value(point, powers)
                                                    : value;
  }

  PhaseOperators PhaseAssembly::assemble(Phase phase, const StepFrame &frame,
                                         const Front &front, const StageTime &stage,
                                         const Temperatures &guess, bool follow)
  {
    PhaseOperators result(mesh.nodes.size());
    const Context context{phase,
                          frame,
                          front,
                          stage,
                          guess,
                          follow,
                          properties(phase),
                          phase == Phase::solid && !stage.powers.empty(),
                          result};
    add_bulk(context);
    if(scene.volumetric_source)
      meters.released.measure([&] { add_released(context); });
    add_ghost_penalty(context);
    if(frame.has_front())
      meters.front.measure([&] { add_front(context); });
    add_walls(context);
    return result;
  }

  void PhaseAssembly::add_bulk(const Context &context) const
  {
    const double capacity = context.material.volumetric_heat_capacity();
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      const Polygon &part = context.front.part(t, context.phase);
      if(part.empty())
        continue;
      if(!context.frame.active[index(context.phase)][t])
        throw std::runtime_error("the front has moved beyond where temperatures are");
      const Triangle &triangle = mesh.triangles[t];
      std::array<std::array<double, 3>, 3> mass{};
      double area = 0;
      integrate(part,
                [&](const Point &point, double weight)
                {
                  area += weight;
                  std::array<double, 3> hat;
                  for(int i = 0; i < 3; ++i)
                    hat[static_cast<std::size_t>(i)] = triangle.hat(i, point);
                  for(std::size_t i = 0; i < 3; ++i)
                    for(std::size_t j = 0; j < 3; ++j)
                      mass[i][j] += capacity * weight * hat[i] * hat[j];
                  if(!context.singular)
                    return;
                  const double offset
                      = capacity * weight * sources.value(point, context.stage.powers);
                  for(std::size_t i = 0; i < 3; ++i)
                    context.result.mass.constant[triangle.nodes[i]] += offset * hat[i];
                });
      // The other half of a square that conducts as a whole adds nothing.
      const double conduction
          = conducts_as_square(context, t / 2) ? 0 : context.material.conductivity * area;
      for(std::size_t i = 0; i < 3; ++i)
        for(std::size_t j = 0; j < 3; ++j)
        {
          const int column = context.unknown(triangle.nodes[j]);
          context.result.mass.add(triangle.nodes[i], column, mass[i][j]);
          if(conduction > 0)
            context.result.interior.add(
                triangle.nodes[i], column,
                -conduction * (triangle.gradients[i] * triangle.gradients[j]));
        }
    }
    for(unsigned int square = 0; square < mesh.squares.size(); ++square)
      if(conducts_as_square(context, square))
        add_square(context, mesh.squares[square]);
  }

  bool PhaseAssembly::conducts_as_square(const Context &context,
                                         unsigned int square) const
  {
    const auto &location = context.front.location;
    return inner_square[square] && location[2 * square] == location[2 * square + 1]
           && CutGeometry::is(location[2 * square], context.phase)
           && location[2 * square] != Location::cut;
  }

  void PhaseAssembly::add_square(const Context &context,
                                 const std::array<unsigned int, 4> &nodes) const
  {
    const Gradient diagonal = mesh.nodes[nodes[3]] - mesh.nodes[nodes[0]];
    const double slope = diagonal[1] / diagonal[0];
    // Of linear functions along a side: slopes, and values.
    const auto slopes = [](bool same) { return same ? 1. : -1.; };
    const auto values = [](bool same) { return same ? 1. / 3 : 1. / 6; };
    for(unsigned int i = 0; i < 4; ++i)
      for(unsigned int j = 0; j < 4; ++j)
      {
        const bool x = i % 2 == j % 2, y = i / 2 == j / 2;
        context.result.interior.add(
            nodes[i], context.unknown(nodes[j]),
            -context.material.conductivity
                * (slope * slopes(x) * values(y) + values(x) * slopes(y) / slope));
      }
  }

  void PhaseAssembly::add_released(const Context &context)
  {
    const cases::Field &density = *scene.volumetric_source;
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      const Polygon &part = context.front.part(t, context.phase);
      if(part.empty())
        continue;
      const Triangle &triangle = mesh.triangles[t];
      const bool cut = context.front.location[t] == Location::cut;
      std::array<double, 3> load{};
      if(!cut && released_known[t])
        load = released[t];
      else
        integrate(
            part,
            [&](const Point &point, double weight)
            {
              const double heat
                  = weight
                    * cases::value_at_end(density, position(point), context.stage.begin,
                                          context.stage.time);
              for(int i = 0; i < 3; ++i)
                load[static_cast<std::size_t>(i)] += heat * triangle.hat(i, point);
            },
            cut ? divisions_of_released : 1);
      if(!cut)
      {
        released[t] = load;
        released_known[t] = true;
      }
      for(std::size_t i = 0; i < 3; ++i)
        context.result.interior.constant[triangle.nodes[i]] += load[i];
    }
  }

  void PhaseAssembly::add_ghost_penalty(const Context &context)
  {
    const std::vector<char> &active = context.frame.active[index(context.phase)];
    std::vector<char> &parted = was_parted[index(context.phase)];
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      if(!mesh.triangles[t].whole
         || !CutGeometry::is(context.front.location[t], context.phase))
        parted[t] = true;
    for(const InnerEdge &edge : mesh.inner_edges)
    {
      const auto [first, second] = edge.triangles;
      if(!active[first] || !active[second] || !(parted[first] || parted[second]))
        continue;
      const double weight
          = constants.ghost * context.material.conductivity * mesh.spacing * edge.length;
      std::array<unsigned int, 6> nodes;
      std::array<double, 6> jump;
      for(std::size_t i = 0; i < 3; ++i)
      {
        nodes[i] = mesh.triangles[first].nodes[i];
        jump[i] = mesh.triangles[first].gradients[i] * edge.normal;
        nodes[i + 3] = mesh.triangles[second].nodes[i];
        jump[i + 3] = -(mesh.triangles[second].gradients[i] * edge.normal);
      }
      for(std::size_t i = 0; i < 6; ++i)
        for(std::size_t j = 0; j < 6; ++j)
          context.result.interior.add(nodes[i], context.unknown(nodes[j]),
                                      -weight * jump[i] * jump[j]);
    }
  }

  /** A point of Nitsche's condition unknown + offset = follow psi. */
  void PhaseAssembly::hold(const Context &context, const Triangle &triangle,
                           const Point &point, double weight, const Gradient &normal,
                           double offset, double follow, Operator &result) const
  {
    const double conductivity = context.material.conductivity,
                 penalty = constants.nitsche * conductivity / mesh.spacing;
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
      result.constant[node] += difference * offset;
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
      const Gradient regular = triangle.gradient(context.guess[index(context.phase)]);
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
                  hold(context, triangle, point, weight, sense * cut.normal, offset,
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

  void PhaseAssembly::add_wall(const Context &context, const WallPiece &wall,
                               const Segment &segment) const
  {
    const cases::Boundary &boundary = scene.boundary(wall.side);
    const Triangle &triangle = mesh.triangles[wall.triangle];
    const bool held = boundary.kind == cases::BoundaryKind::fixed_temperature;
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
      const double given = cases::value_at_end(boundary.value, position(point),
                                               context.stage.begin, context.stage.time);
      const double offset
          = context.singular ? sources.value(point, context.stage.powers) : 0;
      if(held)
        hold(context, triangle, point, weight, wall.normal,
             offset + scene.material.melting_temperature - given, 0, result);
      else
        add_exchange(context, boundary, triangle, point, weight, given, offset);
    };
    meters.walls[static_cast<std::size_t>(boundary.kind)].measure(
        [&]
        {
          // At nodes, where there are nodes: in the mean over a side a temperature that
          // jumps from wall to wall would be overshot beside the corner.
          if(held)
            integrate_at_ends(segment, at_point);
          else
            integrate(segment, at_point);
        });
  }

  /** Heat that a wall gives, or exchanges by its law about the guess. */
  void PhaseAssembly::add_exchange(const Context &context,
                                   const cases::Boundary &boundary,
                                   const Triangle &triangle, const Point &point,
                                   double weight, double given, double offset) const
  {
    double at_rest = given, coefficient = 0;
    if(cases::exchanges_heat(boundary.kind))
    {
      const double melting = scene.material.melting_temperature,
                   now = triangle.value(context.guess[index(context.phase)], point);
      const cases::HeatTransfer law
          = cases::heat_transfer_near(boundary, given, melting + offset + now);
      coefficient = law.coefficient;
      at_rest = coefficient * (law.ambient - melting - offset);
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
