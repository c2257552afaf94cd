#ifndef meltfront_particles_level_set_exact_fronts_h
#define meltfront_particles_level_set_exact_fronts_h

#include <cases/velocity_field.h>

#include <functional>
#include <optional>
#include <vector>

namespace meltfront::particles::level_set
{
  using cases::Position;

  /** A shape that a level set is measured against. */
  struct ReferenceShape
  {
    /** Whether a point belongs to it. Asked by several threads at once. */
    std::function<bool(const Position &)> inside;

    /** Points of its front, neighbours no further apart than a given distance (m): they
     * tell in which cells to look closely. */
    std::function<std::vector<Position>(double)> front;

    /** Its front in the plane, once round for 0 to 1; empty in space. */
    std::function<Position(double)> curve;

    double content = 0; ///< area or volume (m^2, m^3)
    double border = 0;  ///< perimeter or surface (m, m^2)
  };

  /** What a front is like at one of its points. */
  struct ExactFront
  {
    Position normal;  ///< outwards
    double curvature; ///< 1/R of a disk, 2/R of a ball (1/m)
  };

  /** What the front is like at its point nearest to a given one; nothing where it has a
   * corner near. */
  using ExactFrontFunction = std::function<std::optional<ExactFront>(const Position &)>;

  /** A disk in the plane, a ball in space. */
  struct Ball
  {
    int dimension = 2;
    Position centre{};
    double radius = 0; ///< m

    /** Distance from its front, positive inside (m). */
    double distance(const Position &point) const;

    ReferenceShape shape() const;

    /** Everywhere but in the centre. */
    ExactFrontFunction front() const;
  };

  /**
   * Zalesak's disk (1979): a slot of parallel sides cut into a disk from below.
   * As in the field's tests: radius 0.15 at (0.5, 0.75), a slot 0.05 wide up to y = 0.85.
   */
  struct SlottedDisk
  {
    Position centre{0.5, 0.75, 0};
    double radius = 0.15;     ///< m
    double slot_width = 0.05; ///< m
    double slot_top = 0.85;   ///< y where the slot ends (m)

    /** Distance from its front, positive inside (m): right near its corners too. */
    double distance(const Position &point) const;

    ReferenceShape shape() const;

    /** On the arc, further than `margin` from the slot's mouth. */
    ExactFrontFunction arc(double margin) const;

  private:
    bool contains(const Position &point) const;
    double mouth() const; ///< y where the slot opens
    Position curve(double around) const;
  };

  /** A shape in the plane carried along by a velocity without divergence, its inside
   * found by following points back. @throws cases::InputError for a shape in space */
  ReferenceShape carried(const ReferenceShape &shape, const cases::VelocityField &field,
                         double from, double to);

  /** Points of a closed curve, neighbours no further apart than `spacing`. */
  std::vector<Position> points_along(const std::function<Position(double)> &curve,
                                     double spacing);
} // namespace meltfront::particles::level_set

#endif
