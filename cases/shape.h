#ifndef meltfront_cases_shape_h
#define meltfront_cases_shape_h

#include <cases/position.h>

#include <string>

namespace meltfront::cases
{
  /** A region of the plane or of space that is known exactly. */
  class Shape
  {
  public:
    virtual ~Shape() = default;

    /** One line, with the numbers filled in. */
    virtual std::string description() const = 0;

    /** Distance from the edge, positive inside (m). */
    virtual double signed_distance(const Position &point) const = 0;

    /** Area in the plane, volume in space; infinite of a half-space (m^2, m^3). */
    virtual double volume() const = 0;

    /** Length of the edge in the plane, its area in space (m, m^2). */
    virtual double surface() const = 0;

    /** Curvature of the edge at a point on or near it: the sum of the principal ones,
     * positive where the region is convex; NaN within some distance of a corner (1/m). */
    virtual double curvature(const Position &point) const = 0;
  };

  /** A disk in the plane, a ball in space. */
  class Ball : public Shape
  {
  public:
    /** @param dimension 2 or 3; @param radius > 0 (m) */
    Ball(int dimension, const Position &centre, double radius);

    std::string description() const override;
    double signed_distance(const Position &point) const override;
    double volume() const override;
    double surface() const override;
    double curvature(const Position &point) const override;

  private:
    int dimension;
    Position centre;
    double radius;
  };

  /** A disk with a slot cut into it from below, up to a straight end (Zalesak 1979). */
  class SlottedDisk : public Shape
  {
  public:
    /**
     * @param width of the slot, less than the diameter (m)
     * @param length of the slot from the disk's lowest point up, less than the diameter
     * (m)
     */
    SlottedDisk(const Position &centre, double radius, double width, double length);

    std::string description() const override;
    double signed_distance(const Position &point) const override;
    double volume() const override;
    double surface() const override;

    /** 1 / radius near the arc, away from the slot by a tenth of the radius; NaN
     * elsewhere. */
    double curvature(const Position &point) const override;

  private:
    bool inside(double x, double y) const;

    Position centre;
    double radius, half_width;
    double slot_end; ///< height of the slot's end over the centre
    double mouth;    ///< height of the slot's mouth over the centre, negative
  };

  /** All points x <= front. */
  class HalfSpace : public Shape
  {
  public:
    explicit HalfSpace(double front);

    std::string description() const override;
    double signed_distance(const Position &point) const override;
    double volume() const override;
    double surface() const override;
    double curvature(const Position &point) const override;

  private:
    double front;
  };
} // namespace meltfront::cases

#endif
