#ifndef meltfront_particles_greenspan_motion_motion_parameters_h
#define meltfront_particles_greenspan_motion_motion_parameters_h

#include <particles/greenspan/motion/neighbour_rows.h>
#include <particles/greenspan/motion/pair_force.h>

#include <optional>

namespace meltfront::particles::greenspan
{
  /**
   * The base y = 0, which throws back what falls below it: y -> -y, v_x -> 0,
   * v_y -> -gamma v_y, equation (3.1). Where |x| < hot_half_width it is heated,
   * gamma = hot_left - hot_slope (x + hot_half_width), equation (5.1).
   */
  struct Base
  {
    double restitution = 0.1;  ///< gamma outside of the heated part
    double hot_half_width = 0; ///< 0: nothing is heated
    double hot_left = 1.5;     ///< gamma at the left end of the heated part
    double hot_slope = 0.025;  ///< loss of gamma per length to the right
  };

  /** So many steps with such a strength. */
  struct HeatStage
  {
    long steps;
    double strength; ///< Gamma: velocity added in each step at distance 1
  };

  /**
   * A source that drives the particles nearer than `reach` away from itself, equation
   * (4.1): v += Gamma / R^power (r - s) / R in each step. It adds per step whatever the
   * time step is: with another step keep Gamma over time step.
   */
  struct HeatSource
  {
    std::array<double, 3> position{};
    std::vector<HeatStage> stages; ///< in turn; the last holds on
    double power = 2; ///< 2: as printed; -2: what the figures of the report need
    double reach = 2.5;

    /** Gamma of a step, counted from 1. */
    double strength(long step) const;
  };

  /**
   * Light that heats what it reaches (section 6 of the report names it as work to come):
   * a particle of which no other hides the source receives energy. Each `interval` steps
   * the kinetic energy of a particle grows by what it caught.
   */
  struct Radiation
  {
    bool parallel = false; ///< rays along `direction`; else from `position`
    std::array<double, 3> position{};
    std::array<double, 3> direction{0, -1, 0};
    double power = 0;  ///< energy per time: of the point all around, of rays per width
                       ///< of the plane or area of space
    double radius = 0; ///< of the particles; 0: half of the equilibrium distance
    long interval = 20;
  };

  /**
   * A bath (Langevin): v -> c v + sqrt(T (1 - c^2)) xi after each step, c = exp(-rate
   * dt), xi normal numbers that depend on seed, step and particle only. Its temperature
   * goes from the first to the last in so many steps.
   */
  struct Thermostat
  {
    double first_temperature = 0;
    double last_temperature = 0;
    long steps = 1;  ///< after which the last temperature holds
    double rate = 1; ///< per unit of time
    std::uint64_t seed = 1;

    /** A temperature at a step. */
    struct Moment
    {
      long step;
      double temperature;
    };
    /** Where not empty: temperatures at ascending steps, linear between them, in place of
     * the first and the last. */
    std::vector<Moment> course{};

    double temperature(long step) const;
  };

  /** A bath over a part of space only: over the particles with begin <= x < end at the
   * step, x within one period where space repeats itself. */
  struct BathZone
  {
    double begin = 0;
    double end = 0;
    Thermostat bath;
  };

  /** Particles that are pushed against the direction of x by a constant force each. */
  struct Piston
  {
    std::vector<std::uint32_t> particles;
    double force = 0; ///< on each
  };

  /** What moves the particles. */
  struct MotionParameters
  {
    PairForce force;
    double time_step = 1e-4;
    double gravity = 32; ///< downward, along y
    std::optional<Base> base;
    std::optional<HeatSource> source;
    std::optional<Radiation> radiation;
    std::optional<Thermostat> thermostat;
    std::vector<BathZone> zones;
    std::optional<Piston> piston;
    bool wall = false;         ///< x = 0 throws back what falls on it, without loss
    double drag = 0;           ///< velocities fade by exp(-drag time_step) in each step
    bool temperatures = false; ///< keep the sums of kinetic energy

    double skin = 0.3; ///< neighbours are kept that much beyond the cutoff
    NeighbourRows::Search search = NeighbourRows::Search::automatic;
    int threads = 1; ///< the motion has the same bits for any number

    /** @throws cases::InputError for values that make no sense in this dimension. */
    void validate(int dimension) const;
  };
} // namespace meltfront::particles::greenspan

#endif
