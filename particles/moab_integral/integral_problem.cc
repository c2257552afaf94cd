#include <cases/stopwatch.h>
#include <particles/moab_integral/integral_problem.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    using cases::BoundaryKind;

    IntegralWalls describe_walls(const cases::Scene &scene, const NodeSet &nodes)
    {
      IntegralWalls walls;
      for(std::size_t d = 0; d < 2; ++d)
      {
        walls.lower[d] = scene.domain.lower[d];
        walls.upper[d] = scene.domain.upper[d];
      }
      walls.fixed.assign(nodes.size(), 0);
      walls.flux_sides.assign(nodes.size(), 0);
      for(std::size_t i = 0; i < nodes.size(); ++i)
        if(nodes.sides[i] != 0)
        {
          if(wall_condition(scene, nodes, i).fixed)
            walls.fixed[i] = 1;
          else
            walls.flux_sides[i] = nodes.sides[i];
        }
      return walls;
    }
  } // namespace

  IntegralProblem::IntegralProblem(const cases::Scene &scene, const NodeSet &nodes,
                                   const IntegralParameters &parameters)
    : scene(scene)
    , given(scene)
    , nodes(nodes)
    , parameters(parameters)
  {
    const IntegralWalls walls = describe_walls(scene, nodes);
    rows = integral_rows(nodes, walls, parameters);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(walls.fixed[i] != 0)
        fixed.emplace_back(static_cast<std::uint32_t>(i),
                           wall_condition(scene, nodes, i).walls[0]);
    assemble();
    problem.source = [this](const LinearStep &step, std::span<double> source)
    { evaluate_sources(step, source); };
  }

  void IntegralProblem::assemble()
  {
    const double conductivity = scene.material.solid.conductivity;
    const double capacity = scene.material.solid.volumetric_heat_capacity();
    std::vector<std::uint32_t> columns, scratch;
    std::vector<double> coefficients;
    std::size_t next_fixed = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      columns.clear();
      coefficients.clear();
      if(next_fixed < fixed.size() && fixed[next_fixed].first == i)
      {
        columns.push_back(static_cast<std::uint32_t>(i));
        coefficients.push_back(-1);
        ++next_fixed;
      }
      const CompressedRows &laplacian = rows.laplacian;
      for(std::size_t e = laplacian.offsets[i]; e < laplacian.offsets[i + 1]; ++e)
      {
        columns.push_back(laplacian.columns[e]);
        coefficients.push_back(conductivity * laplacian.coefficients[e]);
      }
      for(std::size_t e = rows.flux.offsets[i]; e < rows.flux.offsets[i + 1]; ++e)
      {
        const WallParticle &wall = rows.wall_particles[rows.flux.columns[e]];
        const cases::Boundary &boundary = scene.boundary(wall.side);
        if(boundary.kind != BoundaryKind::heat_transfer)
          continue;
        columns.push_back(wall.node);
        coefficients.push_back(-boundary.heat_transfer_coefficient
                               * rows.flux.coefficients[e]);
      }
      problem.operator_rows.add_row(columns, coefficients, scratch);
    }
    problem.mass = rows.load;
    for(double &coefficient : problem.mass.coefficients)
      coefficient *= capacity;
  }

  void IntegralProblem::evaluate_sources(const LinearStep &step, std::span<double> source)
  {
    ++evaluations;
    std::ranges::fill(source, 0.);
    if(scene.volumetric_source)
    {
      const cases::ScopedTimer timer(release_seconds);
      released.resize(nodes.size());
      for(std::size_t i = 0; i < nodes.size(); ++i)
        released[i] = given.release(nodes.point(i), step);
      rows.load.multiply(released, source, parameters.threads);
    }
    const cases::ScopedTimer timer(wall_seconds);
    add_wall_sources(step, source);
    for(const auto &[node, boundary] : fixed)
      source[node] = boundary->value(nodes.point(node), step.at);
  }

  void IntegralProblem::add_wall_sources(const LinearStep &step, std::span<double> source)
  {
    if(rows.wall_particles.empty())
      return;
    wall_flux.assign(rows.wall_particles.size(), 0);
    for(std::size_t w = 0; w < wall_flux.size(); ++w)
    {
      const WallParticle &wall = rows.wall_particles[w];
      const cases::Boundary &boundary = scene.boundary(wall.side);
      const cases::Position position = nodes.point(wall.node);
      if(boundary.kind == BoundaryKind::flux)
        wall_flux[w] = given.wall(boundary, position, step);
      else if(boundary.kind == BoundaryKind::heat_transfer)
        wall_flux[w]
            = boundary.heat_transfer_coefficient * given.wall(boundary, position, step);
    }
    from_walls.resize(source.size());
    rows.flux.multiply(wall_flux, from_walls, parameters.threads);
    for(std::size_t i = 0; i < source.size(); ++i)
      source[i] += from_walls[i];
  }

  std::vector<cases::Parameter> IntegralProblem::describe() const
  {
    return {
        {"kernel", kernel_name(parameters.kernel), ""},
        {"weights", weight_policy_names()[static_cast<std::size_t>(parameters.weights)],
         ""},
        {"constraint order", std::to_string(parameters.order), "1"},
        {"moments", parameters.sampled_moments ? "sums over particles" : "integrals", ""},
        {"dilation over spacing", fmt::format("{:.4g}", parameters.dilation), "1"},
        {"the same, largest",
         fmt::format("{:.4g}", rows.largest_dilation / nodes.spacing), "1"},
        {"supports enlarged", std::to_string(rows.enlarged), "1"},
        {"residual of constraints, largest", fmt::format("{:.2g}", rows.largest_residual),
         "1"},
        {"rows whose constraints contradict each other", std::to_string(rows.unmet),
         "1"}};
  }

  std::vector<cases::EffectCost>
  IntegralProblem::effect_costs(const cases::EffectSet &effects) const
  {
    using cases::Effect;
    std::vector<cases::EffectCost> costs;
    // One pass serves all walls: its time is shared evenly.
    const std::size_t flux_bytes
        = rows.flux.size() * (sizeof(double) + sizeof(std::uint32_t))
          + rows.wall_particles.size() * (sizeof(WallParticle) + sizeof(double));
    const std::pair<Effect, std::size_t> walls[]
        = {{Effect::wall_temperature, fixed.size() * sizeof(fixed[0])},
           {Effect::wall_flux, flux_bytes},
           {Effect::robin_wall, flux_bytes}};
    long kinds = 0;
    for(const auto &[effect, bytes] : walls)
      kinds += effects.contains(effect);
    for(const auto &[effect, bytes] : walls)
      if(effects.contains(effect))
        costs.push_back({effect, evaluations, static_cast<long>(bytes),
                         wall_seconds / double(kinds)});
    if(effects.contains(Effect::volumetric_source))
      costs.push_back({Effect::volumetric_source, evaluations,
                       static_cast<long>(released.size() * sizeof(double)),
                       release_seconds});
    return costs;
  }
} // namespace meltfront::particles
