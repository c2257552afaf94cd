#include <verification/measure/formulas/front_shape.h>
#include <verification/run/front_frame.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::size_t most_points = 400;

    std::vector<std::size_t> points_of_plane(const cases::Snapshot &snapshot,
                                             double spacing)
    {
      std::vector<std::size_t> points(front_points(snapshot));
      for(std::size_t i = 0; i < points.size(); ++i)
        points[i] = i;
      if(snapshot.dimension < 3)
        return points;
      const auto height = [&](std::size_t i) { return std::abs(snapshot.front[2][i]); };
      const double layer = height(*std::ranges::min_element(points, {}, height));
      std::erase_if(points,
                    [&](std::size_t i) { return height(i) > layer + 0.25 * spacing; });
      return points;
    }
  } // namespace

  void add_front_frame(const cases::Snapshot &snapshot, double spacing,
                       std::vector<FrontFrame> &frames)
  {
    if(snapshot.dimension < 2 || front_points(snapshot) == 0)
      return;
    const std::vector<std::size_t> points = points_of_plane(snapshot, spacing);
    const std::size_t kept = std::min(points.size(), most_points);
    FrontFrame &frame = frames.emplace_back();
    frame.time = snapshot.time;
    for(std::size_t k = 0; k < kept; ++k)
    {
      const std::size_t i = points[k * points.size() / kept];
      frame.x.push_back(snapshot.front[0][i]);
      frame.y.push_back(snapshot.front[1][i]);
    }
  }
} // namespace meltfront::verification
