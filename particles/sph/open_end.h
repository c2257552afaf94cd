#ifndef meltfront_particles_sph_open_end_h
#define meltfront_particles_sph_open_end_h

#include <cases/effect_meter.h>
#include <particles/sph/conduction_rows.h>
#include <particles/sph/mass_coordinates.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * The end of a slab in mass coordinates through which displaced liquid leaves, or from
   * which it is drawn (effect liquid_motion).
   *
   * Of the particles on the lattice those up to `last` are in the domain; the last one
   * stands for what lies up to the end, one to two spacings, at whose middle its
   * temperature holds. It takes in its neighbour on the way in and leaves another one
   * behind on the way out. What passes the end has the enthalpy of liquid at the wall's
   * temperature, as long as that continues the profile; heat that passes so is booked as
   * the wall's.
   */
  class OpenEnd
  {
  public:
    OpenEnd(const MassCoordinates &coordinates, const Discretisation &discretisation);

    std::uint32_t last() const
    {
      return last_particle;
    }

    /** Distance of the last particle's middle from the end (m of X). */
    double depth() const
    {
      return 0.5 * width;
    }

    /** What the last particle stands for, over a spacing. */
    double share() const
    {
      return width / spacing;
    }

    /** Give particles beyond the end the last one's value, so that it exchanges nothing
     * with them. */
    void hide(std::span<double> values) const;

    /**
     * Make up for the middle of the last particle being farther from its neighbour than a
     * spacing, and take away what particles beyond the end exchange.
     * @param driving what drives heat into the last particle from its neighbour, as in
     * the rows
     */
    void correct(double driving, std::span<double> flow);

    /**
     * Let the end move to where a step has put it.
     * @return heat that this brought into the domain (J/m^2).
     * @throws cases::Refusal where solid lies beyond liquid
     */
    double move(std::span<double> enthalpy, double begin, double end);

    /** Thicknesses in X by particle, none beyond the end (m). */
    void weigh(std::span<double> thickness) const;

    cases::EffectCost cost() const
    {
      return meter.cost(cases::Effect::liquid_motion, sizeof(OpenEnd));
    }

  private:
    double solid_thickness(std::span<const double> enthalpy, double time) const;
    double wall_temperature(double own_enthalpy, double time) const;
    void merge(std::span<double> enthalpy);
    void split(std::span<double> enthalpy, double at_end);

    const MassCoordinates &coordinates;
    const cases::Material &material;
    double spacing;
    std::size_t particles;
    std::uint32_t last_particle;
    double width; ///< of the last particle (m of X)
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
