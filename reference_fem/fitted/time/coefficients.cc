#include <reference_fem/fitted/time/coefficients.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <limits>

namespace meltfront::reference_fem::fitted
{
  RadauCoefficients::RadauCoefficients(const unsigned int n_stages)
  {
    const double root = std::sqrt(6.);
    nodes = n_stages == 2 ? std::vector<double>{1. / 3, 1}
                          : std::vector<double>{(4 - root) / 10, (4 + root) / 10, 1};
    // Collocation: a integrates polynomials below degree s exactly up to each node.
    dealii::FullMatrix<double> powers(n_stages, n_stages), integrals(n_stages, n_stages);
    for(unsigned int k = 0; k < n_stages; ++k)
      for(unsigned int q = 0; q < n_stages; ++q)
      {
        powers(k, q) = std::pow(nodes[k], q);
        integrals(k, q) = std::pow(nodes[k], q + 1) / (q + 1);
      }
    integrals.gauss_jordan();
    inverse.reinit(n_stages, n_stages);
    powers.mmult(inverse, integrals);

    double least_imaginary = std::numeric_limits<double>::infinity();
    for(const auto &eigenvalue : Eigendecomposition(inverse).values)
      if(std::abs(eigenvalue.imag()) < least_imaginary)
      {
        least_imaginary = std::abs(eigenvalue.imag());
        estimate_weight = 1 / std::abs(eigenvalue);
      }
  }

  Eigendecomposition::Eigendecomposition(const dealii::FullMatrix<double> &matrix)
  {
    const unsigned int n = matrix.m();
    dealii::LAPACKFullMatrix<double> work(n, n);
    work = matrix;
    work.compute_eigenvalues();
    vectors.reinit(n, n);
    for(unsigned int e = 0; e < n; ++e)
    {
      values.push_back(work.eigenvalue(e));
      // Inverse iteration with a shift so close that two steps are plenty.
      dealii::FullMatrix<std::complex<double>> shifted(n, n);
      for(unsigned int i = 0; i < n; ++i)
        for(unsigned int j = 0; j < n; ++j)
          shifted(i, j) = matrix(i, j) - (i == j ? values[e] * (1 + 1e-8) : 0.);
      shifted.gauss_jordan();
      dealii::Vector<std::complex<double>> x(n), y(n);
      x = 1.;
      for(unsigned int iteration = 0; iteration < 3; ++iteration)
      {
        shifted.vmult(y, x);
        y /= y.l2_norm();
        x = y;
      }
      for(unsigned int i = 0; i < n; ++i)
        vectors(i, e) = x[i];
    }
    inverse = vectors;
    inverse.gauss_jordan();
  }

  std::vector<double> bdf_coefficients(const unsigned int order)
  {
    // sum over m <= q of (backward difference of order m) / m
    std::vector<double> alpha(order + 1);
    for(unsigned int m = 1; m <= order; ++m)
    {
      double binomial = 1;
      for(unsigned int k = 0; k <= m; ++k)
      {
        alpha[k] += (k % 2 == 0 ? binomial : -binomial) / m;
        binomial = binomial * (m - k) / (k + 1);
      }
    }
    return alpha;
  }

  std::vector<double> lagrange_weights(const std::vector<double> &nodes, const double x)
  {
    std::vector<double> weights(nodes.size(), 1.);
    for(std::size_t i = 0; i < nodes.size(); ++i)
      for(std::size_t j = 0; j < nodes.size(); ++j)
        if(j != i)
          weights[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
    return weights;
  }
} // namespace meltfront::reference_fem::fitted
