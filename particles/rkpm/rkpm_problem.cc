#include <cases/error.h>
#include <cases/stopwatch.h>
#include <particles/rkpm/rkpm_problem.h>
#include <particles/rkpm/stability_symbol.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm
{
  RkpmProblem::RkpmProblem(const cases::Scene &scene, const NodeSet &nodes,
                           const RkpmParameters &parameters, const std::string &method,
                           int threads)
    : scene(scene)
    , given(scene)
    , nodes(nodes)
    , parameters(parameters)
    , method(method)
    , threads(threads)
  {
    if(!nodes.region.empty() && parameters.unknowns == Unknowns::reconstructed)
      throw cases::Refusal(fmt::format(
          "{} has one unknown for each node, from which temperatures on both sides of an "
          "inclusion's surface cannot be reconstructed alike; take unknowns = nodal",
          method));
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(nodes.sides[i] != 0)
      {
        wall_nodes.push_back(static_cast<std::uint32_t>(i));
        walls.push_back(wall_condition(scene, nodes, i));
      }
    if(nodes.region.empty())
      parts.push_back(make_part(Region::interface));
    else
    {
      const cases::ScopedTimer timer(inclusion_seconds);
      parts.push_back(make_part(Region::inside));
      parts.push_back(make_part(Region::outside));
    }
    symbol = checked_symbol();
    assemble();
    problem.source = [this](const LinearStep &step, std::span<double> source)
    { evaluate_sources(step, source); };
  }

  /** Of all nodes but those of one region. */
  RkpmProblem::Part RkpmProblem::make_part(Region excluded) const
  {
    Part part;
    part.positions.dimension = nodes.positions.dimension;
    part.row_of.assign(nodes.size(), -1);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(nodes.region.empty() || nodes.region[i] != excluded)
      {
        part.row_of[i] = static_cast<std::int32_t>(part.nodes.size());
        part.nodes.push_back(static_cast<std::uint32_t>(i));
        part.positions.add(nodes.point(i));
      }
    SupportSettings supports = parameters.supports;
    supports.spacing = nodes.spacing;
    try
    {
      part.weights = compute_weights(part.positions, part.positions, parameters.moments,
                                     supports, threads);
    }
    catch(const cases::InputError &error)
    {
      throw cases::Refusal(fmt::format("{}: {}", method, error.what()));
    }
    return part;
  }

  double RkpmProblem::mean_dilation() const
  {
    double sum = 0;
    std::size_t count = 0;
    for(const Part &part : parts)
      for(std::size_t row = 0; row < part.nodes.size(); ++row)
        if(nodes.sides[part.nodes[row]] == 0)
        {
          sum += part.weights.supports.dilation[row];
          ++count;
        }
    return count > 0 ? sum / double(count) : nodes.spacing;
  }

  double RkpmProblem::checked_symbol() const
  {
    const double alpha = parameters.supports.alpha;
    const double ratio = stability_ratio(parameters.moments, alpha);
    if(parameters.refuse_unstable && ratio < least_stable_ratio)
      require_stability(parameters.moments, alpha);
    return ratio;
  }

  void RkpmProblem::assemble()
  {
    std::size_t wall = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      const bool on_wall = nodes.sides[i] != 0;
      if(on_wall && walls[wall].fixed)
        add_wall(i, walls[wall]);
      else if(on_surface(i))
        add_surface(i);
      else if(on_wall)
        add_wall(i, walls[wall]);
      else
        add_equation(i);
      wall += on_wall;
    }
  }

  bool RkpmProblem::on_surface(std::size_t node) const
  {
    return !nodes.region.empty() && nodes.region[node] == Region::interface;
  }

  const RkpmProblem::Part &RkpmProblem::part_of(std::size_t node) const
  {
    const bool inside = !nodes.region.empty() && nodes.region[node] == Region::inside;
    return parts[inside ? 1 : 0];
  }

  double RkpmProblem::conductivity_of(std::size_t node) const
  {
    const bool inside = !nodes.region.empty() && nodes.region[node] == Region::inside;
    return inside ? scene.inclusion->conductivity : scene.material.solid.conductivity;
  }

  void RkpmProblem::collect(const Part &part, std::size_t node,
                            const RowCoefficients &coefficients)
  {
    const std::size_t first = row_columns.size();
    collect_row(part.weights, static_cast<std::size_t>(part.row_of[node]), coefficients,
                row_columns, row_values);
    for(std::size_t entry = first; entry < row_columns.size(); ++entry)
      row_columns[entry] = part.nodes[row_columns[entry]];
  }

  void RkpmProblem::finish_row(CompressedRows &rows)
  {
    rows.add_row(row_columns, row_values, scratch);
    row_columns.clear();
    row_values.clear();
  }

  void RkpmProblem::add_equation(std::size_t node)
  {
    const Part &part = part_of(node);
    const double capacity = scene.material.solid.volumetric_heat_capacity();
    collect(part, node, {0, {}, conductivity_of(node)});
    finish_row(problem.operator_rows);
    if(parameters.unknowns == Unknowns::reconstructed)
    {
      collect(part, node, {capacity, {}, 0});
      finish_row(problem.mass);
      collect(part, node, {1, {}, 0});
      finish_row(problem.reconstruction);
      return;
    }
    row_columns = {static_cast<std::uint32_t>(node)};
    row_values = {capacity};
    finish_row(problem.mass);
  }

  void RkpmProblem::add_wall(std::size_t node, const WallCondition &condition)
  {
    const Part &part = part_of(node);
    const bool reconstructed = parameters.unknowns == Unknowns::reconstructed;
    if(condition.fixed && !reconstructed)
    {
      row_columns = {static_cast<std::uint32_t>(node)};
      row_values = {-1};
    }
    else
    {
      RowCoefficients row;
      const double conductivity = conductivity_of(node);
      if(condition.fixed)
        row.value = -1;
      else if(parameters.flux_row_as_printed)
        row = {-condition.transfer, {}, -conductivity};
      else
      {
        row.value = -condition.transfer;
        for(int d = 0; d < 3; ++d)
          row.gradient[d] = -conductivity * condition.direction[d];
      }
      collect(part, node, row);
    }
    finish_row(problem.operator_rows);
    finish_row(problem.mass);
    if(!reconstructed)
      return;
    collect(part, node, {1, {}, 0});
    finish_row(problem.reconstruction);
  }

  cases::Position RkpmProblem::surface_normal(std::size_t node) const
  {
    const double step = 1e-4 * nodes.spacing;
    cases::Position normal{};
    double squared = 0;
    for(int d = 0; d < nodes.positions.dimension; ++d)
    {
      cases::Position before = nodes.point(node), behind = before;
      before[d] -= step;
      behind[d] += step;
      normal[d]
          = scene.inclusion->level_set(behind, 0) - scene.inclusion->level_set(before, 0);
      squared += normal[d] * normal[d];
    }
    for(double &component : normal)
      component /= std::sqrt(squared);
    return normal;
  }

  void RkpmProblem::add_surface(std::size_t node)
  {
    const cases::Position normal = surface_normal(node);
    const double outside = scene.material.solid.conductivity;
    const double inside = scene.inclusion->conductivity;
    RowCoefficients row;
    for(const auto &[part, factor] :
        {std::pair(&parts[0], outside), std::pair(&parts[1], -inside)})
    {
      for(int d = 0; d < 3; ++d)
        row.gradient[d] = factor * normal[d];
      collect(*part, node, row);
    }
    finish_row(problem.operator_rows);
    finish_row(problem.mass);
  }

  void RkpmProblem::evaluate_sources(const LinearStep &step, std::span<double> source)
  {
    ++evaluations;
    std::ranges::fill(source, 0.);
    if(scene.volumetric_source)
    {
      const cases::ScopedTimer timer(release_seconds);
      for(const std::uint32_t i : nodes.inner)
        if(!on_surface(i))
          source[i] = given.release(nodes.point(i), step);
    }
    const cases::ScopedTimer timer(wall_seconds);
    for(std::size_t w = 0; w < wall_nodes.size(); ++w)
      if(walls[w].fixed || !on_surface(wall_nodes[w]))
        source[wall_nodes[w]] = walls[w].value(nodes.point(wall_nodes[w]), step, given);
  }

  long RkpmProblem::work() const
  {
    std::size_t entries = 0;
    for(const Part &part : parts)
      entries += part.weights.supports.neighbours.size() * part.weights.weights.size();
    return static_cast<long>(entries);
  }

  std::vector<double> RkpmProblem::sampled_condition_numbers() const
  {
    constexpr std::size_t samples = 200;
    MomentEngine engine(parameters.moments);
    std::vector<double> result;
    for(const Part &part : parts)
    {
      const Supports &supports = part.weights.supports;
      const std::size_t stride = std::max<std::size_t>(1, supports.rows() / samples);
      for(std::size_t row = 0; row < supports.rows(); row += stride)
        if(part.weights.order[row] == parameters.moments.order
           && engine.evaluate(part.positions.point(row), part.positions, supports[row],
                              supports.dilation[row], supports.dilation))
          result.push_back(engine.condition_number());
    }
    std::ranges::sort(result);
    return result;
  }

  std::vector<cases::Parameter> RkpmProblem::describe() const
  {
    std::size_t neighbours = 0, rows = 0, enlarged = 0, lowered = 0;
    for(const Part &part : parts)
    {
      neighbours += part.weights.supports.neighbours.size();
      rows += part.weights.supports.rows();
      enlarged += part.weights.record.enlarged;
      lowered += part.weights.record.lowered;
    }
    std::vector<cases::Parameter> result{
        {"form", variant_name(parameters.moments.variant), ""},
        {"kernel", kernel_name(parameters.moments.kernel), ""},
        {"basis order", std::to_string(parameters.moments.order), "1"},
        {"dilation over spacing, mean",
         fmt::format("{:.4g}", mean_dilation() / nodes.spacing), "1"},
        {"neighbours, mean", fmt::format("{:.4g}", double(neighbours) / double(rows)),
         "1"},
        {"supports enlarged", std::to_string(enlarged), "1"},
        {"nodes of a lower order", std::to_string(lowered), "1"},
        {"symbol over the exact one, least",
         fmt::format("{:.3g}{}", symbol,
                     symbol < least_stable_ratio ? ": a spurious mode" : ""),
         "1"}};
    if(const std::vector<double> condition = sampled_condition_numbers();
       !condition.empty())
    {
      result.push_back({"condition of moment matrices, median of a sample",
                        fmt::format("{:.2g}", condition[condition.size() / 2]), "1"});
      result.push_back(
          {"the same, largest", fmt::format("{:.2g}", condition.back()), "1"});
    }
    return result;
  }

  std::vector<cases::EffectCost>
  RkpmProblem::effect_costs(const cases::EffectSet &effects) const
  {
    std::vector<cases::EffectCost> costs;
    const auto add
        = [&](cases::Effect effect, std::size_t bytes, double seconds, long calls)
    {
      if(effects.contains(effect))
        costs.push_back({effect, calls, static_cast<long>(bytes), seconds});
    };
    using cases::Effect;
    add(Effect::volumetric_source, 0, release_seconds, evaluations);
    add(Effect::inclusion, nodes.region.size() * sizeof(Region), inclusion_seconds, 1);
    // One pass serves all walls: its time and memory are shared evenly.
    const std::size_t bytes = walls.size() * sizeof(WallCondition);
    long kinds = 0;
    for(const Effect effect :
        {Effect::wall_temperature, Effect::wall_flux, Effect::robin_wall})
      kinds += effects.contains(effect);
    for(const Effect effect :
        {Effect::wall_temperature, Effect::wall_flux, Effect::robin_wall})
      add(effect, bytes / std::max(kinds, 1L), wall_seconds / double(std::max(kinds, 1L)),
          evaluations);
    return costs;
  }
} // namespace meltfront::particles::rkpm
