#ifndef meltfront_particles_rkpm_moment_factor_h
#define meltfront_particles_rkpm_moment_factor_h

#include <particles/rkpm/moment_engine.h>

#include <Eigen/QR>

namespace meltfront::particles::rkpm
{
  /** A matrix over the neighbours; its columns, at most one for each function of the
   * largest basis, fix the size of what the factorisation holds besides, so that nothing
   * is allocated. */
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                Eigen::Dynamic, most_functions>;
  /** One number for each basis function, never on the heap. */
  using Coefficients
      = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_functions, 1>;
  using MatrixView = Eigen::Map<Eigen::MatrixXd>;
  using VectorView = Eigen::Map<Eigen::VectorXd>;

  /** sqrt(w) P = Q R Pi^T, in place: M = Pi R^T R Pi^T. */
  struct MomentEngine::Factor
  {
    explicit Factor(Eigen::Ref<Columns> matrix)
      : qr(matrix)
    {
    }

    auto triangle() const
    {
      return qr.matrixQR().topRows(qr.cols()).template triangularView<Eigen::Upper>();
    }

    auto transposed_triangle() const
    {
      return qr.matrixQR()
          .topRows(qr.cols())
          .transpose()
          .template triangularView<Eigen::Lower>();
    }

    /** v becomes M^-1 v. */
    void solve(Coefficients &v) const
    {
      v = qr.colsPermutation().transpose() * v;
      transposed_triangle().solveInPlace(v);
      triangle().solveInPlace(v);
      v = qr.colsPermutation() * v;
    }

    Eigen::ColPivHouseholderQR<Eigen::Ref<Columns>> qr;
  };
} // namespace meltfront::particles::rkpm

#endif
