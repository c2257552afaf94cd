#ifndef meltfront_particles_sph_heat_sources_h
#define meltfront_particles_sph_heat_sources_h

#include <cases/effect_meter.h>
#include <particles/sph/discretisation.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Point sources that stay where they are, spread over the particles near them with
   * normalised kernel weights zeta V_a W(r_a - R), zeta = 1/sum_b V_b W(r_b - R)
   * (Monaghan et al. 2005, equations 2.10 and 2.11).
   *
   * A step takes its heat from the source's energy, not from its power: what was removed
   * by any time is exact to round-off whatever the power does within a step.
   */
  class HeatSources
  {
  public:
    explicit HeatSources(const Discretisation &discretisation);

    /** Average the sources' power over a step. */
    void prepare_step(double begin, double end);

    /** Add the step's mean power to the heat flows of the particles, in units of
     * `flow_scale`. */
    void add(std::span<double> flow, double flow_scale);

    /** Heat that all sources, those that move as well, gave to the particles from the
     * start of the scene to a time (J m^(d-3)). */
    double heat(double time) const;

    cases::EffectCost cost() const;

  private:
    struct Weight
    {
      std::uint32_t row;
      std::uint32_t source;
      double weight;
    };

    double scale; ///< from the source's unit to that of the simulated strip
    const std::vector<cases::PointSource> &sources;
    double start_time;
    std::vector<Weight> weights;
    std::vector<double> power;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
