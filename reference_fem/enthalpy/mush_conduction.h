#ifndef meltfront_reference_fem_enthalpy_mush_conduction_h
#define meltfront_reference_fem_enthalpy_mush_conduction_h

#include <cases/scene.h>
#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/liquidus.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Conductivity of an alloy in local equilibrium, as a function of t = T - T_m (K) and
   * of the composition (see MushGraph),
   *
   *   k = k_l + (k_s - k_l) min(1, r (1 - X/y(-t)))   (mush; r = rho / rho_crystal),
   *
   * r (1 + P/t) where the liquidus is straight.
   */
  class MushConductivity
  {
  public:
    MushConductivity(const cases::Material &material, const cases::Alloy &alloy);

    /** Mean of k over the temperatures between two t, k itself where they are the same
     * (W/(m K)). */
    double mean(double a, double b, const Composition &node) const;

  private:
    double full_excess(const Composition &node) const;
    double molten(double low, double span, const Composition &node) const;

    Liquidus line;
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
                   const cases::Alloy &alloy,
                   const std::vector<Composition> &composition);

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
    const std::vector<Composition> &composition; ///< by node
    ConductionMatrix mixed;
    std::vector<double> renewed; ///< conductances
  };
} // namespace meltfront::reference_fem

#endif
