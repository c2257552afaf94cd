#include <particles/rkpm_tracked/plane/bins.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Cells per point beyond which scattered points get larger cells. */
    constexpr double most_cells_per_point = 64;
  } // namespace

  PlaneBins::PlaneBins(std::span<const PlanePoint> points, double cell)
    : points(points)
    , cell(cell)
  {
    if(points.empty())
      return;
    lower = points.front();
    PlanePoint upper = points.front();
    for(const PlanePoint &point : points)
    {
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
    const PlanePoint extent = upper - lower;
    const double most = most_cells_per_point * static_cast<double>(points.size())
                        + most_cells_per_point;
    while((extent.x() / this->cell + 1) * (extent.y() / this->cell + 1) > most)
      this->cell *= 2;
    columns = static_cast<long>(extent.x() / this->cell) + 1;
    rows = static_cast<long>(extent.y() / this->cell) + 1;
    std::vector<std::size_t> place(points.size());
    offsets.assign(columns * rows + 1, 0);
    for(std::size_t i = 0; i < points.size(); ++i)
    {
      place[i] = row(points[i].y()) * columns + column(points[i].x());
      ++offsets[place[i] + 1];
    }
    for(std::size_t c = 1; c < offsets.size(); ++c)
      offsets[c] += offsets[c - 1];
    entries.resize(points.size());
    std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
    for(std::size_t i = 0; i < points.size(); ++i)
      entries[next[place[i]]++] = static_cast<std::uint32_t>(i);
  }

  long PlaneBins::column(double x) const
  {
    return static_cast<long>(
        std::clamp(std::floor((x - lower.x()) / cell), 0., columns - 1.));
  }

  long PlaneBins::row(double y) const
  {
    return static_cast<long>(
        std::clamp(std::floor((y - lower.y()) / cell), 0., rows - 1.));
  }

  long PlaneBins::nearest(const PlanePoint &place) const
  {
    if(points.empty())
      return -1;
    long best = -1;
    double least = std::numeric_limits<double>::infinity();
    // Places beyond the points' box are first led to its edge.
    const PlanePoint upper = lower + cell * PlanePoint(columns, rows);
    const double beyond = (place - place.cwiseMax(lower).cwiseMin(upper)).norm();
    for(double radius = beyond + cell; best < 0; radius *= 2)
      visit(place, radius,
            [&](std::uint32_t point, double square)
            {
              if(square < least)
              {
                least = square;
                best = point;
              }
            });
    return best;
  }
} // namespace meltfront::particles::rkpm_tracked
