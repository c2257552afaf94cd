#ifndef meltfront_particles_greenspan_motion_motion_h
#define meltfront_particles_greenspan_motion_motion_h

#include <cases/effect_meter.h>
#include <particles/greenspan/motion/force_sweep.h>
#include <particles/greenspan/motion/motion_parameters.h>
#include <particles/greenspan/motion/particle_state.h>

namespace meltfront::particles::greenspan
{
  /** Energies of all particles together, at the time of the positions. */
  struct Energy
  {
    double kinetic = 0;
    double bonds = 0;  ///< shifted potential, so that a pair that parts gives none away
    double height = 0; ///< in the field of gravity
    double piston = 0; ///< work that pushing the piston back has taken since x = 0

    double total() const
    {
      return kinetic + bonds + height + piston;
    }
  };

  /** Of a block of particles. */
  struct SpeedSums
  {
    double sum = 0;     ///< of the squared speeds
    double largest = 0; ///< of them
  };

  /**
   * Particles in motion by leapfrog, equations (2.1) to (2.3) of the report. In step k
   *
   *   r_k = r_{k-1} + dt v_{k-1/2}; base (3.1), (5.1); heat source (4.1); kinetic energy
   *   is added to the temperature sums; v_{k+1/2} = v_{k-1/2} + dt a(r_k).
   *
   * Trajectories have the same bits for any number of threads, any skin, any way to look
   * for neighbours and any order of the particles in memory.
   */
  class Motion
  {
  public:
    /**
     * @throws cases::InputError for a state with values that are not finite, two
     * particles at one place, one below the base or at the source
     */
    Motion(const MotionParameters &parameters, const ParticleState &start);

    /**
     * Take steps.
     * @throws cases::NumericalError in the step in which a velocity is not finite, a
     * particle moves by more than a tenth of a bond, or kinetic energy grows by more than
     * itself and all bonds
     */
    void advance(long steps);

    /**
     * Scale all places and the period of space about the origin.
     * @throws cases::InputError for a factor that is not near 1
     */
    void stretch(double factor);

    /** Replace the baths over parts of space from now on; the heat that they have given
     * is counted anew. */
    void set_zones(const std::vector<BathZone> &zones);

    /** Replace the thermostat from now on. */
    void set_thermostat(const std::optional<Thermostat> &thermostat);

    const MotionParameters &parameters() const
    {
      return given;
    }

    long step() const
    {
      return steps_taken;
    }

    double time() const
    {
      return static_cast<double>(steps_taken) * given.time_step;
    }

    const Period &period() const
    {
      return repetition;
    }

    std::size_t size() const
    {
      return names.size();
    }

    /** Everything, in the order in which the particles were given: a run that starts from
     * it goes on bit for bit. */
    ParticleState state() const;

    /** Accelerations, gravity included, in the order of the given particles. */
    std::array<std::vector<double>, 3> accelerations() const;

    Energy energy() const;

    /** Mean kinetic energy of a particle from the stored velocities, over half the
     * dimension: the temperature with Boltzmann's constant 1. */
    double temperature() const;

    /** Sum of the velocities at the time of the positions. */
    std::array<double, 3> momentum() const;

    /** Kinetic energy that radiation has given since the motion was made. */
    double absorbed() const
    {
      return absorbed_energy;
    }

    /** Kinetic energy that each zone's bath has given since it was set. */
    const std::vector<double> &zone_heat() const
    {
      return heat_of_zones;
    }

    /**
     * Sum over the particles of v_d^2 and over the pairs of r_d f_d, for each direction
     * d: the pressure times area or volume (Clausius) where space repeats itself.
     */
    std::array<double, 3> virial() const;

    /** What an effect has cost so far: sweeps over the base and the heat source, and
     * baths that hold walls. What is a term of another sweep, as gravity is, has neither
     * memory nor time of its own. */
    cases::EffectCost cost(cases::Effect effect) const;

    /** How often the lists of neighbours were made. */
    long list_builds() const
    {
      return builds;
    }

  private:
    void check_start(const ParticleState &start) const;
    void check_boundaries() const;
    void find_pushed_particles();
    void require_distinct_places() const;
    void load(const ParticleState &start);
    void reorder(std::span<const std::uint32_t> order);
    void build_lists();
    void update_lists();
    void take_step();
    void move();
    void move_block(std::size_t block, std::size_t begin, std::size_t end);
    void reflect(std::size_t begin, std::size_t end);
    void reflect_at_wall(std::size_t begin, std::size_t end);
    void heat(std::size_t begin, std::size_t end);
    void add_temperatures(std::size_t begin, std::size_t end);
    void check_speeds();
    void irradiate();
    void exchange_with_bath();
    void exchange_with_zones();
    void push(double duration);
    std::array<double, 3> way(std::size_t from, std::size_t to) const;
    Coordinates raw_accelerations() const;
    [[noreturn]] void fail(const std::string &quantity, const std::string &problem) const;
    [[noreturn]] void explain_broken_motion(double kinetic, double move) const;

    MotionParameters given;
    int dimension;
    Period repetition; ///< of space
    std::unique_ptr<ForceSweep> forces;
    long steps_taken;
    std::vector<std::uint32_t> names;  ///< particle i of memory was given as names[i]
    Coordinates position, velocity;    ///< padded
    Coordinates listed;                ///< positions when the lists were made, padded
    std::vector<double> kinetic_sum;   ///< padded; empty if not kept
    std::vector<std::uint32_t> pushed; ///< places in memory of the piston's particles
    std::vector<double> heat_of_zones;
    NeighbourRows rows;
    long builds = 0;
    double absorbed_energy = 0;
    double travelled
        = 0; ///< bound of what a particle has moved since the lists were made
    double kinetic_before = 0;           ///< kinetic energy in the last step
    std::vector<SpeedSums> block_speeds; ///< of the last step
    double furthest_in_a_step = 0;       ///< allowed
    double all_bonds = 0; ///< work that breaks all bonds of a perfect crystal
    /** Of the first block, which one thread sweeps, or of all particles for baths. */
    cases::EffectMeter base_meter, source_meter, zone_meter, light_meter;
  };
} // namespace meltfront::particles::greenspan

#endif
