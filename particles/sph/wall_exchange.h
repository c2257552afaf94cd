#ifndef meltfront_particles_sph_wall_exchange_h
#define meltfront_particles_sph_wall_exchange_h

#include <cases/effect_meter.h>
#include <cases/wall_law.h>
#include <particles/sph/wall_values.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * Walls that exchange heat with their surroundings, by heat transfer or radiation. Each
   * particle near such a wall takes its share of the wall's area, as of a flux, and lies
   * behind a layer through which heat flows steadily: of its depth and its own phase, or,
   * while it melts, up to the front within it, of the phase that the surroundings make.
   */
  class WallExchange
  {
  public:
    WallExchange(const Discretisation &discretisation, const ConductionRows &rows);

    void prepare_step(double begin, double end);

    /**
     * Add the walls' heat to the particles' flows, in units of `flow_scale`.
     * @return heat flow into the scene, in the flows' unit.
     */
    double add(double fraction, std::span<const double> enthalpy, std::span<double> flow,
               double flow_scale);

    /** Add to the rows' entries of `diagonal` how this heat follows the particles'
     * enthalpies. */
    void differentiate(double fraction, std::span<const double> enthalpy,
                       std::span<double> diagonal, double flow_scale) const;

    /** Let another particle have the links of one, at another depth. */
    void relink(std::uint32_t from, std::uint32_t to, double depth)
    {
      for(std::size_t i = 0; i < links.size(); ++i)
        if(links[i].row == from)
        {
          links[i].row = to;
          depths[i] = depth;
        }
    }

    /** Links to walls, the entries that one pass touches. */
    std::size_t size() const
    {
      return links.size();
    }

    cases::EffectCost cost(cases::Effect effect) const;

  private:
    /** What lies between a wall and a particle's temperature. */
    struct Layer
    {
      double temperature; ///< behind it (K)
      double resistance;  ///< m^2 K/W
      double warming;     ///< dT/dH (K kg/J)
      double growth;      ///< dR/dH
    };
    Layer layer(std::size_t link, double enthalpy, double ambient) const;
    Layer melting_layer(std::size_t link, double enthalpy, double ambient) const;

    const cases::Material &material;
    double sharp_latent_heat; ///< exchanged at one temperature (J/kg)
    double spacing;
    std::vector<WallLink> links;
    std::vector<double> depths;
    std::vector<const cases::Boundary *> boundaries; ///< by link
    WallValues values;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
