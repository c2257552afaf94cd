#ifndef meltfront_cases_exact_lagrange_points_h
#define meltfront_cases_exact_lagrange_points_h

#include <Eigen/Dense>

namespace meltfront::cases::spectral
{
  /** Weights of the polynomial through values at points in its barycentric formula, up to
   * a common factor (Berrut and Trefethen 2004). */
  Eigen::VectorXd barycentric_weights(const Eigen::VectorXd &points);

  /** Shares of the values at points in the value at x of the polynomial through them.
   * @param weights  of barycentric_weights() */
  Eigen::VectorXd interpolation_weights(const Eigen::VectorXd &points,
                                        const Eigen::VectorXd &weights, double x);

  /** d/dx at the points of the polynomial through values there; diagonals are negative
   * sums of their rows, so that constants have none. */
  Eigen::MatrixXd differentiation_matrix(const Eigen::VectorXd &points);
} // namespace meltfront::cases::spectral

#endif
