#ifndef meltfront_particles_sph_liquid_outlet_h
#define meltfront_particles_sph_liquid_outlet_h

#include <particles/sph/conduction_rows.h>
#include <particles/sph/liquid_balance.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /** A wall that liquid leaves through, or is drawn in: the particles beside it, and the
   * heat of what passes. */
  class LiquidOutlet
  {
  public:
    /** A particle beside the wall. The liquid that passes there has the sensible heat
     * own_share s + given, s that of the particle (J/m^3). */
    struct Opening
    {
      std::uint32_t particle;
      double strength; ///< volume per potential of the particle (m^(d-2))
      double depth;    ///< of the particle behind the wall (m)
      cases::Position place;
      double own_share, given;

      double sensible_heat(double own) const
      {
        return own_share * own + given;
      }
    };

    /** @param conduction rows in which a temperature is given in the outlet alone */
    LiquidOutlet(const LiquidBalance &balance, const Discretisation &discretisation,
                 const ConductionRows &conduction);

    /** What passes has the temperature of the wall at a time: the wall's own, or that to
     * which its law leads beyond the particle. */
    void follow(double time, std::span<const double> enthalpy);

    std::span<const Opening> openings() const
    {
      return list;
    }

    std::vector<std::uint32_t> particles() const;

    /** The openings' strengths by particle, zero of others. */
    std::vector<double> strengths(std::size_t particles) const;

  private:
    const cases::Scene &scene;
    const cases::Boundary &wall;
    std::vector<Opening> list;
  };
} // namespace meltfront::particles

#endif
