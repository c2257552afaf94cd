#ifndef meltfront_cases_velocity_field_h
#define meltfront_cases_velocity_field_h

#include <cases/position.h>

#include <array>
#include <functional>
#include <span>
#include <string>

namespace meltfront::cases
{
  /** Coordinates of points, one array per dimension; those beyond it are empty. */
  using PointArrays = std::array<std::span<const double>, 3>;

  /** A prescribed velocity of all space (m/s), asked for at many points at once. */
  class VelocityField
  {
  public:
    virtual ~VelocityField() = default;

    /** One line, with the numbers filled in. */
    virtual std::string description() const = 0;

    /** Whether distances between moving points never change. */
    virtual bool rigid() const
    {
      return false;
    }

    /**
     * Velocity at points (m/s).
     * @param points in 2 or 3 dimensions, as many arrays filled
     * @param velocity where the components go, one array per dimension
     */
    virtual void velocities(const PointArrays &points, double time,
                            const std::array<std::span<double>, 3> &velocity) const = 0;

    /**
     * Velocity gradient at points (1/s).
     * @param gradient where du_i/dx_j goes: array 3 i + j; those beyond the dimension are
     * not touched
     */
    virtual void gradients(const PointArrays &points, double time,
                           const std::array<std::span<double>, 9> &gradient) const = 0;

    /** Velocity at one point, of which `dimension` coordinates matter. */
    Position velocity(const Position &point, double time, int dimension) const;

    /**
     * Where what is at a point at one time was at another: the path of a moving point,
     * followed in either direction to a relative accuracy of 1e-10 (Runge-Kutta-Fehlberg
     * of order 7 and 8).
     */
    Position carried(const Position &point, double from, double to, int dimension) const;
  };

  /** Turning about a point of the plane and moving along: u = v + omega x (r - c). */
  class RigidMotion : public VelocityField
  {
  public:
    /**
     * @param translation (m/s)
     * @param angular_velocity in the plane (x, y), counterclockwise (1/s)
     * @param centre of the rotation (m)
     */
    RigidMotion(const Position &translation, double angular_velocity,
                const Position &centre);

    std::string description() const override;
    bool rigid() const override;
    void velocities(const PointArrays &points, double time,
                    const std::array<std::span<double>, 3> &velocity) const override;
    void gradients(const PointArrays &points, double time,
                   const std::array<std::span<double>, 9> &gradient) const override;

  private:
    Position translation;
    double angular_velocity;
    Position centre;
  };

  /**
   * The vortex in the unit square that draws a disk into a spiral and back,
   * u = -sin^2(pi x) sin(2 pi y) g, v = sin(2 pi x) sin^2(pi y) g, g = cos(pi t / T)
   * (Bell, Colella, Glaz 1989; reversed in time by LeVeque 1996).
   */
  class SingleVortex : public VelocityField
  {
  public:
    /** @param period T after which everything is back (s), > 0 */
    explicit SingleVortex(double period);

    std::string description() const override;
    void velocities(const PointArrays &points, double time,
                    const std::array<std::span<double>, 3> &velocity) const override;
    void gradients(const PointArrays &points, double time,
                   const std::array<std::span<double>, 9> &gradient) const override;

  private:
    double period;
  };

  /**
   * The deformation of the unit cube that flattens a ball into two thin sheets and back
   * (LeVeque 1996, section 7): u = 2 sin^2(pi x) sin(2 pi y) sin(2 pi z) g,
   * v = -sin(2 pi x) sin^2(pi y) sin(2 pi z) g, w = -sin(2 pi x) sin(2 pi y) sin^2(pi z)
   * g, g = cos(pi t / T).
   */
  class CubeDeformation : public VelocityField
  {
  public:
    /** @param period T after which everything is back (s), > 0 */
    explicit CubeDeformation(double period);

    std::string description() const override;
    void velocities(const PointArrays &points, double time,
                    const std::array<std::span<double>, 3> &velocity) const override;
    void gradients(const PointArrays &points, double time,
                   const std::array<std::span<double>, 9> &gradient) const override;

  private:
    double period;
  };

  /** A velocity given as formulas of place and time; its gradient is taken by central
   * differences. */
  class FormulaVelocity : public VelocityField
  {
  public:
    using Formula = std::function<double(const Position &, double time)>;

    /**
     * @param text the formulas, for the description
     * @param components one formula per dimension, empty beyond it
     * @param length over which the velocity varies, for the differences (m)
     */
    FormulaVelocity(std::string text, std::array<Formula, 3> components, double length);

    std::string description() const override;
    void velocities(const PointArrays &points, double time,
                    const std::array<std::span<double>, 3> &velocity) const override;
    void gradients(const PointArrays &points, double time,
                   const std::array<std::span<double>, 9> &gradient) const override;

  private:
    std::string text;
    std::array<Formula, 3> components;
    double length;
  };
} // namespace meltfront::cases

#endif
