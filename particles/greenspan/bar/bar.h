#ifndef meltfront_particles_greenspan_bar_bar_h
#define meltfront_particles_greenspan_bar_bar_h

#include <particles/greenspan/experiments.h>
#include <particles/greenspan/motion/motion.h>

#include <functional>
#include <span>

namespace meltfront::particles::greenspan
{
  /**
   * A crystal bar of the plane that is melted from one end: rows of particles along x,
   * repeated across y, between an elastic wall at x = 0 and a piston, the last columns
   * of the lattice, which carry a constant pressure. Particles near the wall are in a hot
   * bath, those near the piston in a cold one. No gravity.
   */
  struct BarSettings
  {
    PairForce force = PairForce::triangle();
    double spacing = 0; ///< of the lattice, also across; 0: the equilibrium distance
    int columns = 200;
    int rows = 20;                ///< even
    double pressure = 30;         ///< of the piston, force per width
    double hot_temperature = 55;  ///< of the bath at the wall
    double cold_temperature = 30; ///< of the start and of the bath at the piston
    double hot_length = 10;       ///< of the bath at the wall
    double cold_length = 10;      ///< of the bath at the piston, at the start
    int piston_columns = 3;
    double bath_rate = 10; ///< of both baths, per unit of time
    double time_step = 4e-4;
    double equilibration = 8; ///< time at the cold temperature before the heating
    std::uint64_t seed = 1;
    int threads = 1;

    /** @throws cases::InputError */
    void validate() const;
  };

  /** Some columns of particles that lie side by side: a layer of constant mass. */
  struct BarLayer
  {
    double mass = 0;     ///< coordinate of its middle: mass per width from the wall on
    double position = 0; ///< mean x
    double temperature = 0;
    double density = 0;      ///< particles per area
    double order = 0;        ///< mean of lattice_order
    double coordination = 0; ///< mean number of partners
  };

  /** A bar at a moment. Masses are per width, and masses of particles are 1. */
  struct BarLook
  {
    double time = 0;      ///< since the heating set in
    double edge = 0;      ///< mass between the wall and the end of the hot bath
    double front = 0;     ///< mass between the wall and the front
    double hot_heat = 0;  ///< that the hot bath has given, per width
    double cold_heat = 0; ///< that the cold bath has given, per width
    double enthalpy = 0;  ///< energy of particles and piston, per width
    double length = 0;    ///< mean x of the piston
    std::vector<BarLayer> layers;

    /** Molten mass per width from the end of the hot bath on: Lagrange's coordinate of
     * the front. */
    double molten() const
    {
      return front - edge;
    }
  };

  /** A bar in motion. */
  class Bar
  {
  public:
    /** Makes the crystal and lets it come to rest at the cold temperature.
     * @throws cases::InputError, cases::NumericalError */
    explicit Bar(const BarSettings &settings);

    /** Go on to a time since the heating set in. @throws cases::NumericalError */
    void advance_to(double time);

    /** Replace the baths. */
    void set_zones(const std::vector<BathZone> &zones)
    {
      motion.set_zones(zones);
    }

    /** @param layer_columns columns of particles in a layer */
    BarLook look(int layer_columns = 2) const;

    const BarSettings &settings() const
    {
      return given;
    }

    const Motion &particles() const
    {
      return motion;
    }

    double width() const
    {
      return motion.period()[1];
    }

  private:
    BarSettings given;
    Motion motion;
    long first_step = 0; ///< in which the heating set in
  };

  /**
   * Where the order of particles drops, as the number of particles on the disordered
   * side: the step function between two values that fits the order of the particles, one
   * after the other along x, best in the sum of squares.
   * @param order in the sequence of x
   * @param middle of the two values
   */
  std::size_t order_step(std::span<const double> order, double middle);

  /**
   * The same as a dividing surface (Gibbs): within a window about the step the order that
   * lacks to that of the solid behind it counts as molten, 1 - q / q_s, so that grains on
   * the wrong side count with their size and do not move the whole step.
   * @param order in the sequence of x
   * @param middle of the orders of solid and liquid
   * @param window particles to each side of the step; the four windows behind it are the
   *   solid
   * @return number of molten particles
   */
  double dividing_surface(std::span<const double> order, double middle,
                          std::size_t window);

  /** What is looked at in a run. */
  struct BarSchedule
  {
    double duration = 50;       ///< time
    double interval = 0.2;      ///< time between looks
    double largest_share = 0.5; ///< the run ends early where so much of the bar is molten
  };

  /** Looks at a bar from the moment on in which its heating sets in. */
  std::vector<BarLook> run_bar(const BarSettings &settings, const BarSchedule &schedule,
                               const std::function<void(double)> &progress = {});
} // namespace meltfront::particles::greenspan

#endif
