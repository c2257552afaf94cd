#ifndef meltfront_cases_exact_chebyshev_h
#define meltfront_cases_exact_chebyshev_h

#include <Eigen/Dense>

namespace meltfront::cases::spectral
{
  /**
   * Chebyshev-Lobatto collocation on [0, 1] (Trefethen 2000, chapter 6), with node
   * differences by products of sines and diagonals by negative sums against round-off.
   * The nodes may be drawn towards 0 by x = sinh(stretch y)/sinh(stretch), y the
   * Chebyshev coordinate: a layer of width w at 0 then takes of the order of log(1/w)
   * nodes.
   */
  struct ChebyshevBasis
  {
    explicit ChebyshevBasis(int intervals, double stretch = 0);

    /** Value at x of the polynomial through nodal values, by the barycentric formula
     * (Berrut and Trefethen 2004). */
    double interpolate(const Eigen::VectorXd &values, double x) const;

    /** Size of the two highest Chebyshev coefficients of the polynomial through nodal
     * values: small where it is resolved. */
    double tail(const Eigen::VectorXd &values) const;

    int intervals;
    double stretch;
    Eigen::VectorXd nodes;   ///< intervals + 1, ascending from 0 to 1
    Eigen::MatrixXd first;   ///< d/dx at the nodes
    Eigen::MatrixXd second;  ///< d^2/dx^2 at the nodes
    Eigen::VectorXd weights; ///< barycentric

  private:
    void apply_stretch();

    Eigen::VectorXd chebyshev_nodes;
  };
} // namespace meltfront::cases::spectral

#endif
