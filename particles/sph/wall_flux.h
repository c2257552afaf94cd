#ifndef meltfront_particles_sph_wall_flux_h
#define meltfront_particles_sph_wall_flux_h

#include <cases/effect_meter.h>
#include <particles/sph/wall_values.h>

#include <span>

namespace meltfront::particles
{
  /**
   * Walls with a prescribed heat flux: each particle near such a wall takes the flux on
   * its share of the wall's area. The shares come from the mirror images' gradient and
   * add up to the wall's area. A step takes the flux's mean over it, so that what has
   * come in is the flux's integral whatever it does within a step.
   */
  class WallFlux
  {
  public:
    WallFlux(const Discretisation &discretisation, const ConductionRows &rows);

    void prepare_step(double begin, double end);

    /**
     * Add the walls' heat to the particles' flows, in units of `flow_scale`.
     * @return heat flow into the scene, in the flows' unit.
     */
    double add(double fraction, std::span<double> flow, double flow_scale);

    /** Let another particle have the links of one. */
    void relink(std::uint32_t from, std::uint32_t to)
    {
      for(WallLink &link : links)
        if(link.row == from)
          link.row = to;
    }

    /** Links to walls, the entries that one pass touches. */
    std::size_t size() const
    {
      return links.size();
    }

    cases::EffectCost cost() const;

  private:
    const OwnParticles &own;
    std::vector<WallLink> links;
    WallValues values;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
