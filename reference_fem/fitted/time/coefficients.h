#ifndef meltfront_reference_fem_fitted_time_coefficients_h
#define meltfront_reference_fem_fitted_time_coefficients_h

#include <deal.II/lac/full_matrix.h>

#include <complex>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /**
   * The Radau IIA collocation method with 2 or 3 stages (Hairer & Wanner 1996, Solving
   * ODEs II, section IV.5): order 2 s - 1, the last stage is the end of the step.
   */
  struct RadauCoefficients
  {
    explicit RadauCoefficients(unsigned int n_stages);

    std::vector<double> nodes;          ///< c, in (0, 1]
    dealii::FullMatrix<double> inverse; ///< of the matrix a of the method
    /** gamma_0 of the error estimate: the real eigenvalue of a, or the modulus of the
     * complex ones where there is none. */
    double estimate_weight = 0;
  };

  /** A matrix as V diag(lambda) V^-1. */
  struct Eigendecomposition
  {
    explicit Eigendecomposition(const dealii::FullMatrix<double> &matrix);

    std::vector<std::complex<double>> values;
    dealii::FullMatrix<std::complex<double>> vectors, inverse;
  };

  /** alpha_0 ... alpha_q with sum alpha_k u(sigma - k h) / h = u'(sigma) + O(h^q). */
  std::vector<double> bdf_coefficients(unsigned int order);

  /** Values at x of the Lagrange polynomials on the given nodes. */
  std::vector<double> lagrange_weights(const std::vector<double> &nodes, double x);
} // namespace meltfront::reference_fem::fitted

#endif
