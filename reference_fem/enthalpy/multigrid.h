#ifndef meltfront_reference_fem_enthalpy_multigrid_h
#define meltfront_reference_fem_enthalpy_multigrid_h

#include <reference_fem/enthalpy/lattice_matrix.h>
#include <reference_fem/enthalpy/nested_level.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * One V-cycle for A = D + K on the active nodes of a mesh, as a preconditioner:
   * symmetric and positive definite, since the sweep of Gauss-Seidel after the coarse
   * correction is that before it backwards.
   *
   * Truncated (Kornhuber 1994): the coarse spaces are those of linear interpolation with
   * zeros at inactive nodes, their matrices P'A P, so that a front, which is no line of
   * any coarse mesh, costs no iterations.
   *
   * @tparam Level LatticeLevel or NestedLevel
   */
  template <class Level>
  class Multigrid
  {
  public:
    /** @param levels live as long as this */
    Multigrid(const std::vector<Level> &levels, const ConductionMatrix &network);

    /** The conductances of the network have changed. */
    void take(const ConductionMatrix &network);

    /** Take A = scale D + K on the active nodes, which live as long as A is used.
     * @param with_coarse_levels else a cycle is a sweep there and back */
    void set_up(const std::vector<double> &heat_capacity, double scale,
                const std::vector<char> &active, bool with_coarse_levels);

    /** y = A x, zero where inactive; x is to be zero there. */
    void multiply(const std::vector<double> &x, std::vector<double> &y) const;

    /** x = one cycle from zero. */
    void precondition(const std::vector<double> &right_side, std::vector<double> &x);

  private:
    /** What a level works with. */
    struct Work
    {
      std::vector<double> inverse_diagonal; ///< zero where nothing is to be solved
      std::vector<double> right_side, x;    ///< below the finest level
    };

    void set_up_below();
    void factorise_coarsest();
    void solve_coarsest(const std::vector<double> &right_side,
                        std::vector<double> &x) const;
    void correct_coarsely(std::size_t l, const std::vector<double> &right_side,
                          std::vector<double> &x);
    void cycle(std::size_t l, const std::vector<double> &right_side,
               std::vector<double> &x);

    const std::vector<Level> &levels;
    std::vector<typename Level::Matrix> matrices;
    std::vector<Work> work;
    std::vector<double> diagonal; ///< of the finest A
    const std::vector<char> *active = nullptr;
    bool coarse = true;         ///< levels below the finest are in use
    std::vector<double> factor; ///< Cholesky's, of the coarsest level, by rows
  };
} // namespace meltfront::reference_fem

#endif
