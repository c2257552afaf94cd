#include <cases/error.h>
#include <particles/rkpm/moment_factor.h>

#include <fmt/format.h>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm
{
  namespace
  {
    /** Whether the basis is p((x - x_I)/d), which moves with x, or p((x_I - x)/d) about
     * a point that stands still. */
    bool basis_moves(Variant variant)
    {
      return variant == Variant::point_collocation || variant == Variant::multiple_fixed;
    }

    bool takes_differences(Variant variant)
    {
      return basis_moves(variant) || variant == Variant::derivative_free;
    }

    int degree(const MultiIndex &a)
    {
      return a[0] + a[1] + a[2];
    }

    double power(double base, int exponent)
    {
      double product = 1;
      for(int i = 0; i < exponent; ++i)
        product *= base;
      return product;
    }

    void grow(std::vector<double> &values, std::size_t size)
    {
      if(values.size() < size)
        values.resize(size);
    }
  } // namespace

  MomentEngine::MomentEngine(const MomentSettings &settings)
    : how(settings)
    , functions(settings.dimension, settings.order)
    , derivative_numbers(settings.dimension, settings.derivatives)
  {
    if(how.order < 1)
      throw cases::InputError("the order of a reproducing kernel is at least 1");
    if(how.derivatives > 2)
      throw cases::InputError(
          fmt::format("weights of derivatives go up to the second order, not to order {}",
                      how.derivatives));
    if(differentiates_kernel(how.variant) && how.derivatives > 0
       && how.kernel == KernelShape::hat)
      throw cases::Refusal(fmt::format(
          "the variant '{}' differentiates its kernel, and 'hat' has a kink at "
          "its centre; a kernel that is C2, as wendland_c4, has what it needs",
          variant_name(how.variant)));
    if(how.derivatives == 2)
      for(int i = 0; i < how.dimension; ++i)
        for(int j = 0; j < how.dimension; ++j)
        {
          MultiIndex a{};
          ++a[i];
          ++a[j];
          second_number[i][j] = derivative_numbers.find(a);
        }
  }

  void MomentEngine::find_offsets(const std::array<double, 3> &point,
                                  const ParticleStorage &particles,
                                  std::span<const std::uint32_t> neighbours)
  {
    grow(q, count);
    std::fill_n(q.begin(), count, 0.);
    for(int d = 0; d < how.dimension; ++d)
    {
      grow(offset[d], count);
      for(std::size_t i = 0; i < count; ++i)
      {
        const double difference = particles.position[d][neighbours[i]] - point[d];
        offset[d][i] = difference;
        q[i] += difference * difference;
      }
    }
  }

  std::size_t MomentEngine::weigh(double dilation,
                                  std::span<const std::uint32_t> neighbours,
                                  std::span<const double> dilations)
  {
    grow(weight, count);
    grow(root, count);
    const bool own = how.variant == Variant::multiple_fixed;
    for(std::size_t i = 0; i < count; ++i)
      q[i] = std::sqrt(q[i]) / (own ? dilations[neighbours[i]] : dilation);
    const std::span<const double> distances(q.data(), count);
    if(differentiates_kernel(how.variant) && how.derivatives > 0)
    {
      profile.resize(std::max(profile.size(), count));
      evaluate_shape(how.kernel, distances, std::span(profile.data(), count));
      differentiate_kernel(dilation, neighbours, dilations);
    }
    else
    {
      evaluate_shape(how.kernel, distances, std::span(weight.data(), count));
      if(own)
        for(std::size_t i = 0; i < count; ++i)
          weight[i] *= power(dilation / dilations[neighbours[i]], how.dimension);
    }
    std::size_t positive = 0;
    for(std::size_t i = 0; i < count; ++i)
    {
      root[i] = std::sqrt(weight[i]);
      positive += weight[i] > 0;
    }
    return positive;
  }

  void MomentEngine::fill_basis(const std::array<double, 3> &point, double dilation)
  {
    const std::size_t k = functions.size();
    grow(columns, count * k);
    grow(factored, count * k);
    const bool absolute
        = how.origin == Origin::absolute && !takes_differences(how.variant);
    const double scale
        = absolute ? 1 : (takes_differences(how.variant) ? -1 : 1) / dilation;
    std::fill_n(columns.begin(), count, 1.);
    for(std::size_t f = 1; f < k; ++f)
    {
      const int d = functions.parent_direction(f);
      const double shift = absolute ? point[d] : 0;
      const double *from = columns.data() + functions.parent(f) * count;
      const double *along = offset[d].data();
      double *to = columns.data() + f * count;
      for(std::size_t i = 0; i < count; ++i)
        to[i] = from[i] * (along[i] + shift) * scale;
    }
    for(std::size_t f = 0; f < k; ++f)
      for(std::size_t i = 0; i < count; ++i)
        factored[f * count + i] = root[i] * columns[f * count + i];
  }

  void MomentEngine::fill_right_sides(const std::array<double, 3> &point, double dilation)
  {
    const int k = functions.size();
    grow(right_sides, k * n_derivatives());
    const bool absolute
        = how.origin == Origin::absolute && !takes_differences(how.variant);
    const double scale
        = absolute ? 1 : (takes_differences(how.variant) ? -1 : 1) / dilation;
    const std::array<double, 3> z = absolute ? point : std::array<double, 3>{};
    for(int j = 0; j < n_derivatives(); ++j)
    {
      const MultiIndex &times = derivative_numbers.exponents(j);
      const double factor = power(scale, degree(times));
      for(int f = 0; f < k; ++f)
        right_sides[j * k + f] = factor * functions.derivative(f, times, z);
    }
  }

  bool MomentEngine::evaluate(const std::array<double, 3> &point,
                              const ParticleStorage &particles,
                              std::span<const std::uint32_t> neighbours, double dilation,
                              std::span<const double> dilations)
  {
    const std::size_t k = functions.size();
    count = neighbours.size();
    ratio = 0;
    if(count < k)
      return false;
    find_offsets(point, particles, neighbours);
    if(weigh(dilation, neighbours, dilations) < k)
      return false;
    fill_basis(point, dilation);
    const Factor factor(Eigen::Map<Columns>(factored.data(), count, k));
    const auto diagonal = factor.qr.matrixQR().diagonal().cwiseAbs();
    ratio = diagonal.minCoeff() / diagonal.maxCoeff();
    if(!(ratio >= least_rank_ratio))
      return false;
    fill_right_sides(point, dilation);
    grow(result, count * n_derivatives());
    if(!differentiates_kernel(how.variant) || how.derivatives == 0)
      freeze_kernel(factor);
    else if(basis_moves(how.variant))
      move_kernel_with_differences(factor, dilation);
    else
      move_kernel_with_points(factor);
    return true;
  }

  // N^a = sqrt(w) Q R^-T Pi^T D^a p.
  void MomentEngine::freeze_kernel(const Factor &factor)
  {
    const Eigen::Index k = functions.size(), n = count;
    MatrixView right(right_sides.data(), k, n_derivatives());
    MatrixView weights(result.data(), n, n_derivatives());
    weights.topRows(k).noalias() = factor.qr.colsPermutation().transpose() * right;
    auto head = weights.topRows(k);
    factor.transposed_triangle().solveInPlace(head);
    weights.bottomRows(n - k).setZero();
    Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 10> workspace;
    factor.qr.householderQ().applyThisOnTheLeft(weights, workspace);
    weights.array().colwise() *= VectorView(root.data(), n).array();
  }

  double MomentEngine::condition_number() const
  {
    const Eigen::Index k = functions.size();
    if(!(ratio > 0))
      return std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd triangle
        = Eigen::Map<const Eigen::MatrixXd>(factored.data(), count, k)
              .topRows(k)
              .triangularView<Eigen::Upper>();
    const auto values = Eigen::JacobiSVD<Eigen::MatrixXd>(triangle).singularValues();
    const double root_of_condition = values(0) / values(k - 1);
    return root_of_condition * root_of_condition;
  }
} // namespace meltfront::particles::rkpm
