#ifndef meltfront_reference_fem_enthalpy_anderson_mixing_h
#define meltfront_reference_fem_enthalpy_anderson_mixing_h

#include <Eigen/Dense>

namespace meltfront::reference_fem
{
  /**
   * Speeds up an iteration x = G(x) that converges slowly (Anderson 1965, in the form of
   * Walker and Ni 2011): the next x is the affine combination of the last values of G
   * that would vanish the residual G(x) - x if G were linear. What every G(x) conserves,
   * an affine combination conserves too.
   */
  class AndersonMixing
  {
  public:
    /** @param depth how many steps of the iteration are combined at most */
    AndersonMixing(Eigen::Index size, int depth);

    /** Forget the past: another iteration begins. */
    void restart();

    /** Replace x by what follows, given G(x). */
    void advance(Eigen::VectorXd &x, const Eigen::VectorXd &mapped);

    long bytes() const;

  private:
    int depth, stored = 0; ///< columns in use
    bool first = true;
    double last_norm = 0;
    Eigen::MatrixXd mapped_changes, residual_changes;
    Eigen::VectorXd last_mapped, last_residual, residual;
  };
} // namespace meltfront::reference_fem

#endif
