#include <reference_fem/fitted/events/resolution.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    /** Fewest modes beside the mean whose decay tells something. */
    constexpr unsigned int telling_degree = 4;

    /** Highest modes of cells that resolve the start, and of what jumps, of the
     * temperature scale. */
    constexpr double resolved_mode = 1e-3, mode_of_jump = 0.05;

    constexpr int most_halvings = 12;

    /** Factors of the nodes' values in the highest Legendre mode of a cell. */
    std::vector<double> highest_mode_factors(const unsigned int degree)
    {
      const LineRule rule = LineRule::gauss(static_cast<int>(degree) + 1);
      const LineBasis basis(static_cast<int>(degree), rule.points);
      std::vector<double> result(degree + 1);
      for(std::size_t q = 0; q < rule.points.size(); ++q)
        for(unsigned int b = 0; b <= degree; ++b)
          result[b] += (2 * degree + 1) * rule.weights[q] * basis.value(q, b)
                       * std::legendre(degree, 2 * rule.points[q] - 1);
      return result;
    }

    std::vector<std::vector<double>> halved_where(const RayMesh &mesh,
                                                  const std::vector<double> &modes)
    {
      std::vector<std::vector<double>> result;
      std::size_t layer = 0;
      for(const std::vector<double> &shares : mesh.shares)
      {
        result.push_back({0});
        for(std::size_t k = 1; k < shares.size(); ++k, ++layer)
        {
          if(modes[layer] > resolved_mode)
            result.back().push_back(0.5 * (shares[k - 1] + shares[k]));
          result.back().push_back(shares[k]);
        }
      }
      return result;
    }
  } // namespace

  std::vector<double> highest_modes(const FittedProblem &problem, const double time,
                                    const dealii::Vector<double> &u)
  {
    const RayMesh &mesh = problem.mesh();
    const auto degree = static_cast<unsigned int>(mesh.surface.degree);
    const std::vector<double> factors = highest_mode_factors(degree);
    std::vector<double> result;
    for(unsigned int layer = 0; layer < mesh.layers.size(); ++layer)
    {
      double largest = 0;
      for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
      {
        double mode = 0;
        for(unsigned int b = 0; b <= degree; ++b)
          mode += factors[b]
                  * problem.theta(mesh.layers[layer].interval, ray, layer * degree + b,
                                  time, u);
        largest = std::max(largest, std::abs(mode));
      }
      result.push_back(largest / problem.physics().temperature_scale);
    }
    return result;
  }

  void straighten_jumps(const FittedProblem &problem, const double time,
                        dealii::Vector<double> &u)
  {
    const RayMesh &mesh = problem.mesh();
    const auto degree = static_cast<unsigned int>(mesh.surface.degree);
    if(degree < telling_degree)
      return;
    std::vector<double> modes = highest_modes(problem, time, u);
    if(problem.physics().power)
      modes.front() = 0; // as in resolving_mesh()
    for(unsigned int layer = 0; layer < mesh.layers.size(); ++layer)
      for(unsigned int ray = 0;
          modes[layer] > resolved_mode && ray < mesh.surface.n_rays(); ++ray)
      {
        const auto theta = [&](unsigned int b) {
          return problem.theta(mesh.layers[layer].interval, ray, layer * degree + b, time,
                               u);
        };
        const auto place = [&](unsigned int b)
        { return problem.coordinate(ray, layer * degree + b, u); };
        const double from = theta(0), to = theta(degree);
        for(unsigned int b = 1; b < degree; ++b)
          u[mesh.node(ray, layer * degree + b)]
              = from + (to - from) * (place(b) - place(0)) / (place(degree) - place(0));
      }
  }

  RayMesh
  resolving_mesh(const RayMesh &given, const Physics &physics, const double time,
                 const std::vector<double> &fronts,
                 const std::function<double(const cases::Position &)> &temperature)
  {
    RayMesh mesh = given;
    for(int halvings = 0; mesh.surface.degree >= static_cast<int>(telling_degree);
        ++halvings)
    {
      const FittedProblem problem(mesh, physics);
      const dealii::Vector<double> u = problem.state(time, fronts, temperature);
      std::vector<double> modes = highest_modes(problem, time, u);
      // What a scene says of the temperature at a source is bounded, its field is not:
      // halved cells would show that ever more.
      if(physics.power)
        modes.front() = 0;
      const auto worst = std::ranges::max_element(modes);
      if(*worst <= resolved_mode)
        break;
      if(halvings < most_halvings)
      {
        mesh = RayMesh(mesh.surface, mesh.inner, mesh.outer, halved_where(mesh, modes));
        continue;
      }
      if(*worst > mode_of_jump && mesh.surface.n_rays() > 1)
        throw cases::Refusal(fmt::format(
            "fem-fitted resolves temperatures that jump at the start along a line only; "
            "at t = {:.6g} they jump at r = {:.6g}",
            time,
            problem.coordinate(
                0, static_cast<unsigned int>(worst - modes.begin()) * mesh.surface.degree,
                u)));
      break;
    }
    return mesh;
  }
} // namespace meltfront::reference_fem::fitted
