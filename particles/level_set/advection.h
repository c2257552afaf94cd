#ifndef meltfront_particles_level_set_advection_h
#define meltfront_particles_level_set_advection_h

#include <particles/level_set/runge_kutta.h>

#include <functional>

namespace meltfront::particles::level_set
{
  /** Velocities at points at a time (m/s), as cases::VelocityField::velocities gives
   * them; called once per stage with all nodes of the band. */
  using VelocityFunction = std::function<void(const cases::PointArrays &, double,
                                              const std::array<std::span<double>, 3> &)>;

  /** What a velocity field gives; it must outlive the function. */
  VelocityFunction velocity_function(const cases::VelocityField &field);

  /** A step of time. */
  struct TimeStep
  {
    long number = 0;   ///< for messages
    double time = 0;   ///< at its start (s)
    double length = 0; ///< s
  };

  /**
   * phi_t + u . grad phi = 0: the front carried along with a velocity. Derivatives by
   * WENO of fifth order from the side that each component of the velocity comes from
   * (Jiang and Peng 2000), Runge-Kutta steps of order 3.
   */
  class Advection
  {
  public:
    /**
     * Move the front on by a step; the band follows.
     * @throws cases::NumericalError if a component of the velocity crosses more than one
     * spacing in the step, or if phi is no longer a number
     */
    void step(LevelSet &level_set, const VelocityFunction &velocity,
              const TimeStep &time_step);

    /** Longest step in which no component of the velocity at the band's nodes crosses
     * more than `courant_number` spacings; infinite where all is at rest (s). */
    double longest_step(const LevelSet &level_set, const VelocityFunction &velocity,
                        double time, double courant_number = 0.5);

  private:
    void find_velocities(const LevelSet &level_set, const VelocityFunction &velocity,
                         double time);
    double largest_component(const LevelSet &level_set) const;

    RungeKutta runge_kutta;
    std::array<std::vector<double>, 3> velocities; ///< along the band
  };
} // namespace meltfront::particles::level_set

#endif
