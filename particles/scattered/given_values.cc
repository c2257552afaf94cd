#include <cases/wall_law.h>
#include <particles/scattered/given_values.h>

#include <algorithm>
#include <stdexcept>

namespace meltfront::particles
{
  namespace
  {
    double mean_over(const cases::TimeMean &mean, const cases::Position &position,
                     const LinearStep &step, double share_before)
    {
      const double now = mean(position, step.begin, step.end);
      if(share_before == 0 || step.before == step.begin || mean.steady())
        return now;
      return now + share_before * (now - mean(position, step.before, step.begin));
    }
  } // namespace

  LinearStep steady_step(double time)
  {
    return {time, time, time, 0, time};
  }

  GivenValues::GivenValues(const cases::Scene &scene)
    : scene(scene)
  {
    for(const cases::Side side : scene.sides())
      if(const cases::Boundary &boundary = scene.boundary(side);
         cases::prescribes_heat(boundary.kind))
        walls[static_cast<std::size_t>(side)].emplace(boundary.value);
    if(scene.volumetric_source)
      released.emplace(*scene.volumetric_source);
  }

  const cases::TimeMean &GivenValues::mean_of(const cases::Boundary &boundary) const
  {
    for(std::size_t side = 0; side < walls.size(); ++side)
      if(walls[side] && &*scene.boundaries[side] == &boundary)
        return *walls[side];
    throw std::logic_error("a wall of another scene, or one that gives off no heat");
  }

  double GivenValues::release(const cases::Position &position,
                              const LinearStep &step) const
  {
    return mean_over(*released, position, step, step.share_before);
  }

  double GivenValues::wall(const cases::Boundary &boundary,
                           const cases::Position &position, const LinearStep &step) const
  {
    return mean_over(mean_of(boundary), position, step, step.share_before);
  }

  double GivenValues::constraint(const cases::Boundary &boundary,
                                 const cases::Position &position,
                                 const LinearStep &step) const
  {
    const cases::TimeMean &mean = mean_of(boundary);
    const std::vector<double> &times = mean.field().breakpoints;
    const auto next = std::ranges::lower_bound(times, step.before);
    if(next == times.end() || *next > step.end)
      return mean.field()(position, step.at);
    return mean_over(mean, position, step, 0.5);
  }
} // namespace meltfront::particles
