#ifndef meltfront_particles_sph_mixture_mixture_derivative_h
#define meltfront_particles_sph_mixture_mixture_derivative_h

#include <particles/sph_mixture/equilibrium_branches.h>
#include <particles/sph_mixture/mixture_conduction.h>
#include <particles/sph_mixture/mixture_exchange_derivative.h>

#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * How the heat that a mixture's particles exchange follows their enthalpies, their
   * compositions kept: the chain of T(H) and k(H) on each particle's branch and of the
   * exchange, which is differentiated in full.
   */
  class MixtureDerivative
  {
  public:
    MixtureDerivative(const AlloySubstance &substance,
                      const MixtureConduction &conduction, std::size_t particles);

    /** Take the equilibria that the conduction followed last. */
    void linearise(const ParticleOperator &rows, std::span<const double> enthalpy,
                   std::span<const std::span<const double>> concentration, int threads);

    /** The sum of the rows for a change of the enthalpies. */
    void apply(const ParticleOperator &rows, std::span<const double> change,
               std::span<double> flow_change, int threads);

    /** How each row's sum follows its own particle's enthalpy. */
    std::span<const double> row_diagonal() const
    {
      return diagonal;
    }

    /** How MixtureConduction::from_wall follows the particle's enthalpy. */
    double from_wall(std::size_t row, double wall_excess) const;

    /** How MixtureConduction::from_surroundings does. */
    double from_surroundings(std::size_t row, const cases::Boundary &wall, double ambient,
                             double depth) const;

    /** Add a correction, each particle to the next kink of its T(H) at most. */
    void correct(std::span<const double> correction, std::span<double> enthalpy) const;

  private:
    void find_slopes_of(std::span<const double> enthalpy,
                        std::span<const std::span<const double>> concentration);
    void linearise_integral(std::size_t row);

    /** visit(derivative) with that of the exchange at hand. */
    template <typename Visit>
    void with_derivative(const Visit &visit) const;

    const AlloySubstance &substance;
    const MixtureConduction &conduction;
    std::size_t n;
    std::vector<EquilibriumBranches> branches;
    std::vector<double> slope;      ///< dT/dH, or of the transformed temperature
    std::vector<double> k, k_slope; ///< conductivity and dk/dH, of a mean of two
    std::vector<double> linear, weight, inverse, own; ///< of IntegralMeanDerivative
    std::vector<double> change_of_value, change_of_k;
    std::vector<double> diagonal;
  };
} // namespace meltfront::particles

#endif
