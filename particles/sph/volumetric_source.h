#ifndef meltfront_particles_sph_volumetric_source_h
#define meltfront_particles_sph_volumetric_source_h

#include <cases/effect_meter.h>
#include <cases/time_integral.h>
#include <particles/sph/discretisation.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Heat released throughout the domain: each particle takes the power density at its
   * place (cases::mean_release) times its volume, averaged over the step
   * (cases::TimeMean).
   *
   * What was released by the end of a step is the sum of what the steps gave to the
   * particles, so that the budget closes to round-off.
   */
  class VolumetricSource
  {
  public:
    explicit VolumetricSource(const Discretisation &discretisation);

    /** Average over a step. A step may be prepared anew, or in halves: it begins at the
     * start or where one prepared before ended. */
    void prepare_step(double begin, double end);

    /** Add the step's mean power to the heat flows of the particles, in units of
     * `flow_scale`. */
    void add(std::span<double> flow, double flow_scale);

    /** Heat given to all particles from the start to the end of a step that was prepared
     * (J m^(d-3)). */
    double heat(double time) const;

    cases::EffectCost cost() const;

  private:
    /** What was released by a time. */
    struct Released
    {
      double time;
      double heat;
    };

    void find_power(double begin, double end);

    const Discretisation &dis;
    cases::TimeMean density;
    std::vector<double> power; ///< W m^(d-3)
    bool power_known = false;
    std::vector<Released> released;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
