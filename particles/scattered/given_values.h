#ifndef meltfront_particles_scattered_given_values_h
#define meltfront_particles_scattered_given_values_h

#include <cases/time_integral.h>

#include <array>
#include <optional>

namespace meltfront::particles
{
  /** The step in which a right-hand side is asked for. */
  struct LinearStep
  {
    double before, begin, end; ///< s; before == begin: no step before counts
    /** Share of the difference to the mean over the step before that a mean is to be
     * increased by: w/(1 + w) in BDF2, w the step over the one before, whose recursion
     * then adds up to the integral E over time exactly, as with equal steps
     * (3 E_n - 4 E_(n-1) + E_(n-2))/(2 dt) does; else 0. */
    double share_before;
    double at; ///< when what holds at each time is to hold (s)
  };

  /** No step, but a time. */
  LinearStep steady_step(double time);

  /** What a scene's walls and the heat released in it bring into a step: means over time,
   * so that what has come in is the integral of what the scene prescribes. */
  class GivenValues
  {
  public:
    /** @param scene outlives this */
    explicit GivenValues(const cases::Scene &scene);

    /** Heat released (W/m^3). */
    double release(const cases::Position &position, const LinearStep &step) const;

    /** A wall's flux, or ambient temperature. */
    double wall(const cases::Boundary &boundary, const cases::Position &position,
                const LinearStep &step) const;

    /** The same for an equation without a derivative in time: the value at step.at, but
     * where it breaks in the step or the one before, what adds up to the integral. */
    double constraint(const cases::Boundary &boundary, const cases::Position &position,
                      const LinearStep &step) const;

    /** The means of a wall's flux or ambient temperature. */
    const cases::TimeMean &mean_of(const cases::Boundary &boundary) const;

  private:
    const cases::Scene &scene;
    std::array<std::optional<cases::TimeMean>, cases::n_sides> walls;
    std::optional<cases::TimeMean> released;
  };
} // namespace meltfront::particles

#endif
