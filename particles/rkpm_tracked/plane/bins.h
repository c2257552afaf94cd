#ifndef meltfront_particles_rkpm_tracked_plane_bins_h
#define meltfront_particles_rkpm_tracked_plane_bins_h

#include <cases/position.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** A point of the plane, or a vector (m). */
  using PlanePoint = Eigen::Vector2d;

  inline cases::Position position_of(const PlanePoint &point)
  {
    return {point.x(), point.y(), 0};
  }

  /** Finds points near a place: points sorted into square cells. */
  class PlaneBins
  {
  public:
    PlaneBins() = default;

    /** @param points outlive the bins
     * @param cell side of a cell (m), about the radius of the usual question */
    PlaneBins(std::span<const PlanePoint> points, double cell);

    /** Call visitor(point, squared distance) for each point within a radius, ordered by
     * cell and within a cell by number: always the same order. */
    template <typename Visitor>
    void visit(const PlanePoint &place, double radius, Visitor &&visitor) const
    {
      if(offsets.empty())
        return;
      const long x_last = column(place.x() + radius), y_last = row(place.y() + radius);
      for(long y = row(place.y() - radius); y <= y_last; ++y)
        for(long x = column(place.x() - radius); x <= x_last; ++x)
          for(std::size_t i = offsets[y * columns + x]; i < offsets[y * columns + x + 1];
              ++i)
          {
            const double square = (points[entries[i]] - place).squaredNorm();
            if(square <= radius * radius)
              visitor(entries[i], square);
          }
    }

    /** The point nearest to a place; of equally near ones that which visit() meets first.
     * @return -1 if there are no points */
    long nearest(const PlanePoint &place) const;

  private:
    long column(double x) const;
    long row(double y) const;

    std::span<const PlanePoint> points;
    double cell = 1;
    PlanePoint lower{0, 0};
    long columns = 0, rows = 0;
    std::vector<std::size_t> offsets;
    std::vector<std::uint32_t> entries;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
