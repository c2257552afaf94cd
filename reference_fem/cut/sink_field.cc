#include <reference_fem/cut/sink_field.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    constexpr int samples_in_time = 257;

    bool power_varies(const cases::Scene &scene, const cases::PointSource &source)
    {
      const double first = source.power(scene.start_time);
      const double span = scene.end_time - scene.start_time;
      for(int i = 1; i < samples_in_time; ++i)
        if(std::abs(source.power(scene.start_time + span * i / (samples_in_time - 1))
                    - first)
           > 1e-13 * std::abs(first))
          return true;
      return false;
    }
    /** A second antiderivative of ln |(x, y)|, in x and in y. */
    double antiderivative(double x, double y)
    {
      if(x == 0 || y == 0)
        return 0;
      return x * y * (std::log(std::hypot(x, y)) - 1.5)
             + (x * x * std::atan(y / x) + y * y * std::atan(x / y)) / 2;
    }
  } // namespace

  SinkField::SinkField(const cases::Scene &scene, double smallest_distance)
    : scene(scene)
    , smallest_distance(smallest_distance)
  {
    for(const cases::PointSource &source : scene.sources)
    {
      places.emplace_back(source.position[0], source.position[1]);
      varying = varying || power_varies(scene, source);
    }
  }

  double SinkField::value(const Point &point, double time) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < places.size(); ++i)
      sum -= scene.sources[i].power(time)
             * std::log(std::max(point.distance(places[i]), smallest_distance)
                        / scene.domain.side());
    return sum / (2 * std::numbers::pi * scene.material.solid.conductivity);
  }

  Gradient SinkField::gradient(const Point &point, double time) const
  {
    Gradient sum;
    for(std::size_t i = 0; i < places.size(); ++i)
    {
      const Gradient away = point - places[i];
      sum -= scene.sources[i].power(time)
             / std::max(away.norm_square(), smallest_distance * smallest_distance) * away;
    }
    return sum / (2 * std::numbers::pi * scene.material.solid.conductivity);
  }

  double SinkField::integral(const Point &lower, const Gradient &size, double time) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < places.size(); ++i)
    {
      const Gradient first = lower - places[i], last = first + size;
      const double logarithm
          = antiderivative(last[0], last[1]) - antiderivative(first[0], last[1])
            - antiderivative(last[0], first[1]) + antiderivative(first[0], first[1]);
      sum -= scene.sources[i].power(time)
             * (logarithm - size[0] * size[1] * std::log(scene.domain.side()));
    }
    return sum / (2 * std::numbers::pi * scene.material.solid.conductivity);
  }

  double SinkField::energy(double time) const
  {
    double sum = 0;
    for(const cases::PointSource &source : scene.sources)
      sum += source.energy(time);
    return sum;
  }
} // namespace meltfront::reference_fem::cut
