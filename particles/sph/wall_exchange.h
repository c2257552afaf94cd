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
   * behind a layer of its depth, through which heat flows steadily. What the layer is
   * made of is told by those who add the heat; of one substance it is of the particle's
   * own phase, or, while that melts, up to the front within it, of the phase that the
   * surroundings make. Where they make another than the particle's, a front is on its way
   * from the wall to the particle: half way, as between particles (SubParticlePair), if
   * more heat passes through this phase then, so that a particle that conducts badly does
   * not shut the wall off. This fades with latent over sensible heat.
   */
  class WallExchange
  {
  public:
    /** @throws cases::Refusal for particles on the walls */
    WallExchange(const Discretisation &discretisation, const ConductionRows &rows);

    void prepare_step(double begin, double end);

    /**
     * Add the walls' heat to the particles' flows, in units of `flow_scale`:
     * through(row, wall, ambient temperature, depth) in W/m^2.
     * @return heat flow into the scene, in the flows' unit.
     */
    template <typename Through>
    double add(const Through &through, double fraction, std::span<double> flow,
               double flow_scale)
    {
      return meter.measure(
          [&]
          {
            ExactSum sum;
            visit(fraction,
                  [&](const WallLink &link, const cases::Boundary &wall, double ambient,
                      double depth)
                  {
                    const double heat = link.strength
                                        * through(link.row, wall, ambient, depth)
                                        / flow_scale;
                    flow[link.row] += heat;
                    sum.add(heat);
                  });
            return own.total(sum);
          });
    }

    /** The same of one substance. */
    double add(double fraction, std::span<const double> enthalpy, std::span<double> flow,
               double flow_scale);

    /** Add to the rows' entries of `diagonal` how this heat follows the particles'
     * enthalpies: rate(row, wall, ambient temperature, depth) in W/m^2 per J/kg. */
    template <typename Rate>
    void differentiate(const Rate &rate, double fraction, std::span<double> diagonal,
                       double flow_scale) const
    {
      visit(fraction,
            [&](const WallLink &link, const cases::Boundary &wall, double ambient,
                double depth)
            {
              diagonal[link.row]
                  += link.strength * rate(link.row, wall, ambient, depth) / flow_scale;
            });
    }

    /** The same of one substance. */
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
    template <typename Visitor>
    void visit(double fraction, const Visitor &visitor) const
    {
      for(std::size_t i = 0; i < links.size(); ++i)
        visitor(links[i], *boundaries[i], values.at(links[i].point, fraction), depths[i]);
    }

    /** What lies between a wall and a particle's temperature. */
    struct Layer
    {
      double temperature; ///< behind it (K)
      double resistance;  ///< m^2 K/W
      double warming;     ///< dT/dH (K kg/J)
      double growth;      ///< dR/dH
    };
    Layer layer(const cases::Boundary &wall, double depth, double enthalpy,
                double ambient) const;
    Layer melting_layer(const cases::Boundary &wall, double depth, double enthalpy,
                        double ambient) const;

    /** Heat from the wall and how it follows the particle's enthalpy. */
    struct Exchange
    {
      double flux; ///< W/m^2
      double rate; ///< W/m^2 per J/kg
    };
    Exchange exchange(const cases::Boundary &wall, double depth, double enthalpy,
                      double ambient) const;

    struct CellAcross
    {
      const cases::Boundary *wall;
      double thickness; ///< of the cells beside it (m)
    };
    double cell_across(const cases::Boundary &wall) const;

    const OwnParticles &own;
    const cases::Material &material;
    double sharp_latent_heat; ///< exchanged at one temperature (J/kg)
    std::vector<CellAcross> cells_across;
    std::vector<WallLink> links;
    std::vector<double> depths;
    std::vector<const cases::Boundary *> boundaries; ///< by link
    WallValues values;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
