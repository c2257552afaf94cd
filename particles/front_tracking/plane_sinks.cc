#include <particles/front_tracking/plane_sinks.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::front_tracking
{
  PlaneSinks::PlaneSinks(const cases::Scene &scene, double smallest_distance)
    : scene(scene)
    , smallest_distance(smallest_distance)
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

  double PlaneSinks::energy(double time) const
  {
    double sum = 0;
    for(const cases::PointSource &source : scene.sources)
      sum += source.energy(time);
    return sum;
  }
} // namespace meltfront::particles::front_tracking
