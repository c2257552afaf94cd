#include <reference_fem/cut/conservative/line_sources.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    double cross(const Gradient &a, const Gradient &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }
  } // namespace

  LineSources::LineSources(const cases::Scene &scene, double smallest_distance)
    : scene(scene)
    , smallest_distance(smallest_distance)
  {
    for(const cases::PointSource &source : scene.sources)
      places.emplace_back(source.position[0], source.position[1]);
  }

  std::vector<double> LineSources::powers(double time) const
  {
    std::vector<double> result;
    for(const cases::PointSource &source : scene.sources)
      result.push_back(source.power(time));
    return result;
  }

  std::vector<double> LineSources::remaining_powers(const std::vector<double> &first,
                                                    double share, double begin,
                                                    double end) const
  {
    std::vector<double> result;
    for(std::size_t i = 0; i < first.size(); ++i)
    {
      const cases::PointSource &source = scene.sources[i];
      const double mean = (source.energy(end) - source.energy(begin)) / (end - begin);
      result.push_back((mean - share * first[i]) / (1 - share));
    }
    return result;
  }

  Point LineSources::off(Point point) const
  {
    for(const Point &place : places)
      if(point.distance(place) < smallest_distance)
      {
        point = place;
        point[0] += smallest_distance;
      }
    return point;
  }

  double LineSources::value(const Point &point, const std::vector<double> &powers) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < places.size(); ++i)
      sum -= powers[i]
             * std::log(std::max(point.distance(places[i]), smallest_distance)
                        / scene.domain.side());
    return sum / (2 * std::numbers::pi * scene.material.solid.conductivity);
  }

  Gradient LineSources::gradient(const Point &point,
                                 const std::vector<double> &powers) const
  {
    Gradient sum;
    for(std::size_t i = 0; i < places.size(); ++i)
    {
      const Gradient away = point - places[i];
      sum -= powers[i]
             / std::max(away.norm_square(), smallest_distance * smallest_distance) * away;
    }
    return sum / (2 * std::numbers::pi * scene.material.solid.conductivity);
  }

  double LineSources::flux(const Segment &segment, const Gradient &normal,
                           const std::vector<double> &powers) const
  {
    const double sense = cross(normal, segment.end - segment.begin) > 0 ? 1 : -1;
    double sum = 0;
    for(std::size_t i = 0; i < places.size(); ++i)
    {
      const Gradient first = segment.begin - places[i], last = segment.end - places[i];
      sum -= powers[i] * sense * std::atan2(cross(first, last), first * last);
    }
    return sum / (2 * std::numbers::pi);
  }
} // namespace meltfront::reference_fem::cut::conservative
