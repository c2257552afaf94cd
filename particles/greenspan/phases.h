#ifndef meltfront_particles_greenspan_phases_h
#define meltfront_particles_greenspan_phases_h

#include <particles/greenspan/motion/bonds.h>

#include <deque>

namespace meltfront::particles::greenspan
{
  /** Which particles may belong to a solid (1) and which are too hot for it (0). */
  using Cold = std::vector<char>;

  /** What is asked of a particle beside that it be the corner of a triangle of bonds. */
  enum class PhaseTest
  {
    average_speed, ///< section 4: no faster on average than 7.5
    temperature,   ///< section 5: mean kinetic energy since the start below 25
    order          ///< partners about it as in a crystal, see cold_by_order()
  };

  inline constexpr double critical_speed = 7.5, critical_temperature = 25;

  /**
   * Average velocities v* = (r_k - r_{k-M}) / (M dt) over M steps, equation (4.2), which
   * prints velocities where positions must stand: M dt = 0.1 makes a velocity of them
   * only, and a cold solid would be a fluid otherwise.
   */
  class AverageVelocity
  {
  public:
    /**
     * @param interval steps between positions that are handed over
     * @param window M, a multiple of the interval
     * @throws cases::InputError if it is none
     */
    AverageVelocity(long interval, double time_step, long window = 1000);

    /** Hand over the positions of the next interval. */
    void record(const ParticleState &state);

    /** Positions that were handed over within the window, oldest first. */
    std::vector<std::array<std::vector<double>, 3>> recorded() const
    {
      return {position.begin(), position.end()};
    }

    /** Go on from them. */
    void resume(const std::vector<std::array<std::vector<double>, 3>> &positions)
    {
      position.assign(positions.begin(), positions.end());
    }

    /** Whether M steps have been seen. */
    bool known() const;

    /** |v*| of all particles. @throws cases::InputError before it is known */
    std::vector<double> speed() const;

    /** Particles with |v*| <= 7.5, and all before it is known. */
    Cold cold() const;

  private:
    std::size_t frames;
    double duration;
    std::deque<std::array<std::vector<double>, 3>> position; ///< oldest first
  };

  /** Temperature of each particle: mean kinetic energy over the steps taken. */
  std::vector<double> temperatures(const ParticleState &state);

  /** Particles with a temperature below 25. */
  Cold cold_by_temperature(const ParticleState &state);

  /** Particles of the plane for which psi_6, averaged over them and their partners
   * (Lechner and Dellago 2008), is larger than a half: it is about 0.75 in a crystal near
   * its melting point, whatever its orientation, and below 0.4 in its liquid. */
  Cold cold_by_order(const ParticleState &state, const BondGraph &bonds);
} // namespace meltfront::particles::greenspan

#endif
