#include <cases/error.h>
#include <particles/moab_integral/integral_weights.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::particles
{
  const std::vector<std::string> &weight_policy_names()
  {
    static const std::vector<std::string> names{"separate", "single", "mass-only",
                                                "uniform"};
    return names;
  }

  IntegralWeights::IntegralWeights(KernelShape shape, int dimension, WeightPolicy policy,
                                   int order)
    : shape(shape)
    , dim(dimension)
    , policy(policy)
    , powers(monomials(dimension, order))
    , n_moments(monomials(dimension, order - 2).size())
  {
    if(shape == KernelShape::hat)
      throw cases::InputError("the kernel 'hat' has no Laplacian: any other has");
    if(order < 2 || order > 4)
      throw cases::InputError(fmt::format(
          "weights of order {} are not computed: the order is 2, 3 or 4", order));
  }

  std::size_t IntegralWeights::n_constraints() const
  {
    switch(policy)
    {
    case WeightPolicy::separate:
      return powers.size();
    case WeightPolicy::single:
      return powers.size() + 1;
    case WeightPolicy::mass_only:
      return 1;
    default:
      return 0;
    }
  }

  void IntegralWeights::evaluate(const IntegralStencil &stencil)
  {
    const std::size_t n = stencil.positions.size();
    const auto size = static_cast<Eigen::Index>(n);
    radii.resize(n);
    profiles.resize(n);
    for(std::size_t i = 0; i < n; ++i)
      radii[i] = std::hypot(stencil.positions[i][0], stencil.positions[i][1]);
    evaluate_shape(shape, radii, profiles);
    psi.resize(size);
    lap_psi.resize(size);
    for(std::size_t i = 0; i < n; ++i)
    {
      psi[static_cast<Eigen::Index>(i)] = profiles[i].value;
      lap_psi[static_cast<Eigen::Index>(i)]
          = profiles[i].second + (dim - 1) * profiles[i].slope_over_distance;
    }
    volume = Eigen::Map<const Eigen::VectorXd>(stencil.volumes.data(), size);
    root = volume.cwiseSqrt();

    const auto count = static_cast<Eigen::Index>(powers.size());
    values.resize(count, size);
    laplacians.setZero(count, size);
    for(Eigen::Index i = 0; i < size; ++i)
    {
      std::array<std::array<double, 5>, 2> power;
      for(std::size_t d = 0; d < 2; ++d)
      {
        power[d][0] = 1;
        for(std::size_t p = 1; p < 5; ++p)
          power[d][p]
              = power[d][p - 1] * stencil.positions[static_cast<std::size_t>(i)][d];
      }
      for(Eigen::Index a = 0; a < count; ++a)
      {
        const auto [x, y] = powers[static_cast<std::size_t>(a)];
        values(a, i) = power[0][x] * power[1][y];
        if(x > 1)
          laplacians(a, i) += x * (x - 1) * power[0][x - 2] * power[1][y];
        if(y > 1)
          laplacians(a, i) += y * (y - 1) * power[0][x] * power[1][y - 2];
      }
    }
  }

  double IntegralWeights::nearest(Eigen::VectorXd &weights)
  {
    // In the unknown y = (W - reference) / sqrt(V) the norm is the Euclidean one.
    scaled = matrix * root.asDiagonal();
    Eigen::VectorXd excess = rhs - matrix * reference;
    for(Eigen::Index a = 0; a < scaled.rows(); ++a)
      if(const double length = scaled.row(a).norm(); length > 0)
      {
        scaled.row(a) /= length;
        excess[a] /= length;
      }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-12);
    decomposition.compute(scaled);
    last_rank = decomposition.rank();
    weights = reference + root.cwiseProduct(decomposition.solve(excess));

    const Eigen::VectorXd magnitude
        = matrix.cwiseAbs() * weights.cwiseAbs() + rhs.cwiseAbs();
    const Eigen::VectorXd defect = (matrix * weights - rhs).cwiseAbs();
    double residual = 0;
    for(Eigen::Index a = 0; a < defect.size(); ++a)
      if(magnitude[a] > 0)
        residual = std::max(residual, defect[a] / magnitude[a]);
    return residual;
  }

  double IntegralWeights::mass_weights(const IntegralStencil &stencil)
  {
    matrix = psi.transpose();
    rhs = Eigen::VectorXd::Constant(1, stencil.moments[0]);
    reference = volume;
    const double residual = nearest(weights0);
    weights2 = weights0;
    return residual;
  }

  double IntegralWeights::separate_weights(const IntegralStencil &stencil)
  {
    const auto moments = static_cast<Eigen::Index>(n_moments);
    matrix = values.topRows(moments) * psi.asDiagonal();
    rhs = Eigen::Map<const Eigen::VectorXd>(stencil.moments.data(), moments);
    reference = volume;
    const double residual = nearest(weights0);

    matrix = values * lap_psi.asDiagonal();
    rhs = laplacians * psi.cwiseProduct(weights0);
    if(!stencil.wall_terms.empty())
      rhs -= Eigen::Map<const Eigen::VectorXd>(stencil.wall_terms.data(), rhs.size());
    reference.setZero();
    return std::max(residual, nearest(weights2));
  }

  double IntegralWeights::single_weights(const IntegralStencil &stencil)
  {
    const Eigen::Index count = values.rows();
    matrix.resize(count + 1, values.cols());
    matrix.row(0) = psi.transpose();
    matrix.bottomRows(count)
        = values * lap_psi.asDiagonal() - laplacians * psi.asDiagonal();
    rhs.setZero(count + 1);
    rhs[0] = stencil.moments[0];
    if(!stencil.wall_terms.empty())
      rhs.tail(count)
          = -Eigen::Map<const Eigen::VectorXd>(stencil.wall_terms.data(), count);
    reference = volume;
    const double residual = nearest(weights0);
    weights2 = weights0;
    return residual;
  }

  double IntegralWeights::compute(const IntegralStencil &stencil,
                                  std::span<double> laplacian, std::span<double> load)
  {
    evaluate(stencil);
    double residual = 0;
    switch(policy)
    {
    case WeightPolicy::separate:
      residual = separate_weights(stencil);
      break;
    case WeightPolicy::single:
      residual = single_weights(stencil);
      break;
    case WeightPolicy::mass_only:
      residual = mass_weights(stencil);
      break;
    case WeightPolicy::uniform:
      weights0 = weights2 = volume;
      break;
    }
    for(std::size_t i = 0; i < laplacian.size(); ++i)
    {
      const auto e = static_cast<Eigen::Index>(i);
      laplacian[i] = lap_psi[e] * weights2[e];
      load[i] = psi[e] * weights0[e];
    }
    return residual;
  }
} // namespace meltfront::particles
