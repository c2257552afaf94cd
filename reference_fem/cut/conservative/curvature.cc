#include <reference_fem/cut/conservative/curvature.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Spacings: from a triangle's centre, within which a parabola is fitted; by how much
     * more where there is too little, and at most. */
    constexpr double fitted_reach = 2.5, wider = 0.5, widest_reach = 5;

    /** Samples of the six coefficients of a parabola. */
    constexpr std::size_t fewest_samples = 10;

    /** Of the normal equations: pivot, of the largest one, below which a parabola is not
     * told. */
    constexpr double least_pivot = 1e-6;

    using Coefficients = Eigen::Matrix<double, 6, 1>;

    /** Of a parabola about the origin: value, slopes, second derivatives. */
    Coefficients monomials(const Gradient &place)
    {
      const double x = place[0], y = place[1];
      return {1, x, y, x * x / 2, x * y, y * y / 2};
    }
  } // namespace

  Remainder::Remainder(const Curvature &curvature, const Triangle &triangle,
                       const std::vector<Point> &nodes)
    : curvature(curvature)
    , centre(triangle.centre)
  {
    for(std::size_t i = 0; i < 3; ++i)
    {
      const double corner = quadratic(nodes[triangle.nodes[i]]);
      slope += corner * triangle.gradients[i];
      at_centre += corner / 3;
    }
  }

  double Remainder::quadratic(const Point &point) const
  {
    const Gradient d = point - centre;
    return (curvature.xx * d[0] * d[0] + 2 * curvature.xy * d[0] * d[1]
            + curvature.yy * d[1] * d[1])
           / 2;
  }

  double Remainder::value(const Point &point) const
  {
    return quadratic(point) - at_centre - slope * (point - centre);
  }

  Gradient Remainder::gradient(const Point &point) const
  {
    const Gradient d = point - centre;
    Gradient result = -1. * slope;
    result[0] += curvature.xx * d[0] + curvature.xy * d[1];
    result[1] += curvature.xy * d[0] + curvature.yy * d[1];
    return result;
  }

  CurvatureFit::CurvatureFit(const TriangleMesh &mesh, const std::vector<char> &inside,
                             Phase phase, const Guess &guess,
                             std::vector<FrontSample> front)
    : mesh(mesh)
    , inside(inside)
    , sense(phase == Phase::solid ? -1 : 1)
    , guess(guess)
    , front(std::move(front))
  {
  }

  void CurvatureFit::find_samples(const Point &centre)
  {
    const Values &values = guess.temperatures[sense < 0 ? 0 : 1];
    for(double reach = fitted_reach; reach <= widest_reach; reach += wider)
    {
      found.clear();
      const auto add = [&](const Point &place, double value, double weight)
      {
        const Gradient offset = (place - centre) / mesh.spacing;
        if(offset.norm() <= reach)
          found.push_back({offset, value, weight});
      };
      mesh.visit_nodes_near(centre, reach * mesh.spacing,
                            [&](unsigned int node)
                            {
                              if(inside[node] && sense * guess.level_set[node] > 0)
                                add(mesh.nodes[node], values[node], 1);
                              const auto [first, last] = std::ranges::equal_range(
                                  front, node, {}, &FrontSample::node);
                              for(auto sample = first; sample != last; ++sample)
                                add(sample->place, sample->value, sample->weight);
                            });
      if(found.size() >= fewest_samples)
        return;
    }
  }

  Curvature CurvatureFit::operator()(const Triangle &triangle)
  {
    find_samples(triangle.centre);
    if(found.size() < fewest_samples)
      return {};
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Coefficients load = Coefficients::Zero();
    for(const auto &[place, value, weight] : found)
    {
      const Coefficients basis = monomials(place);
      normal += weight * basis * basis.transpose();
      load += weight * value * basis;
    }
    // Of a positive matrix the largest pivots are on the diagonal, and are the squares of
    // those of a QR factorisation of what it is made of.
    Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> fit;
    fit.setThreshold(least_pivot);
    if(!fit.compute(normal).isInvertible())
      return {};
    const Coefficients c = fit.solve(load);
    double missed = 0, weights = 0;
    for(const auto &[place, value, weight] : found)
    {
      const double off = monomials(place).dot(c) - value;
      missed += weight * off * off;
      weights += weight;
    }
    missed /= weights;
    const double size = c[3] * c[3] + 2 * c[4] * c[4] + c[5] * c[5];
    if(!(size > 0))
      return {};
    const double factor = size / (size + 4 * missed) / (mesh.spacing * mesh.spacing);
    return {factor * c[3], factor * c[4], factor * c[5]};
  }
} // namespace meltfront::reference_fem::cut::conservative
