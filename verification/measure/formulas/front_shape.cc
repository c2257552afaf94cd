#include <cases/numbers.h>
#include <verification/measure/formulas/front_shape.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;
  } // namespace

  double solid_volume(const cases::Snapshot &snapshot)
  {
    double volume = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
      volume += snapshot.weights[i] * snapshot.solid_fraction[i];
    return volume;
  }

  double hole_volume(cases::Symmetry symmetry, const cases::Domain &domain)
  {
    return domain.shape == cases::DomainShape::shell
               ? cases::volume_between(symmetry, 0, domain.inner_radius)
               : 0;
  }

  double front_mode_amplitude(const cases::Snapshot &snapshot,
                              const cases::Domain &domain, bool solid_inside, int mode)
  {
    if(snapshot.dimension != 2)
      return nan;
    double enclosed = hole_volume(cases::Symmetry::cylindrical, domain);
    double moment = 0;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      const double fraction
          = solid_inside ? snapshot.solid_fraction[i] : 1 - snapshot.solid_fraction[i];
      const double angle = std::atan2(snapshot.positions[1][i], snapshot.positions[0][i]);
      enclosed += snapshot.weights[i] * fraction;
      moment += snapshot.weights[i] * fraction * std::cos(mode * angle);
    }
    if(!(enclosed > 0))
      return nan;
    return moment / std::sqrt(std::numbers::pi * enclosed);
  }

  std::size_t front_points(const cases::Snapshot &snapshot)
  {
    return snapshot.front[0].size();
  }

  cases::Position front_point(const cases::Snapshot &snapshot, std::size_t point)
  {
    cases::Position position{};
    for(int d = 0; d < snapshot.dimension; ++d)
      position[d] = snapshot.front[d][point];
    return position;
  }

  std::optional<FrontDistance> front_distance(const cases::Snapshot &snapshot,
                                              const cases::ExactSolution &exact)
  {
    const std::size_t points = front_points(snapshot);
    if(points == 0 || snapshot.time < exact.start_time())
      return {};
    FrontDistance result;
    double squares = 0;
    for(std::size_t i = 0; i < points; ++i)
    {
      const double distance
          = exact.signed_distance(front_point(snapshot, i), snapshot.time);
      squares += distance * distance;
      result.largest = std::fmax(result.largest, std::abs(distance));
    }
    result.root_mean_square = std::sqrt(squares / static_cast<double>(points));
    return result;
  }

  double roundness(const cases::Snapshot &snapshot)
  {
    if(snapshot.dimension < 2 || front_points(snapshot) < 2)
      return nan;
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for(std::size_t i = 0; i < front_points(snapshot); ++i)
    {
      const double radius
          = cases::coordinate(cases::Symmetry::spherical, front_point(snapshot, i));
      least = std::min(least, radius);
      largest = std::max(largest, radius);
    }
    return largest - least;
  }
} // namespace meltfront::verification
