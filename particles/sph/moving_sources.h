#ifndef meltfront_particles_sph_moving_sources_h
#define meltfront_particles_sph_moving_sources_h

#include <cases/effect_meter.h>
#include <particles/sph/discretisation.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Point sources that move. The path within a step is divided into parts of at most a
   * quarter of a spacing; the energy of each is spread from its middle over the particles
   * near it with the weights of HeatSources. So a step takes its heat from the source's
   * energy, to round-off, and leaves it along the path.
   */
  class MovingSources
  {
  public:
    explicit MovingSources(const Discretisation &discretisation);

    /** Spread the energy of a step.
     * @throws cases::Refusal where no particle is near the path */
    void prepare_step(double begin, double end);

    /** Add the step's mean power to the heat flows of the particles, in units of
     * `flow_scale`. */
    void add(std::span<double> flow, double flow_scale);

    cases::EffectCost cost() const;

  private:
    struct Share
    {
      std::uint32_t row;
      double power; ///< W m^(d-3)
    };

    std::vector<double> parts_of(const cases::Path &path, double begin, double end) const;
    void spread(const cases::PointSource &source, double begin, double end);

    const Discretisation &dis;
    bool plane;            ///< a slab's source is one: the distance from it counts
    ParticleStorage sites; ///< the particles, along x if the source is a plane
    std::vector<Share> shares;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
