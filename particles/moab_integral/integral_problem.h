#ifndef meltfront_particles_moab_integral_integral_problem_h
#define meltfront_particles_moab_integral_integral_problem_h

#include <cases/scene.h>
#include <particles/moab_integral/integral_rows.h>
#include <particles/scattered/linear_problem.h>

namespace meltfront::particles
{
  /**
   * A scene's conduction by rows of the integral method,
   *
   *   k (sum laplacian T + sum flux dT/dn) + sum load (q - rho c dT/dt) = 0,
   *
   * with the heat q released (W/m^3). A particle on a wall of given temperature holds
   * that; on other walls k dT/dn is the flux, or h (T_a - T) of a wall that transfers
   * heat.
   */
  class IntegralProblem
  {
  public:
    /** @param scene, nodes outlive this. @throws as integral_rows() does. */
    IntegralProblem(const cases::Scene &scene, const NodeSet &nodes,
                    const IntegralParameters &parameters);

    IntegralProblem(const IntegralProblem &) = delete;
    IntegralProblem &operator=(const IntegralProblem &) = delete;

    const LinearProblem &linear() const
    {
      return problem;
    }

    /** Asked for (m). */
    double dilation() const
    {
      return parameters.dilation * nodes.spacing;
    }

    long work() const
    {
      return rows.work;
    }

    /** How rows were made and how well their constraints are met. */
    std::vector<cases::Parameter> describe() const;

    std::vector<cases::EffectCost> effect_costs(const cases::EffectSet &effects) const;

  private:
    void assemble();
    void evaluate_sources(const LinearStep &step, std::span<double> source);
    void add_wall_sources(const LinearStep &step, std::span<double> source);

    const cases::Scene &scene;
    GivenValues given;
    const NodeSet &nodes;
    const IntegralParameters parameters;
    std::vector<std::pair<std::uint32_t, const cases::Boundary *>> fixed; ///< particles
    IntegralRows rows;
    LinearProblem problem;
    std::vector<double> released, wall_flux, from_walls;
    long evaluations = 0;
    double release_seconds = 0, wall_seconds = 0;
  };
} // namespace meltfront::particles

#endif
