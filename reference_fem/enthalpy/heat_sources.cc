#include <cases/error.h>
#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/heat_sources.h>

#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    /** Of a cell: so far a source goes between points at which it gives off heat. */
    constexpr double share_of_cell = 0.125;

    /** A step is taken in four parts at least, and in halves of these as often as that.
     */
    constexpr int fewest_halvings = 2, most_halvings = 20;

    double distance(const cases::Position &a, const cases::Position &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
  } // namespace

  HeatSources::HeatSources(const cases::Scene &scene, Mesh &mesh,
                           const Discretisation &discretisation)
    : mesh(mesh)
    , longest_way(share_of_cell * discretisation.spacing)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    for(const cases::PointSource &source : scene.sources)
    {
      if(scene.domain.shape == cases::DomainShape::slab && discretisation.dimension > 1)
        throw cases::Refusal(
            "fem-enthalpy simulates the sources of a slab in one dimension only");
      if(discretisation.measure != cases::Symmetry::none)
        for(const double x : source.position)
          if(std::abs(x) > 1e-12 * scene.domain.radius)
            throw cases::Refusal("a source away from the centre is not symmetric: "
                                 "fem-enthalpy needs the option dimension for it");
      if(source.path)
      {
        if(moving.empty())
          mesh.expect_many_points();
        moving.push_back({source, {}});
        moving_cost.bytes += static_cast<long>(sizeof(MovingSource));
        continue;
      }
      sources.push_back({source.energy, mesh.shares(source.position)});
      effect_cost.bytes += static_cast<long>(sizeof(Source));
      effect_cost.bytes += static_cast<long>(sources.back().shares.size()
                                             * sizeof(std::pair<unsigned int, double>));
    }
  }

  void HeatSources::add_load(const StepFormula &step, std::vector<double> &load)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    for(const Source &source : sources)
    {
      const double heat
          = source.energy(step.next)
            - step.combine(source.energy(step.now), source.energy(step.before));
      for(const auto &[node, share] : source.shares)
        load[node] += share * heat;
    }
    for(MovingSource &source : moving)
    {
      for(const auto &[node, heat] : given(source, step.now, step.next))
        load[node] += heat;
      if(step.weight_before != 0)
        for(const auto &[node, heat] : given(source, step.before, step.now))
          load[node] += step.weight_before * heat;
    }
  }

  const Shares &HeatSources::given(MovingSource &moving, double begin, double end)
  {
    for(const Given &kept : moving.steps)
      if(!kept.heat.empty() && kept.begin == begin && kept.end == end)
      {
        moving.latest = static_cast<std::size_t>(&kept - moving.steps.data());
        return kept.heat;
      }
    const cases::ScopedTimer timer(moving_cost.seconds);
    ++moving_cost.calls;
    moving.latest = 1 - moving.latest;
    Given &step = moving.steps[moving.latest];
    step = {begin, end, {}};
    follow(moving.source, begin, end, 0, step.heat);
    return step.heat;
  }

  /** By the midpoint rule in parts in which the source stays within part of a cell. */
  void HeatSources::follow(const cases::PointSource &source, double begin, double end,
                           int depth, Shares &heat) const
  {
    const double middle = begin + (end - begin) / 2;
    const cases::Position there = source.at(middle);
    const double way
        = distance(source.at(begin), there) + distance(there, source.at(end));
    if(depth < fewest_halvings || (way > longest_way && depth < most_halvings))
    {
      follow(source, begin, middle, depth + 1, heat);
      follow(source, middle, end, depth + 1, heat);
      return;
    }
    const double released = source.energy(end) - source.energy(begin);
    for(const auto &[node, share] : mesh.shares(there))
      heat.emplace_back(node, share * released);
  }

  double HeatSources::energy(double time) const
  {
    double sum = 0;
    for(const Source &source : sources)
      sum += source.energy(time);
    for(const MovingSource &source : moving)
      sum += source.source.energy(time);
    return sum;
  }
} // namespace meltfront::reference_fem
