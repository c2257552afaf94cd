#ifndef meltfront_cases_exact_chebyshev_h
#define meltfront_cases_exact_chebyshev_h

#include <Eigen/Dense>

namespace meltfront::cases::spectral
{
  /** Chebyshev-Lobatto collocation on [0, 1] (Trefethen 2000, chapter 6), with node
   * differences by products of sines and diagonals by negative sums against round-off. */
  struct ChebyshevBasis
  {
    explicit ChebyshevBasis(int intervals);

    /** Value at x of the polynomial through nodal values, by the barycentric formula
     * (Berrut and Trefethen 2004). */
    double interpolate(const Eigen::VectorXd &values, double x) const;

    /** Size of the two highest Chebyshev coefficients of the polynomial through nodal
     * values: small where it is resolved. */
    double tail(const Eigen::VectorXd &values) const;

    int intervals;
    Eigen::VectorXd nodes;   ///< intervals + 1, ascending from 0 to 1
    Eigen::MatrixXd first;   ///< d/dx at the nodes
    Eigen::MatrixXd second;  ///< d^2/dx^2 at the nodes
    Eigen::VectorXd weights; ///< barycentric
  };
} // namespace meltfront::cases::spectral

#endif
