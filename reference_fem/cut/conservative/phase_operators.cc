#include <reference_fem/cut/conservative/phase_context.h>

#include <cases/time_integral.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Of edges of the parts of a cut triangle: where what is released jumps at the front
     * of an exact solution, a jump is not at the front found. */
    constexpr int divisions_of_released = 4;

    /** Spacings from a front within which triangles beside a wall have no parabola: where
     * a front meets a wall a phase is a wedge of a few nodes, which tell none. */
    constexpr double contact_width = 2.5;
  } // namespace

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
    , inside(mesh.nodes.size(), false)
    , beside_wall(mesh.nodes.size(), false)
  {
    for(std::size_t square = 0; square < mesh.squares.size(); ++square)
      inner_square[square]
          = mesh.triangles[2 * square].whole && mesh.triangles[2 * square + 1].whole;
    for(const WallPiece &wall : mesh.walls)
    {
      inner_square[wall.triangle / 2] = false;
      for(const unsigned int node : mesh.triangles[wall.triangle].nodes)
        beside_wall[node] = true;
    }
    for(const Triangle &triangle : mesh.triangles)
      if(triangle.whole)
        for(const unsigned int node : triangle.nodes)
          inside[node] = true;
    const auto &corners = mesh.squares.front();
    const Gradient size = mesh.nodes[corners[3]] - mesh.nodes[corners[0]];
    for(unsigned int open = 0; open < 16; ++open)
      square_elements.emplace_back(size,
                                   std::array<bool, 4>{(open & 1) != 0, (open & 2) != 0,
                                                       (open & 4) != 0, (open & 8) != 0});
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
                                         const Guess &guess, bool follow)
  {
    PhaseOperators result(mesh.nodes.size());
    Context context{phase,
                    frame,
                    front,
                    stage,
                    guess,
                    follow,
                    properties(phase),
                    phase == Phase::solid && !stage.powers.empty(),
                    result,
                    std::vector<char>(mesh.squares.size(), false),
                    {}};
    for(unsigned int square = 0; square < mesh.squares.size(); ++square)
      context.squares[square]
          = inner_square[square]
            && front.location[2 * square] == front.location[2 * square + 1]
            && front.location[2 * square] != Location::cut
            && CutGeometry::is(front.location[2 * square], phase);
    mark_parted(phase, front);
    context.curvatures = curvatures(context);
    add_bulk(context);
    if(scene.volumetric_source)
      meters.released.measure([&] { add_released(context); });
    add_ghost_penalty(context);
    if(frame.has_front())
      meters.front.measure([&] { add_front(context); });
    add_walls(context);
    return result;
  }

  void PhaseAssembly::mark_parted(Phase phase, const Front &front)
  {
    std::vector<char> &parted = was_parted[index(phase)];
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
      if(!mesh.triangles[t].whole || !CutGeometry::is(front.location[t], phase))
        parted[t] = true;
  }

  bool PhaseAssembly::has_ghost_penalty(const Context &context,
                                        const InnerEdge &edge) const
  {
    const auto [first, second] = edge.triangles;
    const std::vector<char> &active = context.frame.active[index(context.phase)],
                            &parted = was_parted[index(context.phase)];
    return active[first] && active[second] && (parted[first] || parted[second]);
  }

  /** Gauss' two points of every piece of the front that the guess is of: the mean of a
   * chord's distance from the front that it stands for is nothing. */
  std::vector<FrontSample> PhaseAssembly::front_samples(Phase phase,
                                                        const Guess &guess) const
  {
    static const double place = (1 - 1 / std::sqrt(3.)) / 2;
    const bool singular = phase == Phase::solid && !guess.powers.empty();
    std::vector<FrontSample> result;
    for(const Segment &segment : guess.front)
      for(const double along : {place, 1 - place})
      {
        const Point point = segment.begin + along * (segment.end - segment.begin);
        result.push_back({mesh.squares[mesh.triangle_at(point) / 2][0], point,
                          singular ? -sources.value(point, guess.powers) : 0,
                          segment.length() / (2 * mesh.spacing)});
      }
    std::ranges::stable_sort(result, {}, &FrontSample::node);
    return result;
  }

  CurvatureFit PhaseAssembly::curvature_fit(Phase phase, const Guess &guess) const
  {
    return {mesh, inside, phase, guess, front_samples(phase, guess)};
  }

  /** Of triangles that hold a part of the phase and are not halves of a SquareElement,
   * and of those beside faces with a ghost penalty. */
  std::vector<Curvature> PhaseAssembly::curvatures(const Context &context) const
  {
    std::vector<Curvature> result(mesh.triangles.size());
    if(context.guess.level_set.empty())
      return result;
    std::vector<char> needed(mesh.triangles.size());
    for(unsigned int t = 0; t < needed.size(); ++t)
      needed[t]
          = !context.squares[t / 2] && !context.front.part(t, context.phase).empty();
    for(const InnerEdge &edge : mesh.inner_edges)
      if(has_ghost_penalty(context, edge))
        for(const unsigned int t : edge.triangles)
          needed[t] = true;
    CurvatureFit fit = curvature_fit(context.phase, context.guess);
    for(unsigned int t = 0; t < needed.size(); ++t)
      if(needed[t] && !at_contact(context.frame, mesh.triangles[t]))
        result[t] = fit(mesh.triangles[t]);
    return result;
  }

  bool PhaseAssembly::at_contact(const StepFrame &frame, const Triangle &triangle) const
  {
    return std::ranges::any_of(triangle.nodes,
                               [&](unsigned int node) { return beside_wall[node]; })
           && std::ranges::any_of(triangle.nodes,
                                  [&](unsigned int node) {
                                    return std::abs(frame.level_set[node])
                                           < contact_width * mesh.spacing;
                                  });
  }

  Remainder PhaseAssembly::remainder(const Context &context, unsigned int triangle) const
  {
    return {context.curvatures[triangle], mesh.triangles[triangle], mesh.nodes};
  }

  void PhaseAssembly::add_bulk(const Context &context) const
  {
    for(unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      if(context.front.part(t, context.phase).empty())
        continue;
      if(!context.frame.active[index(context.phase)][t])
        throw std::runtime_error("the front has moved beyond where temperatures are");
      if(context.singular)
        add_singular_heat(context, t);
      if(!context.squares[t / 2])
        add_triangle(context, t);
    }
    for(unsigned int square = 0; square < mesh.squares.size(); ++square)
      if(context.squares[square])
        add_square(context, square);
  }

  /** Heat that the singular part of sources stands for. */
  void PhaseAssembly::add_singular_heat(const Context &context, unsigned int t) const
  {
    const Triangle &triangle = mesh.triangles[t];
    const double capacity = context.material.volumetric_heat_capacity();
    integrate(context.front.part(t, context.phase),
              [&](const Point &point, double weight)
              {
                const double heat
                    = capacity * weight * sources.value(point, context.stage.powers);
                for(std::size_t i = 0; i < 3; ++i)
                  context.result.mass.constant[triangle.nodes[i]]
                      += heat * triangle.hat(static_cast<int>(i), point);
              });
  }

  void PhaseAssembly::add_triangle(const Context &context, unsigned int t) const
  {
    const Triangle &triangle = mesh.triangles[t];
    const Remainder bend = remainder(context, t);
    const double capacity = context.material.volumetric_heat_capacity(),
                 conductivity = context.material.conductivity;
    PhaseOperators &result = context.result;
    std::array<std::array<double, 3>, 3> mass{};
    double area = 0;
    integrate(context.front.part(t, context.phase),
              [&](const Point &point, double weight)
              {
                area += weight;
                const double heat = capacity * weight;
                const Gradient flux = conductivity * weight * bend.gradient(point);
                std::array<double, 3> hat;
                for(std::size_t i = 0; i < 3; ++i)
                {
                  hat[i] = triangle.hat(static_cast<int>(i), point);
                  result.mass.constant[triangle.nodes[i]]
                      += heat * hat[i] * bend.value(point);
                  result.interior.constant[triangle.nodes[i]]
                      -= flux * triangle.gradients[i];
                }
                for(std::size_t i = 0; i < 3; ++i)
                  for(std::size_t j = 0; j < 3; ++j)
                    mass[i][j] += heat * hat[i] * hat[j];
              });
    for(std::size_t i = 0; i < 3; ++i)
      for(std::size_t j = 0; j < 3; ++j)
      {
        const int column = context.unknown(triangle.nodes[j]);
        result.mass.add(triangle.nodes[i], column, mass[i][j]);
        result.interior.add(triangle.nodes[i], column,
                            -conductivity * area
                                * (triangle.gradients[i] * triangle.gradients[j]));
      }
  }

  /** Of a square that is a SquareElement, sides beyond which there is none, bit by bit.
   */
  unsigned int PhaseAssembly::open_sides(const Context &context,
                                         unsigned int square) const
  {
    // No square beside the edge of the mesh is one of them.
    const unsigned int columns = mesh.squares[0][2] - 1;
    const std::array<unsigned int, 4> beside{square - 1, square + 1, square - columns,
                                             square + columns};
    unsigned int open = 0;
    for(unsigned int side = 0; side < 4; ++side)
      if(!context.squares[beside[side]])
        open |= 1u << side;
    return open;
  }

  /** The mean of the five-point formula at a square's corners (K/m^2). */
  double PhaseAssembly::laplacian(unsigned int square, const Values &values) const
  {
    const std::array<unsigned int, 4> &nodes = mesh.squares[square];
    const Gradient size = mesh.nodes[nodes[3]] - mesh.nodes[nodes[0]];
    const unsigned int row = mesh.squares[0][2];
    double result = 0;
    for(const unsigned int node : nodes)
      result += (values[node - 1] - 2 * values[node] + values[node + 1])
                    / (size[0] * size[0])
                + (values[node - row] - 2 * values[node] + values[node + row])
                      / (size[1] * size[1]);
    return result / 4;
  }

  void PhaseAssembly::add_square(const Context &context, unsigned int square) const
  {
    const unsigned int open = open_sides(context, square);
    const SquareElement &element = square_elements[open];
    const std::array<unsigned int, 4> &nodes = mesh.squares[square];
    const double capacity = context.material.volumetric_heat_capacity();
    if(!context.guess.level_set.empty())
    {
      const double taken = context.material.conductivity * element.bubble
                           * (open == 0 ? laplacian(square, context.guessed())
                                        : (context.curvatures[2 * square].trace()
                                           + context.curvatures[2 * square + 1].trace())
                                              / 2);
      for(std::size_t i = 0; i < 4; ++i)
        context.result.interior.constant[nodes[i]] += i == 0 || i == 3 ? taken : -taken;
    }
    for(std::size_t i = 0; i < 4; ++i)
      for(std::size_t j = 0; j < 4; ++j)
      {
        const int column = context.unknown(nodes[j]);
        context.result.mass.add(nodes[i], column, capacity * element.mass[i][j]);
        context.result.interior.add(
            nodes[i], column, -context.material.conductivity * element.conduction[i][j]);
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
    for(const InnerEdge &edge : mesh.inner_edges)
    {
      if(!has_ghost_penalty(context, edge))
        continue;
      const auto [first, second] = edge.triangles;
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
      const Point middle
          = (mesh.triangles[first].centre + mesh.triangles[second].centre) / 2;
      const double missed = (remainder(context, first).gradient(middle)
                             - remainder(context, second).gradient(middle))
                            * edge.normal;
      for(std::size_t i = 0; i < 6; ++i)
      {
        context.result.interior.constant[nodes[i]] -= weight * jump[i] * missed;
        for(std::size_t j = 0; j < 6; ++j)
          context.result.interior.add(nodes[i], context.unknown(nodes[j]),
                                      -weight * jump[i] * jump[j]);
      }
    }
  }
} // namespace meltfront::reference_fem::cut::conservative
