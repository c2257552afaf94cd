#include <particles/rkpm_tracked/plane/sinks.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Sources are not looked at from nearer than this, in spacings. */
    constexpr double nearest_to_source = 0.05;
  } // namespace

  PlaneSinks::PlaneSinks(const cases::Scene &scene, double spacing)
    : scene(scene)
    , spacing(spacing)
    , smallest_distance(nearest_to_source * spacing)
    , factor(-1 / (2 * std::numbers::pi * scene.material.solid.conductivity))
  {
    for(const cases::PointSource &source : scene.sources)
      places.emplace_back(source.position[0], source.position[1]);
  }

  double PlaneSinks::value(const PlanePoint &point, double time) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < places.size(); ++i)
      sum += scene.sources[i].power(time)
             * std::log(std::max((point - places[i]).norm(), smallest_distance)
                        / scene.domain.side());
    return factor * sum;
  }

  PlanePoint PlaneSinks::gradient(const PlanePoint &point, double time) const
  {
    PlanePoint sum(0, 0);
    for(std::size_t i = 0; i < places.size(); ++i)
    {
      const PlanePoint away = point - places[i];
      sum += scene.sources[i].power(time)
             / std::max(away.squaredNorm(), smallest_distance * smallest_distance) * away;
    }
    return factor * sum;
  }

  Eigen::Vector3d PlaneSinks::second_derivatives(const PlanePoint &point,
                                                 double time) const
  {
    Eigen::Vector3d sum(0, 0, 0);
    for(std::size_t i = 0; i < places.size(); ++i)
    {
      const PlanePoint away = point - places[i];
      const double square
          = std::max(away.squaredNorm(), smallest_distance * smallest_distance);
      const double x = away.x(), y = away.y();
      sum += scene.sources[i].power(time) / (square * square)
             * Eigen::Vector3d(y * y - x * x, -2 * x * y, x * x - y * y);
    }
    return factor * sum;
  }

  double PlaneSinks::at_node(const std::function<double(const PlanePoint &)> &temperature,
                             const PlanePoint &node,
                             std::span<const PlanePoint> samples) const
  {
    const bool holds_source
        = std::ranges::any_of(places, [&](const PlanePoint &place)
                              { return (node - place).norm() < spacing / 2; });
    if(!holds_source || samples.empty())
      return temperature(node);
    double sum = 0;
    for(PlanePoint sample : samples)
    {
      for(const PlanePoint &place : places)
        if((sample - place).norm() < smallest_distance)
          sample = place + PlanePoint(smallest_distance, 0);
      sum += temperature(sample);
    }
    return sum / static_cast<double>(samples.size());
  }

  double PlaneSinks::energy(double time) const
  {
    double sum = 0;
    for(const cases::PointSource &source : scene.sources)
      sum += source.energy(time);
    return sum;
  }
} // namespace meltfront::particles::rkpm_tracked
