#ifndef meltfront_cases_scene_heat_h
#define meltfront_cases_scene_heat_h

#include <cases/scene.h>

namespace meltfront::cases
{
  /** Which way all data of a scene drive its heat content. */
  enum class HeatCourse
  {
    both_ways, ///< or it is not known
    cooling,
    heating
  };

  /**
   * What a phase does with its heat over a run, bounded from the scene's data alone, in a
   * substance that melts at one temperature T_m, liquid above and solid below it. Write
   * theta = |T - T_m| where the phase is, else 0.
   */
  struct PhaseHeat
  {
    /** Largest theta, by the maximum principle (K). */
    double excess = 0;
    /**
     * Bound on what the phase takes up and gives away, int int capacity |dtheta/dt| dx dt
     * <= capacity N V (J), with N the total variation of theta over time at any point.
     * Where the course is one way, temperature is monotone in time at every point
     * (comparison of the solution with itself a moment later) and N is `excess`: proved;
     * and no more than what is exchanged. Else N is twice the excess, one warming and
     * one cooling from the start, and the variations of all walls beside it, each of
     * which the interior follows by no more than the wall itself: derived, not proved;
     * held against runs in the tests.
     */
    double turned = 0;
    /**
     * Bound on the heat that passes between the phase and all fronts (J). It has one sign
     * at any front, so that the phase's own book holds it: what was in the phase at the
     * start, and what walls add. The front's book and the other phase's hold it as well:
     * latent heat of the whole domain, what the other phase held, and what its walls take
     * away. The less of both; infinite where walls of given temperature stand on both
     * sides of T_m, but in a slab that is driven one way, see bound_scene_heat().
     */
    double through_fronts = 0;
    /** Bound on the heat that walls of prescribed flux, of Newton's or of Stefan's law
     * pass to or from the phase (J). */
    double through_walls = 0;
    /** Greatest heat capacity per volume (J/(m^3 K)). */
    double capacity = 0;
  };

  /** Bounds on the heat of a scene; by volume in its own measure (J/m^2 in a slab, J/m in
   * the plane). */
  struct SceneHeat
  {
    double volume = 0;          ///< of the domain (m, m^2, m^3)
    TemperatureBounds bounds{}; ///< of the maximum principle
    HeatCourse course = HeatCourse::both_ways;
    /** Bound on the heat that the domain takes up or loses where the course is one way,
     * else infinite (J). */
    double exchanged = 0;
    PhaseHeat solid{}, liquid{};
  };

  /** Extremes of initial and wall temperatures, whatever fluxes and sources do. */
  TemperatureBounds given_temperatures(const Scene &scene);

  /** Bound on the heat that passes a wall while its temperature is between two (J);
   * infinite of a wall whose temperature is given. */
  double heat_through_wall(const Scene &scene, Side side, double lowest, double highest);

  /** Bound on the heat that all walls of a kind pass at temperatures between two (J). */
  double heat_through_walls(const Scene &scene, BoundaryKind kind, double lowest,
                            double highest);

  /** Bound on the heat that sources and sinks release, taken without sign (J). */
  double heat_of_sources(const Scene &scene);

  /** The same of heat released throughout the domain (J). */
  double heat_of_volumetric_source(const Scene &scene);

  /**
   * Bounds of a scene that conducts heat, by scene data only.
   *
   * Exchanged heat of a scene that is driven one way from a uniform start: all enthalpy
   * per volume lies between that of the start and that of the most extreme wall, which
   * differ by Delta. So it is at most V Delta. In a slab of which one end has another
   * temperature than the start and the other end is insulated or kept at that of the
   * start, with Kirchhoff's variable u = int k dT, d/dt int x (H - H_0) dx <= u_wall -
   * u_0 = U, and of all 0 <= H - H_0 <= Delta with int x (H - H_0) dx <= U t that which
   * fills 0 < x < s holds the most: sqrt(2 U t Delta).
   *
   * A slab that cools from a uniform liquid start, one end cold and the other kept at the
   * start's temperature (or heats, with the phases exchanged): the steady state is a
   * lower bound of the temperature, so that the liquid layer never is thinner than its,
   * d = l u_l / (u_l + u_s), and from d/dt int rho c theta (l - x) dx = - q (l - s) + u_l
   * the heat that passes the front is at most (rho c theta_0 l^2 / 2 + u_l t) / d.
   */
  SceneHeat bound_scene_heat(const Scene &scene);
} // namespace meltfront::cases

#endif
