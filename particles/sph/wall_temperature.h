#ifndef meltfront_particles_sph_wall_temperature_h
#define meltfront_particles_sph_wall_temperature_h

#include <cases/effect_meter.h>
#include <particles/sph/phase_map.h>
#include <particles/sph/wall_values.h>

#include <span>

namespace meltfront::particles
{
  /**
   * Walls with a prescribed temperature. In the cell layout particles exchange heat with
   * points of the wall; in the edge layout particles on the wall hold its temperature,
   * set anew after each step, and their heat is booked as the wall's (Monaghan et al.
   * 2005, section 2.3.2).
   */
  class WallTemperature
  {
  public:
    WallTemperature(const Discretisation &discretisation, const ConductionRows &rows,
                    const ConductionVariable &variable);

    void prepare_step(double begin, double end);

    /**
     * Add the heat from the walls to the particles' flows, exchange(row, variable of the
     * wall) times the links' strengths; particles that hold a wall's temperature keep
     * none.
     * @return heat flow into the scene, in the flows' unit.
     */
    template <typename Exchange>
    double add(const Exchange &exchange, double fraction, std::span<double> flow)
    {
      return meter.measure(
          [&]
          {
            for(std::size_t p = 0; p < wall_variable.size(); ++p)
              wall_variable[p] = variable.of_temperature(values.at(p, fraction));
            ExactSum sum;
            for(const WallLink &link : links)
            {
              const double heat
                  = link.strength * exchange(link.row, wall_variable[link.point]);
              flow[link.row] += heat;
              sum.add(heat);
            }
            for(const std::uint32_t row : dirichlet)
            {
              sum.add(-flow[row]);
              flow[row] = 0;
            }
            return own.total(sum);
          });
    }

    /**
     * Add the links' strengths times rate(row, variable of the wall) to the rows' entries
     * of `diagonal`: how the heat from the walls follows each particle's own state.
     */
    template <typename Rate>
    void differentiate(const Rate &rate, double fraction, std::span<double> diagonal)
    {
      for(std::size_t p = 0; p < wall_variable.size(); ++p)
        wall_variable[p] = variable.of_temperature(values.at(p, fraction));
      for(const WallLink &link : links)
        diagonal[link.row] += link.strength * rate(link.row, wall_variable[link.point]);
    }

    /** Particles on the walls. */
    std::span<const std::uint32_t> dirichlet_rows() const
    {
      return dirichlet;
    }

    /**
     * Set the particles on the walls to the temperature at a fraction of the step.
     * @return heat that this took from the walls (J in the measure of the scene).
     */
    double hold(double fraction, std::span<double> enthalpy);

    /** The same where enthalpy_at(row, temperature) gives the enthalpy (J/kg). */
    template <typename EnthalpyAt>
    double hold(double fraction, std::span<double> enthalpy,
                const EnthalpyAt &enthalpy_at) const
    {
      double heat = 0;
      for(std::size_t i = 0; i < dirichlet.size(); ++i)
      {
        double &own = enthalpy[dirichlet[i]];
        const double wall
            = enthalpy_at(dirichlet[i], values.at(dirichlet_links[i].point, fraction));
        heat += dirichlet_weights[i] * (wall - own);
        own = wall;
      }
      return heat;
    }

    /** Let another particle have the links of one, with another strength. */
    void relink(std::uint32_t from, std::uint32_t to, double strength)
    {
      for(WallLink &link : links)
        if(link.row == from)
          link = {to, link.point, strength};
    }

    /** Links to walls, the entries that one pass touches. */
    std::size_t size() const
    {
      return links.size() + dirichlet.size();
    }

    cases::EffectCost cost() const;

  private:
    const OwnParticles &own;
    const ConductionVariable &variable;
    const cases::Material &material;
    std::vector<WallLink> links;
    std::vector<WallLink>
        dirichlet_links; ///< a particles on Dirichlet walls and its point
    std::vector<std::uint32_t> dirichlet;
    std::vector<double> dirichlet_weights; ///< mass in the measure of the scene
    WallValues values;
    std::vector<double> wall_variable;
    cases::EffectMeter meter;
  };
} // namespace meltfront::particles

#endif
