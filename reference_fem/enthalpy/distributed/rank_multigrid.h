#ifndef meltfront_reference_fem_enthalpy_distributed_rank_multigrid_h
#define meltfront_reference_fem_enthalpy_distributed_rank_multigrid_h

#include <reference_fem/enthalpy/distributed/coarsest_solver.h>
#include <reference_fem/enthalpy/linear_solver.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * One V-cycle on several ranks for A = D + K on the active nodes, as a preconditioner.
   *
   * Smoother: sweeps of Gauss-Seidel over a rank's own nodes with the other ranks' values
   * as they were, before the coarse correction forwards, after it backwards, so that the
   * cycle is symmetric. Truncated as Multigrid (Kornhuber 1994): corrections vanish at
   * inactive nodes. On coarse meshes K is that of their own cells, and D the row sums of
   * P'D P, an inactive node counting with K_ii: the energy that it costs to be held. The
   * coarsest system is solved directly, on every rank.
   */
  class RankMultigrid
  {
  public:
    RankMultigrid(const std::vector<RankLevel> &levels, Traffic &traffic);

    /** Take A = scale heat capacity + K on the active nodes. */
    void set_up(const NewtonSystem &system, double scale);

    /** x = one cycle from zero, own nodes. @param x has ghosts, too */
    void precondition(const std::vector<double> &right_side, std::vector<double> &x)
    {
      cycle(0, right_side, x);
    }

    /** y = A x, zero where inactive, where x is to be zero; x has ghosts, y has not. */
    void multiply(std::vector<double> &x, std::vector<double> &y);

    /** Entries of K on all levels. */
    long entries() const;

  private:
    /** Of a level. */
    struct System
    {
      std::vector<double> diagonal, inverse; ///< of A; zero where inactive
      std::vector<double> residual, x;       ///< with ghosts; x below the finest
      std::vector<double> right_side;        ///< below the finest
    };

    void cycle(std::size_t l, const std::vector<double> &right_side,
               std::vector<double> &x);
    void correct_coarsely(std::size_t l, std::vector<double> &x);

    const std::vector<RankLevel> &levels;
    Traffic &traffic;
    std::vector<System> systems;
    CoarsestSolver coarsest;
  };
} // namespace meltfront::reference_fem

#endif
