#ifndef meltfront_particles_sph_mixture_mixture_conduction_h
#define meltfront_particles_sph_mixture_mixture_conduction_h

#include <cases/snapshot.h>
#include <cases/wall_law.h>
#include <particles/alloy/solid_path.h>
#include <particles/core/particle_operator.h>
#include <particles/sph/phase_map.h>
#include <particles/sph_mixture/mixture_exchange.h>
#include <particles/sph_mixture/parameters.h>

#include <array>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /** How conduction is computed, the cheapest that the scene allows. */
  enum class ConductionForm
  {
    uniform,     ///< one conductivity
    transformed, ///< one transformed temperature, the same function for all particles
    integral,    ///< integrals along the compositions of both partners
    arithmetic,
    harmonic
  };

  /**
   * Local equilibrium of all particles and the heat that they exchange.
   *
   * follow() finds temperature and liquid fraction from enthalpy and composition, and
   * what the exchange needs of them; with_pair() hands out the exchange, conduct()
   * applies the rows with it.
   */
  class MixtureConduction
  {
  public:
    /** @param uniform all particles have one composition and keep it. */
    MixtureConduction(const AlloySubstance &substance, MeanConductivity mean,
                      bool uniform, std::size_t particles, std::size_t padded);

    /** New temperatures. @param concentration one array per solute. */
    Extremes follow(std::span<const double> enthalpy,
                    std::span<const std::span<const double>> concentration, int threads);

    void conduct(const ParticleOperator &rows, std::span<double> flow, int threads) const;

    /** visit(pair), pair(a, b) the heat flow from b to a per strength of the link. */
    template <typename Visit>
    void with_pair(const Visit &visit) const
    {
      switch(used_form)
      {
      case ConductionForm::integral:
        visit(IntegralMeanPair{value.data(), above_eutectic.data(), logarithm.data(),
                               depression.data(), constant.data(), own.data(),
                               0.5 * difference, path});
        break;
      case ConductionForm::arithmetic:
        visit(ArithmeticMeanPair{excess.data(), value.data()});
        break;
      case ConductionForm::harmonic:
        visit(HarmonicMeanPair{excess.data(), value.data()});
        break;
      default:
        visit(DifferencePair{value.data()});
      }
    }

    /** Heat flow to a particle from a wall, per strength of the link. */
    double from_wall(std::size_t row, double wall_excess) const;

    /** Of a wall's mixture, which has the composition of the particle next to it. */
    double wall_conductivity(std::size_t row, double wall_excess) const;

    /**
     * What flows in through a wall by its law and, steadily, through the layer between
     * wall and particle, which has the particle's composition. Where conduction follows
     * the integral of k over the temperature, so does the layer: d law(T_wall) is the
     * integral of k from the particle's temperature to the wall's, which is found by
     * Newton's method, bisecting where that leaves what is known to hold the root. Else
     * the layer conducts as the particle.
     * @param depth d of the particle behind the wall (m)
     */
    cases::HeatThroughLayer from_surroundings(std::size_t row,
                                              const cases::Boundary &wall, double ambient,
                                              double depth) const;

    /** Of a particle (W/(m K)). */
    double conductivity(std::size_t row) const
    {
      return substance.diagram.conductivity(1 - liquid[row]);
    }

    /** T - T_m of the particles, as of the last follow(). */
    std::span<const double> temperature_excess() const
    {
      return excess;
    }

    /** By mass. */
    std::span<const double> liquid_fraction() const
    {
      return liquid;
    }

    std::span<const double> depressions() const
    {
      return depression;
    }

    ConductionForm form() const
    {
      return used_form;
    }

    std::size_t bytes() const;

  private:
    template <typename Equilibrium>
    Extremes find_equilibrium(const Equilibrium &equilibrium, int threads);
    void prepare_exchange(int threads);
    cases::HeatThroughLayer through_equilibrium(std::size_t row,
                                                const cases::Boundary &wall,
                                                double ambient, double depth) const;
    void set_depression(int threads);
    double composition(std::size_t solute, std::size_t row) const
    {
      return concentrations[solute].empty() ? 0. : concentrations[solute][row];
    }

    const AlloySubstance &substance;
    SolidPath path;
    std::size_t n;
    ConductionForm used_form;
    double liquid_conductivity, difference;
    std::array<std::span<const double>, cases::most_solutes> concentrations{};
    std::vector<double> excess, liquid, depression;
    std::vector<double> value; ///< transformed temperature, conductivity, or linear part
    std::vector<double> above_eutectic, logarithm, constant, own; ///< of IntegralMeanPair
  };
} // namespace meltfront::particles

#endif
