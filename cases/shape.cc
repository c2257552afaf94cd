#include <cases/error.h>
#include <cases/numbers.h>
#include <cases/shape.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    using std::numbers::pi;

    void require_radius(const double radius)
    {
      if(!(radius > 0) || !std::isfinite(radius))
        throw Refusal(fmt::format("a radius of {} m: it must be above zero", radius));
    }

    /** Distance from a vertical or horizontal stretch between two ends. */
    double distance_from_stretch(const double along, const double across,
                                 const double begin, const double end)
    {
      return std::hypot(across, along - std::clamp(along, begin, end));
    }
  } // namespace

  Ball::Ball(const int dimension, const Position &centre, const double radius)
    : dimension(dimension)
    , centre(centre)
    , radius(radius)
  {
    require_radius(radius);
  }

  std::string Ball::description() const
  {
    return fmt::format("{} of radius {} m about ({}, {}, {})",
                       dimension == 2 ? "disk" : "ball", radius, centre[0], centre[1],
                       centre[2]);
  }

  double Ball::signed_distance(const Position &point) const
  {
    const double x = point[0] - centre[0], y = point[1] - centre[1];
    return radius
           - (dimension == 2 ? std::hypot(x, y) : std::hypot(x, y, point[2] - centre[2]));
  }

  double Ball::volume() const
  {
    return dimension == 2 ? pi * radius * radius
                          : 4. / 3. * pi * radius * radius * radius;
  }

  double Ball::surface() const
  {
    return dimension == 2 ? 2 * pi * radius : 4 * pi * radius * radius;
  }

  double Ball::curvature(const Position &) const
  {
    return (dimension - 1) / radius;
  }

  SlottedDisk::SlottedDisk(const Position &centre, const double radius,
                           const double width, const double length)
    : centre(centre)
    , radius(radius)
    , half_width(width / 2)
    , slot_end(length - radius)
  {
    require_radius(radius);
    if(!(half_width > 0 && half_width < radius && length > 0 && length < 2 * radius))
      throw Refusal(fmt::format("a slot of {} m x {} m does not lie in a disk of radius "
                                "{} m",
                                width, length, radius));
    mouth = -std::sqrt(radius * radius - half_width * half_width);
  }

  std::string SlottedDisk::description() const
  {
    return fmt::format("disk of radius {} m about ({}, {}) with a slot of {} m x {} m",
                       radius, centre[0], centre[1], 2 * half_width, slot_end + radius);
  }

  bool SlottedDisk::inside(const double x, const double y) const
  {
    return std::hypot(x, y) < radius && !(std::abs(x) <= half_width && y <= slot_end);
  }

  double SlottedDisk::signed_distance(const Position &point) const
  {
    const double x = std::abs(point[0] - centre[0]); // the shape is its own mirror image
    const double y = point[1] - centre[1];
    // The arc ends where the slot begins; seen from the slot its end is the nearest.
    const double from_centre = std::hypot(x, y);
    const bool at_mouth = y < 0 && x * -mouth < half_width * -y;
    const double arc = at_mouth ? std::hypot(x - half_width, y - mouth)
                                : std::abs(radius - from_centre);
    const double side = distance_from_stretch(y, x - half_width, mouth, slot_end);
    const double end = distance_from_stretch(x, y - slot_end, -half_width, half_width);
    const double distance = std::min({arc, side, end});
    return inside(x, y) ? distance : -distance;
  }

  double SlottedDisk::volume() const
  {
    // the slot: a rectangle down to the mouth and the segment of the disk below it
    const double angle = std::asin(half_width / radius);
    const double segment = radius * radius * angle + half_width * mouth;
    return pi * radius * radius - 2 * half_width * (slot_end - mouth) - segment;
  }

  double SlottedDisk::surface() const
  {
    return 2 * radius * (pi - std::asin(half_width / radius)) + 2 * (slot_end - mouth)
           + 2 * half_width;
  }

  double SlottedDisk::curvature(const Position &point) const
  {
    const double x = point[0] - centre[0], y = point[1] - centre[1];
    const bool on_arc = std::abs(std::hypot(x, y) - radius) < 0.1 * radius;
    const bool near_slot
        = y < slot_end + 0.1 * radius && std::abs(x) < half_width + 0.1 * radius;
    return on_arc && !near_slot ? 1 / radius : nan;
  }

  HalfSpace::HalfSpace(const double front)
    : front(front)
  {
  }

  std::string HalfSpace::description() const
  {
    return fmt::format("all of x <= {} m", front);
  }

  double HalfSpace::signed_distance(const Position &point) const
  {
    return front - point[0];
  }

  double HalfSpace::volume() const
  {
    return infinity;
  }

  double HalfSpace::surface() const
  {
    return infinity;
  }

  double HalfSpace::curvature(const Position &) const
  {
    return 0;
  }
} // namespace meltfront::cases
