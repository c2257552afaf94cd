#include <cases/exact/lagrange_points.h>

namespace meltfront::cases::spectral
{
  Eigen::VectorXd barycentric_weights(const Eigen::VectorXd &points)
  {
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(points.size());
    for(Eigen::Index i = 0; i < points.size(); ++i)
      for(Eigen::Index j = 0; j < points.size(); ++j)
        if(j != i)
          weights[i] /= points[i] - points[j];
    return weights;
  }

  Eigen::VectorXd interpolation_weights(const Eigen::VectorXd &points,
                                        const Eigen::VectorXd &weights, double x)
  {
    Eigen::VectorXd result(points.size());
    for(Eigen::Index i = 0; i < points.size(); ++i)
    {
      if(x == points[i])
        return Eigen::VectorXd::Unit(points.size(), i);
      result[i] = weights[i] / (x - points[i]);
    }
    return result / result.sum();
  }

  Eigen::MatrixXd differentiation_matrix(const Eigen::VectorXd &points)
  {
    const Eigen::VectorXd weights = barycentric_weights(points);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(points.size(), points.size());
    for(Eigen::Index i = 0; i < points.size(); ++i)
    {
      for(Eigen::Index j = 0; j < points.size(); ++j)
        if(j != i)
          matrix(i, j) = weights[j] / weights[i] / (points[i] - points[j]);
      matrix(i, i) = -matrix.row(i).sum();
    }
    return matrix;
  }
} // namespace meltfront::cases::spectral
