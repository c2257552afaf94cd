#ifndef meltfront_particles_sph_two_population_two_population_implicit_h
#define meltfront_particles_sph_two_population_two_population_implicit_h

#include <particles/sph/time/krylov_solver.h>
#include <particles/sph_two_population/two_population_flow.h>

#include <array>
#include <span>
#include <vector>

namespace meltfront::particles
{
  /**
   * An implicit step of conduction and change of phase: with q the heats that the liquid
   * and the ice of all sites take up, X(q) their temperatures after the exact change of
   * phase (SiteExchange::settle) and F the flows of heat, linear in the temperatures
   * while volumes stand still,
   *
   *   q = dt [(1 - w) F(x_0) + w F(X(q))],
   *
   * w = 1 backward Euler, w = 1/2 Crank-Nicolson. Liquid at its liquidus thus answers
   * heat with the heat capacity of freezing and melting, and never undercools.
   *
   * Volumes are those at the end of the step, found by repeating the solution.
   *
   * Newton's method in q, with the derivative of X by automatic differentiation
   * (DualNumber); a site whose enthalpy would cross a kink of X stops just beyond it.
   */
  class TwoPopulationImplicit
  {
  public:
    TwoPopulationImplicit(TwoPopulationFlow &flows, Sites &sites);

    /**
     * Advance the sites.
     * @param weight w
     * @param begin, end fractions of the step at which walls are taken
     * @param wall_heat to which the heat through walls is added (J per simulated depth)
     * @return false if the equations are not solved; the sites are then of no use.
     */
    bool take_step(double duration, double weight, double begin, double end,
                   double &wall_heat);

    long linear_iterations() const
    {
      return krylov_iterations;
    }

  private:
    bool solve(double fraction);
    double evaluate(double fraction);
    template <typename SoluteOf>
    void respond(const SoluteOf &solute_of);
    template <typename SoluteOf>
    void correct(const SoluteOf &solute_of);
    void finish();
    void apply(std::span<const double> change, std::span<double> result);

    TwoPopulationFlow &flows;
    Sites &sites;
    std::size_t size; ///< of an array of one population
    KrylovSolver krylov;
    std::vector<SiteContent<double>> base; ///< with the heats of the explicit part
    std::vector<double> dissolved;         ///< Sites::dissolved()
    // Liquid, then ice:
    std::vector<double> heat, flow, excess, residual, correction, diagonal, change;
    std::array<std::vector<double>, 2> slope; ///< of the own temperature by both heats
    double factor = 0;                        ///< w dt (s)
    double through_walls = 0;
    long krylov_iterations = 0;
  };
} // namespace meltfront::particles

#endif
