#include <cases/exact/chebyshev.h>

#include <cmath>
#include <numbers>

namespace meltfront::cases::spectral
{
  ChebyshevBasis::ChebyshevBasis(int intervals, double stretch)
    : intervals(intervals)
    , stretch(stretch)
    , nodes(intervals + 1)
    , first(Eigen::MatrixXd::Zero(intervals + 1, intervals + 1))
    , second(first)
    , weights(intervals + 1)
  {
    const int n = intervals;
    const double half_angle = std::numbers::pi / (2 * n);
    for(int j = 0; j <= n; ++j)
    {
      const double sine = std::sin(j * half_angle);
      nodes[j] = sine * sine;
      weights[j] = (j % 2 == 0 ? 1 : -1) * (j == 0 || j == n ? 0.5 : 1.);
    }
    const auto difference = [&](int i, int j)
    { return std::sin((i + j) * half_angle) * std::sin((i - j) * half_angle); };
    for(int i = 0; i <= n; ++i)
    {
      for(int j = 0; j <= n; ++j)
        if(j != i)
          first(i, j) = weights[j] / weights[i] / difference(i, j);
      first(i, i) = -first.row(i).sum();
      for(int j = 0; j <= n; ++j)
        if(j != i)
          second(i, j) = 2 * first(i, j) * (first(i, i) - 1 / difference(i, j));
      second(i, i) = -second.row(i).sum();
    }
    chebyshev_nodes = nodes;
    if(stretch > 0)
      apply_stretch();
  }

  void ChebyshevBasis::apply_stretch()
  {
    const double factor = 1 / std::sinh(stretch);
    for(int i = 0; i <= intervals; ++i)
    {
      const double argument = stretch * chebyshev_nodes[i];
      const double slope = stretch * factor * std::cosh(argument);
      const double curvature = stretch * stretch * factor * std::sinh(argument);
      second.row(i)
          = (second.row(i) - curvature / slope * first.row(i)) / (slope * slope);
      first.row(i) /= slope;
      nodes[i] = i == intervals ? 1 : factor * std::sinh(argument);
    }
  }

  double ChebyshevBasis::interpolate(const Eigen::VectorXd &values, double x) const
  {
    const double y = stretch > 0 ? std::asinh(x * std::sinh(stretch)) / stretch : x;
    double numerator = 0, denominator = 0;
    for(int j = 0; j <= intervals; ++j)
    {
      const double distance = y - chebyshev_nodes[j];
      if(distance == 0)
        return values[j];
      const double share = weights[j] / distance;
      numerator += share * values[j];
      denominator += share;
    }
    return numerator / denominator;
  }

  double ChebyshevBasis::tail(const Eigen::VectorXd &values) const
  {
    double last = 0, last_but_one = 0;
    for(int j = 0; j <= intervals; ++j)
    {
      last += weights[j] * values[j];
      last_but_one += weights[j] * std::cos(j * std::numbers::pi / intervals) * values[j];
    }
    return (std::abs(last) + 2 * std::abs(last_but_one)) / intervals;
  }
} // namespace meltfront::cases::spectral
