#ifndef meltfront_reference_fem_enthalpy_solute_diffusion_h
#define meltfront_reference_fem_enthalpy_solute_diffusion_h

#include <cases/method.h>
#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/linear_solver.h>
#include <reference_fem/enthalpy/mesh.h>

#include <functional>
#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  using LinearSolverMaker
      = std::function<std::unique_ptr<LinearSolver>(const ConductionMatrix &)>;

  /**
   * The effect solute_diffusion: solute that spreads in the liquid of every site,
   *
   *   d(rho C)/dt = div(f rho D grad C_l),   C = f C_l + C_fixed,
   *
   * C the mass fraction of all that is at a node, C_l that of its liquid, f the liquid's
   * mass fraction and C_fixed what eutectic solid holds. With lumped masses and f
   * averaged harmonically between neighbours (no solute passes a solid node), an implicit
   * step is
   *
   *   m_i f_i C_l,i + c D sum_j g_ij (C_l,i - C_l,j) = supply_i - m_i C_fixed,i .
   *
   * C follows from what flows between neighbours, the same number with both signs: solute
   * is conserved to round-off whatever the linear solver leaves. The matrix is an
   * M-matrix wherever that of conduction is one: C_l then obeys a maximum principle.
   */
  class SoluteDiffusion
  {
  public:
    SoluteDiffusion(const Discretisation &mesh, double density,
                    const LinearSolverMaker &make_linear_solver);

    /** State f by node, zero where there is no liquid. */
    void set_liquid(const std::vector<double> &mass_fraction);

    /**
     * Make a step.
     *
     * @param c step size over the leading coefficient of the time scheme (s)
     * @param diffusivity D (m^2/s)
     * @param supply m_i times the concentrations that the time scheme starts from (kg)
     * @param fixed C_fixed by node
     * @param concentration C: first guess and solution
     */
    void step(double c, double diffusivity, const std::vector<double> &supply,
              const std::vector<double> &fixed, std::vector<double> &concentration);

    long work() const;

    const cases::EffectCost &cost() const
    {
      return effect_cost;
    }

  private:
    const Discretisation &mesh;
    double density;
    ConductionMatrix network; ///< f rho g_ij
    std::unique_ptr<LinearSolver> linear_solver;
    std::vector<char> active; ///< there is liquid
    std::vector<double> liquid_mass, in_liquid, residual, change;
    cases::EffectCost effect_cost{cases::Effect::solute_diffusion};
  };
} // namespace meltfront::reference_fem

#endif
