// Weights of derivatives where the kernel moves with the point and is differentiated.

#include <particles/rkpm/moment_factor.h>

namespace meltfront::particles::rkpm
{
  namespace
  {
    /** y += (G^T b)/d: coefficients of a derivative of the basis, p_i^T b = p^T y for
     * z = (x - x_I)/d. */
    void add_lowered_coefficients(const MonomialBasis &basis, int direction,
                                  double dilation, const Coefficients &b, Coefficients &y)
    {
      for(int f = 0; f < basis.size(); ++f)
        if(const int g = basis.lowered(f, direction); g >= 0)
          y(g) += basis.exponents(f)[direction] / dilation * b(f);
    }

    /** m += (G v)/d: the moments sum_I p_i s_I of a derivative of the basis, from those
     * of the basis, v = sum_I p s_I. */
    void add_lowered_moments(const MonomialBasis &basis, int direction, double dilation,
                             const Coefficients &v, Coefficients &m)
    {
      for(int f = 0; f < basis.size(); ++f)
        if(const int g = basis.lowered(f, direction); g >= 0)
          m(f) += basis.exponents(f)[direction] / dilation * v(g);
    }
  } // namespace

  // W(|x - x_I|) by x_i and x_j, W = psi(r/d): r_i = (x - x_I)_i / r.
  void MomentEngine::differentiate_kernel(double dilation,
                                          std::span<const std::uint32_t> neighbours,
                                          std::span<const double> dilations)
  {
    const int dim = how.dimension;
    if(kernel_derivatives.size() < count * n_derivatives())
      kernel_derivatives.resize(count * n_derivatives());
    const bool own = how.variant == Variant::multiple_fixed;
    for(std::size_t n = 0; n < count; ++n)
    {
      const double d = own ? dilations[neighbours[n]] : dilation;
      double factor = 1;
      for(int i = 0; i < dim; ++i)
        factor *= dilation / d;
      weight[n] = factor * profile[n].value;
      const double isotropic = factor * profile[n].slope_over_distance / (d * d);
      const double second = factor * profile[n].second / (d * d);
      const double squared = q[n] * q[n] * d * d;
      const double radial = squared > 0 ? (second - isotropic) / squared : 0;
      for(int i = 0; i < dim; ++i)
        slope(i)[n] = -isotropic * offset[i][n];
      if(how.derivatives < 2)
        continue;
      for(int i = 0; i < dim; ++i)
        for(int j = i; j < dim; ++j)
          kernel_derivatives[second_number[i][j] * count + n]
              = radial * offset[i][n] * offset[j][n] + (i == j ? isotropic : 0);
    }
  }

  // In the orthonormal basis p' = R^-T Pi^T p the moment matrix is the unit matrix:
  // b = p'(x), and with t_i = w_i p'^T b the weights are N_i = w p'^T (p'_i(x) - sum p'
  // t_i)
  // + t_i, and likewise for second derivatives.
  void MomentEngine::move_kernel_with_points(const Factor &factor)
  {
    const int dim = how.dimension;
    const Eigen::Index n = count, k = functions.size();
    MatrixView right(right_sides.data(), k, n_derivatives());
    right = factor.qr.colsPermutation().transpose() * right;
    factor.transposed_triangle().solveInPlace(right);
    MatrixView basis(columns.data(), n, k);
    basis = basis * factor.qr.colsPermutation();
    factor.triangle().solveInPlace<Eigen::OnTheRight>(basis);

    const auto w = VectorView(weight.data(), n).array();
    const auto moving = MatrixView(kernel_derivatives.data(), n, n_derivatives()).array();
    MatrixView weights(result.data(), n, n_derivatives());
    fields.resize(std::max(fields.size(), count * (dim + 2)));
    MatrixView field(fields.data(), n, dim + 2); // p'^T b, p'^T b_i, t
    auto t = field.col(dim + 1);
    Coefficients b(k);

    field.col(0).noalias() = basis * right.col(0);
    weights.col(0) = w * field.col(0).array();
    for(int i = 1; i <= dim; ++i)
    {
      t = moving.col(i) * field.col(0).array();
      b = right.col(i);
      b.noalias() -= basis.transpose() * t;
      field.col(i).noalias() = basis * b;
      weights.col(i) = w * field.col(i).array() + t.array();
    }
    if(how.derivatives < 2)
      return;
    for(int i = 0; i < dim; ++i)
      for(int j = i; j < dim; ++j)
      {
        const int a = second_number[i][j];
        t = moving.col(i + 1) * field.col(j + 1).array()
            + moving.col(j + 1) * field.col(i + 1).array()
            + moving.col(a) * field.col(0).array();
        b = right.col(a);
        b.noalias() -= basis.transpose() * t;
        weights.col(a).noalias() = basis * b;
        weights.col(a).array() = w * weights.col(a).array() + t.array();
      }
  }

  // The constraint sum_I p N_I = p(0) for all x, differentiated: with h = d(p^T b) the
  // weights are N_i = w_i p^T b + w h_i, and b_i follows from sum p N_i + p_i N = 0, that
  // is M b_i = -M_i b; likewise M b_ij = -(M_i b_j + M_j b_i + M_ij b).
  void MomentEngine::move_kernel_with_differences(const Factor &factor, double dilation)
  {
    const int dim = how.dimension;
    const Eigen::Index n = count, k = functions.size();
    const MatrixView basis(columns.data(), n, k);
    const auto w = VectorView(weight.data(), n).array();
    const auto moving = MatrixView(kernel_derivatives.data(), n, n_derivatives()).array();
    MatrixView weights(result.data(), n, n_derivatives());
    fields.resize(std::max(fields.size(), count * (dim + 1)));
    MatrixView field(fields.data(), n, dim + 1); // p^T b, h_i
    std::array<Coefficients, 4> b, v;            // of the value and first derivatives
    Coefficients y(k), m(k);

    b[0] = VectorView(right_sides.data(), k);
    factor.solve(b[0]);
    field.col(0).noalias() = basis * b[0];
    weights.col(0) = w * field.col(0).array();
    v[0].noalias() = basis.transpose() * weights.col(0);
    for(int i = 1; i <= dim; ++i)
    {
      y.setZero();
      add_lowered_coefficients(functions, i - 1, dilation, b[0], y);
      field.col(i).noalias() = basis * y;
      weights.col(i) = moving.col(i) * field.col(0).array() + w * field.col(i).array();
      m.noalias() = basis.transpose() * weights.col(i);
      add_lowered_moments(functions, i - 1, dilation, v[0], m);
      factor.solve(m);
      b[i] = -m;
      field.col(i).noalias() += basis * b[i];
      weights.col(i) = moving.col(i) * field.col(0).array() + w * field.col(i).array();
      v[i].noalias() = basis.transpose() * weights.col(i);
    }
    if(how.derivatives < 2)
      return;
    for(int i = 1; i <= dim; ++i)
      for(int j = i; j <= dim; ++j)
      {
        const int a = second_number[i - 1][j - 1];
        Coefficients twice = Coefficients::Zero(k);
        add_lowered_coefficients(functions, j - 1, dilation, b[0], twice);
        twice += b[j];
        y.setZero();
        add_lowered_coefficients(functions, i - 1, dilation, twice, y);
        add_lowered_coefficients(functions, j - 1, dilation, b[i], y);
        weights.col(a).noalias() = basis * y;
        weights.col(a).array() = w * weights.col(a).array()
                                 + moving.col(i) * field.col(j).array()
                                 + moving.col(j) * field.col(i).array()
                                 + moving.col(a) * field.col(0).array();
        m.noalias() = basis.transpose() * weights.col(a);
        twice = v[j];
        add_lowered_moments(functions, j - 1, dilation, v[0], twice);
        add_lowered_moments(functions, i - 1, dilation, twice, m);
        add_lowered_moments(functions, j - 1, dilation, v[i], m);
        factor.solve(m);
        weights.col(a).array() -= w * (basis * m).array();
      }
  }
} // namespace meltfront::particles::rkpm
