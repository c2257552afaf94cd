#include <cases/error.h>
#include <particles/level_set/exact_fronts.h>

#include <algorithm>
#include <numbers>

namespace meltfront::particles::level_set
{
  namespace
  {
    using std::numbers::pi;

    double apart(const Position &a, const Position &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }

    double distance_from_segment(const Position &p, const Position &a, const Position &b)
    {
      const double length_squared
          = (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
      const double along
          = std::clamp(((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1]))
                           / length_squared,
                       0., 1.);
      return std::hypot(p[0] - a[0] - along * (b[0] - a[0]),
                        p[1] - a[1] - along * (b[1] - a[1]));
    }

    /** Points on circles of latitude. */
    std::vector<Position> sphere_points(const Ball &ball, const double spacing)
    {
      const int rings = std::max(4, int(std::ceil(pi * ball.radius / spacing)) + 1);
      std::vector<Position> points;
      for(int r = 0; r <= rings; ++r)
      {
        const double polar = pi * r / rings, width = ball.radius * std::sin(polar);
        const int count = std::max(1, int(std::ceil(2 * pi * width / spacing)));
        for(int n = 0; n < count; ++n)
        {
          const double angle = 2 * pi * n / count;
          points.push_back({ball.centre[0] + width * std::cos(angle),
                            ball.centre[1] + width * std::sin(angle),
                            ball.centre[2] + ball.radius * std::cos(polar)});
        }
      }
      return points;
    }

    /** Points between two parameters of a curve, the second left out. */
    void add_points(const std::function<Position(double)> &curve, double begin,
                    const Position &first, double end, const Position &last,
                    double spacing, std::vector<Position> &points)
    {
      const double middle = (begin + end) / 2;
      if(apart(first, last) <= spacing || middle <= begin || middle >= end)
      {
        points.push_back(first);
        return;
      }
      const Position between = curve(middle);
      add_points(curve, begin, first, middle, between, spacing, points);
      add_points(curve, middle, between, end, last, spacing, points);
    }
  } // namespace

  std::vector<Position> points_along(const std::function<Position(double)> &curve,
                                     const double spacing)
  {
    // enough to begin with that no fold hides between two of them
    constexpr int pieces = 256;
    std::vector<Position> points;
    const Position start = curve(0);
    Position first = start;
    for(int piece = 1; piece <= pieces; ++piece)
    {
      const double end = piece / double(pieces);
      const Position last = piece == pieces ? start : curve(end);
      add_points(curve, (piece - 1) / double(pieces), first, end, last, spacing, points);
      first = last;
    }
    return points;
  }

  double Ball::distance(const Position &point) const
  {
    double squares = 0;
    for(int d = 0; d < dimension; ++d)
      squares += (point[d] - centre[d]) * (point[d] - centre[d]);
    return radius - std::sqrt(squares);
  }

  ReferenceShape Ball::shape() const
  {
    ReferenceShape shape;
    shape.inside = [ball = *this](const Position &p) { return ball.distance(p) > 0; };
    if(dimension == 3)
    {
      shape.front
          = [ball = *this](double spacing) { return sphere_points(ball, spacing); };
      shape.content = 4. / 3 * pi * radius * radius * radius;
      shape.border = 4 * pi * radius * radius;
      return shape;
    }
    shape.curve = [ball = *this](double around)
    {
      return Position{ball.centre[0] + ball.radius * std::cos(2 * pi * around),
                      ball.centre[1] + ball.radius * std::sin(2 * pi * around), 0};
    };
    shape.front
        = [curve = shape.curve](double spacing) { return points_along(curve, spacing); };
    shape.content = pi * radius * radius;
    shape.border = 2 * pi * radius;
    return shape;
  }

  ExactFrontFunction Ball::front() const
  {
    return [ball = *this](const Position &p) -> std::optional<ExactFront>
    {
      const double away = ball.radius - ball.distance(p);
      if(!(away > 0))
        return std::nullopt;
      ExactFront front{{}, (ball.dimension - 1) / ball.radius};
      for(int d = 0; d < ball.dimension; ++d)
        front.normal[d] = (p[d] - ball.centre[d]) / away;
      return front;
    };
  }

  double SlottedDisk::mouth() const
  {
    return centre[1] - std::sqrt(radius * radius - slot_width * slot_width / 4);
  }

  bool SlottedDisk::contains(const Position &point) const
  {
    const double x = point[0] - centre[0], y = point[1] - centre[1];
    const bool in_slot = std::abs(x) <= slot_width / 2 && point[1] <= slot_top;
    return x * x + y * y < radius * radius && !in_slot;
  }

  double SlottedDisk::distance(const Position &point) const
  {
    const double x = point[0] - centre[0], y = point[1] - centre[1];
    const double left = centre[0] - slot_width / 2, right = centre[0] + slot_width / 2;
    double away
        = std::min({distance_from_segment(point, {left, mouth()}, {left, slot_top}),
                    distance_from_segment(point, {right, mouth()}, {right, slot_top}),
                    distance_from_segment(point, {left, slot_top}, {right, slot_top})});
    // the sides end where the arc does, so they count for points below the mouth
    const double from_centre = std::hypot(x, y);
    const bool over_mouth = y < 0 && std::abs(x) * radius < slot_width / 2 * from_centre;
    if(!over_mouth)
      away = std::min(away, std::abs(radius - from_centre));
    return contains(point) ? away : -away;
  }

  Position SlottedDisk::curve(const double around) const
  {
    const double half = slot_width / 2, depth = slot_top - mouth();
    const double gap = std::asin(half / radius), arc = 2 * (pi - gap) * radius;
    double s = around * (arc + 2 * depth + slot_width);
    if(s < arc)
    {
      const double angle = -pi / 2 + gap + s / radius;
      return {centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle),
              0};
    }
    s -= arc;
    if(s < depth)
      return {centre[0] - half, mouth() + s, 0};
    s -= depth;
    if(s < slot_width)
      return {centre[0] - half + s, slot_top, 0};
    return {centre[0] + half, slot_top - (s - slot_width), 0};
  }

  ReferenceShape SlottedDisk::shape() const
  {
    const double half = slot_width / 2, depth = slot_top - mouth();
    const double gap = std::asin(half / radius);
    ReferenceShape shape;
    shape.inside = [disk = *this](const Position &p) { return disk.contains(p); };
    shape.curve = [disk = *this](double around) { return disk.curve(around); };
    shape.front
        = [curve = shape.curve](double spacing) { return points_along(curve, spacing); };
    // the slot's part of the disk: a strip above the chord at the centre and what hangs
    // below it
    const double slot = slot_width * (slot_top - centre[1])
                        + half * std::sqrt(radius * radius - half * half)
                        + radius * radius * gap;
    shape.content = pi * radius * radius - slot;
    shape.border = 2 * (pi - gap) * radius + 2 * depth + slot_width;
    return shape;
  }

  ExactFrontFunction SlottedDisk::arc(const double margin) const
  {
    return [disk = *this, margin](const Position &p) -> std::optional<ExactFront>
    {
      const Ball round{2, disk.centre, disk.radius};
      const double half = disk.slot_width / 2;
      const bool on_slot = std::abs(p[0] - disk.centre[0]) < half + margin
                           && p[1] < disk.slot_top + margin;
      return on_slot ? std::nullopt : round.front()(p);
    };
  }

  ReferenceShape carried(const ReferenceShape &shape, const cases::VelocityField &field,
                         const double from, const double to)
  {
    if(!shape.curve)
      throw cases::InputError(
          "a shape to be carried along has no curve: only shapes in the plane have one");
    ReferenceShape moved = shape;
    moved.inside = [inside = shape.inside, &field, from, to](const Position &p)
    { return inside(field.carried(p, to, from, 2)); };
    moved.curve = [curve = shape.curve, &field, from, to](double around)
    { return field.carried(curve(around), from, to, 2); };
    moved.front
        = [curve = moved.curve](double spacing) { return points_along(curve, spacing); };
    const std::vector<Position> points = moved.front(std::sqrt(shape.content) / 200);
    moved.border = 0;
    for(std::size_t n = 0; n < points.size(); ++n)
      moved.border += apart(points[n], points[(n + 1) % points.size()]);
    return moved;
  }
} // namespace meltfront::particles::level_set
