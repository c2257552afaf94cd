#include <reference_fem/fitted/front_surface.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <numbers>

namespace meltfront::reference_fem::fitted
{
  using cases::Position;
  using std::numbers::pi;

  std::vector<double> node_shares(int degree)
  {
    std::vector<double> result;
    const dealii::QGaussLobatto<1> rule(degree + 1);
    for(const auto &point : rule.get_points())
      result.push_back(point[0]);
    return result;
  }

  LineBasis::LineBasis(int degree, const std::vector<double> &points)
    : value(points.size(), degree + 1)
    , derivative(points.size(), degree + 1)
  {
    const auto polynomials = dealii::Polynomials::generate_complete_Lagrange_basis(
        dealii::QGaussLobatto<1>(degree + 1).get_points());
    std::vector<double> values(2);
    for(std::size_t q = 0; q < points.size(); ++q)
      for(int b = 0; b <= degree; ++b)
      {
        polynomials[b].value(points[q], values);
        value(q, b) = values[0];
        derivative(q, b) = values[1];
      }
  }

  namespace
  {
    /** The direction of a point of a cube's face by two angles of [-pi/4, pi/4], and its
     * derivatives with respect to them. */
    struct CubeDirection
    {
      CubeDirection(int face, double a, double b)
      {
        const int axis = face / 2;
        Eigen::Vector3d point = Eigen::Vector3d::Zero(), by_a = point, by_b = point;
        point[axis] = face % 2 == 0 ? -1 : 1;
        point[(axis + 1) % 3] = std::tan(a);
        point[(axis + 2) % 3] = std::tan(b);
        by_a[(axis + 1) % 3] = 1 + std::tan(a) * std::tan(a);
        by_b[(axis + 2) % 3] = 1 + std::tan(b) * std::tan(b);
        const double norm = point.norm();
        direction = point / norm;
        derivative_a = (by_a - direction * direction.dot(by_a)) / norm;
        derivative_b = (by_b - direction * direction.dot(by_b)) / norm;
      }

      Eigen::Vector3d direction, derivative_a, derivative_b;
    };

    std::vector<unsigned int> lexicographic(int degree, int tangents, const auto &ray_of)
    {
      std::vector<unsigned int> rays;
      for(int j = 0; j <= (tangents == 2 ? degree : 0); ++j)
        for(int i = 0; i <= (tangents >= 1 ? degree : 0); ++i)
          rays.push_back(ray_of(i, j));
      return rays;
    }
  } // namespace

  SurfacePoint FrontSurface::at(const Patch &patch, double u, double v) const
  {
    const double a = patch.lower[0] + patch.width[0] * u;
    const double b = patch.lower[1] + patch.width[1] * v;
    SurfacePoint point;
    switch(kind)
    {
    case Kind::point:
      point.direction = {1, 0, 0};
      point.measure = area;
      break;
    case Kind::flat:
      point.base = {0, a, tangents == 2 ? b : 0.};
      point.direction = {1, 0, 0};
      point.measure = tangents == 2 ? patch.width[0] * patch.width[1] : patch.width[0];
      point.gradient(0, 0) = 1 / patch.width[0];
      point.gradient(1, 1) = 1 / patch.width[1];
      break;
    case Kind::circle:
      point.direction = {std::cos(a), std::sin(a), 0};
      point.measure = patch.width[0];
      point.gradient(0, 0) = 1 / patch.width[0];
      break;
    case Kind::sphere:
    {
      const CubeDirection cube(patch.face, a, b);
      for(int d = 0; d < 3; ++d)
        point.direction[d] = cube.direction[d];
      const Eigen::Vector3d along_u = patch.width[0] * cube.derivative_a;
      const Eigen::Vector3d along_v = patch.width[1] * cube.derivative_b;
      point.measure = along_u.cross(along_v).norm();
      // Tangents by Gram-Schmidt; the inverse of the triangle that they leave.
      const double uu = along_u.norm();
      const double uv = along_v.dot(along_u) / uu;
      const double vv = point.measure / uu;
      point.gradient << 1 / uu, 0, -uv / (uu * vv), 1 / vv;
      break;
    }
    }
    return point;
  }

  void FrontSurface::add_cell(const Patch &patch, const std::vector<unsigned int> &rays)
  {
    const std::vector<double> nodes = node_shares(degree);
    patches.push_back(patch);
    cells.push_back(rays);
    for(std::size_t k = 0; k < rays.size(); ++k)
    {
      if(rays[k] >= base.size())
      {
        base.resize(rays[k] + 1);
        direction.resize(rays[k] + 1, Position{});
      }
      // Periodic rays stay where the first of their cells has them.
      if(direction[rays[k]] != Position{})
        continue;
      const SurfacePoint point
          = at(patch, nodes[k % (degree + 1)], nodes[k / (degree + 1)]);
      base[rays[k]] = point.base;
      direction[rays[k]] = point.direction;
    }
  }

  FrontSurface FrontSurface::point(int degree, double area, int exponent)
  {
    FrontSurface surface;
    surface.degree = degree;
    surface.exponent = exponent;
    surface.area = area;
    surface.add_cell({}, {0});
    return surface;
  }

  FrontSurface FrontSurface::circle(int degree, int n)
  {
    FrontSurface surface;
    surface.degree = degree;
    surface.tangents = 1;
    surface.exponent = 1;
    surface.round = true;
    surface.kind = Kind::circle;
    for(int c = 0; c < n; ++c)
      surface.add_cell({0, {2 * pi * c / n, 0}, {2 * pi / n, 1}},
                       lexicographic(degree, 1,
                                     [&](int i, int)
                                     { return (c * degree + i) % (n * degree); }));
    return surface;
  }

  FrontSurface FrontSurface::sphere(int degree, int n)
  {
    FrontSurface surface;
    surface.degree = degree;
    surface.tangents = 2;
    surface.exponent = 2;
    surface.round = true;
    surface.kind = Kind::sphere;
    std::map<std::array<int, 3>, unsigned int> ray_of_point;
    const double width = pi / (2 * n);
    for(int face = 0; face < 6; ++face)
      for(int cj = 0; cj < n; ++cj)
        for(int ci = 0; ci < n; ++ci)
        {
          const auto ray_of = [&](int i, int j)
          {
            std::array<int, 3> lattice{};
            lattice[face / 2] = face % 2 == 0 ? 0 : n * degree;
            lattice[(face / 2 + 1) % 3] = ci * degree + i;
            lattice[(face / 2 + 2) % 3] = cj * degree + j;
            return ray_of_point
                .try_emplace(lattice, static_cast<unsigned int>(ray_of_point.size()))
                .first->second;
          };
          surface.add_cell(
              {face, {-pi / 4 + ci * width, -pi / 4 + cj * width}, {width, width}},
              lexicographic(degree, 2, ray_of));
        }
    return surface;
  }

  FrontSurface FrontSurface::tensor(int degree, const std::array<int, 2> &n, int tangents,
                                    const Position &lower, const Position &upper,
                                    const std::array<bool, 2> &periodic)
  {
    FrontSurface surface;
    surface.degree = degree;
    surface.tangents = tangents;
    surface.kind = Kind::flat;
    const int across = n[0] * degree + (periodic[0] ? 0 : 1);
    const std::array<double, 2> width{(upper[1] - lower[1]) / n[0],
                                      tangents == 2 ? (upper[2] - lower[2]) / n[1] : 1.};
    for(int cj = 0; cj < n[1]; ++cj)
      for(int ci = 0; ci < n[0]; ++ci)
      {
        const auto ray_of = [&](int i, int j)
        {
          const int column = ci * degree + i, row = cj * degree + j;
          return (periodic[0] ? column % across : column)
                 + across * (periodic[1] ? row % (n[1] * degree) : row);
        };
        surface.add_cell({0, {lower[1] + ci * width[0], lower[2] + cj * width[1]}, width},
                         lexicographic(degree, tangents, ray_of));
      }
    return surface;
  }

  FrontSurface FrontSurface::line(int degree, int n, double lower, double upper,
                                  bool periodic)
  {
    return tensor(degree, {n, 1}, 1, {0, lower, 0}, {0, upper, 0}, {periodic, false});
  }

  FrontSurface FrontSurface::rectangle(int degree, const std::array<int, 2> &n,
                                       const Position &lower, const Position &upper,
                                       const std::array<bool, 2> &periodic)
  {
    return tensor(degree, n, 2, lower, upper, periodic);
  }

  SurfaceRule FrontSurface::rule(int n_points) const
  {
    const dealii::QGauss<1> gauss(n_points);
    std::vector<double> points;
    for(const auto &point : gauss.get_points())
      points.push_back(point[0]);
    const LineBasis line(degree, points);
    const int nu = tangents >= 1 ? n_points : 1, nv = tangents == 2 ? n_points : 1;
    const int au = tangents >= 1 ? degree + 1 : 1, av = tangents == 2 ? degree + 1 : 1;

    Eigen::MatrixXd along_u = Eigen::MatrixXd::Zero(nu * nv, au * av), along_v = along_u;
    Eigen::ArrayXd weight = Eigen::ArrayXd::Ones(nu * nv);
    SurfaceRule rule;
    rule.value = Eigen::MatrixXd::Ones(nu * nv, au * av);
    for(int q = 0; q < nu * nv; ++q)
    {
      const int qu = q % nu, qv = q / nu;
      weight[q] *= (tangents >= 1 ? gauss.weight(qu) : 1)
                   * (tangents == 2 ? gauss.weight(qv) : 1);
      for(int a = 0; a < au * av && tangents > 0; ++a)
      {
        const double v = tangents == 2 ? line.value(qv, a / au) : 1;
        const double dv = tangents == 2 ? line.derivative(qv, a / au) : 0;
        rule.value(q, a) = line.value(qu, a % au) * v;
        along_u(q, a) = line.derivative(qu, a % au) * v;
        along_v(q, a) = line.value(qu, a % au) * dv;
      }
    }
    for(const Patch &patch : patches)
    {
      SurfaceRule::Cell cell;
      cell.weight = weight;
      cell.gradient = {along_u, along_v};
      for(int q = 0; q < nu * nv; ++q)
      {
        const SurfacePoint point
            = at(patch, points[q % nu], tangents == 2 ? points[q / nu] : 0.);
        cell.weight[q] *= point.measure;
        for(int j = 0; j < 2; ++j)
          cell.gradient[j].row(q) = point.gradient(j, 0) * along_u.row(q)
                                    + point.gradient(j, 1) * along_v.row(q);
        cell.points.push_back(point);
      }
      rule.cells.push_back(cell);
    }
    return rule;
  }
} // namespace meltfront::reference_fem::fitted
