#ifndef meltfront_cases_exact_solution_h
#define meltfront_cases_exact_solution_h

#include <cases/position.h>

#include <string>

namespace meltfront::cases
{
  /**
   * What is known exactly of a scene: temperature, front and heat content at any point
   * and time.
   *
   * Most solutions with a front are symmetric: they depend on one coordinate, x in a
   * planar scene and the distance r from the axis or the centre in a cylindrical or
   * spherical one. Of those that depends_on_one_coordinate() excepts, all that takes a
   * coordinate is not a number. Without a front only the temperature at a point is asked
   * for.
   */
  class ExactSolution
  {
  public:
    virtual ~ExactSolution() = default;

    /** Its name with the numbers filled in, one line. */
    virtual std::string description() const = 0;

    virtual Symmetry symmetry() const = 0;

    /** Whether there is a front. */
    virtual bool has_front() const
    {
      return true;
    }

    /** Whether there is a front at one coordinate, and with it all that takes one. */
    virtual bool depends_on_one_coordinate() const
    {
      return has_front();
    }

    /** First time at which it may be evaluated (s); usually 0. */
    virtual double start_time() const
    {
      return 0;
    }

    /** Temperature at a coordinate >= 0 and a time >= start_time(). */
    virtual double temperature(double coordinate, double time) const = 0;

    /** The coordinate of the front (m). */
    virtual double front(double time) const = 0;

    /**
     * Enthalpy per mass times density, integrated over lower <= coordinate <= upper with
     * the measure of the symmetry (dx, 2 pi r dr, 4 pi r^2 dr); solid at the melting
     * temperature counts zero. J/m^2, J/m, or J.
     */
    virtual double heat_content(double lower, double upper, double time) const = 0;

    /**
     * Volume of which the mass is solid between the two coordinates, in the same measure
     * (m, m^2, m^3): the integral of solid_fraction().
     */
    virtual double solid_volume(double lower, double upper, double time) const;

    /** The solid's volume in the solution's whole domain (m, m^2, m^3); not a number
     * where that is unknown. */
    virtual double solid_volume(double time) const;

    /** Area of the front in the solution's whole domain (1, m, m^2); not a number where
     * that is unknown. */
    virtual double front_area(double time) const;

    /** Heat released at a point per volume and time (W/m^3). */
    virtual double volumetric_source(const Position &, double) const
    {
      return 0;
    }

    /** Whether solid and liquid are mixed behind the front: the front is then where the
     * first crystals stand. */
    virtual bool mushy() const
    {
      return false;
    }

    /** Mass fraction of solid: 0 or 1 but in a mush. */
    virtual double solid_fraction(double coordinate, double time) const;

    /** The same at a point of space. */
    virtual double solid_fraction(const Position &position, double time) const
    {
      return solid_fraction(coordinate(symmetry(), position), time);
    }

    /** Mass of the first solute over all the mass at a coordinate. */
    virtual double concentration(double, double) const
    {
      return 0;
    }

    /** The same temperature at a point of space. */
    virtual double temperature(const Position &position, double time) const
    {
      return temperature(coordinate(symmetry(), position), time);
    }

    /** Signed distance to the front (m): negative in the phase that holds the origin, or
     * rather in the solid if solid_at_origin(). */
    virtual double signed_distance(const Position &position, double time) const
    {
      return coordinate(symmetry(), position) - front(time);
    }

    /** True where solid holds the origin (freezing from a cold wall or a sink; the usual
     * case). */
    virtual bool solid_at_origin() const
    {
      return true;
    }
  };
} // namespace meltfront::cases

#endif
