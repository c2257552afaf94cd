#ifndef meltfront_reference_fem_enthalpy_mush_conduction_h
#define meltfront_reference_fem_enthalpy_mush_conduction_h

#include <cases/scene.h>
#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/conduction_matrix.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Conductivity of an alloy with straight liquidus in local equilibrium, as a function
   * of t = T - T_m (K) and of the depression P (see MushGraph),
   *
   *   k = k_l + (k_s - k_l) min(1, r (1 + P/t))   (mush; r = rho / rho_crystal).
   */
  class MushConductivity
  {
  public:
    MushConductivity(const cases::Material &material, const cases::Alloy &alloy);

    /** Mean of k over the temperatures between two t, k itself where they are the same
     * (W/(m K)). */
    double mean(double a, double b, double depression) const;

  private:
    double solid, liquid;
    double expansion; ///< rho / rho_crystal
    double eutectic;  ///< T_E - T_m (K)
  };

  /**
   * The stiffness matrix with the conductivities of an alloy: between two nodes the mean
   * of k over the temperatures between them, along the equilibrium of either composition
   * (arithmetic mean of both). Within one composition that is Kirchhoff's transform: the
   * heat that flows past a node held on a jump is right on both sides, and without solute
   * the scheme is that of the pure substance.
   */
  class MushConduction
  {
  public:
    MushConduction(const ConductionMatrix &unit, const cases::Material &material,
                   const cases::Alloy &alloy, const std::vector<double> &depression);

    const ConductionMatrix &matrix() const
    {
      return mixed;
    }

    /** Find the conductances at the temperatures t; returns their largest relative
     * change, which adopt() makes. */
    double renew(const CompensatedVector &excess);
    void adopt();

    long bytes() const;

  private:
    const ConductionMatrix &unit;
    MushConductivity conductivity;
    const std::vector<double> &depression; ///< by node (K)
    ConductionMatrix mixed;
    std::vector<double> renewed; ///< conductances
  };
} // namespace meltfront::reference_fem

#endif
