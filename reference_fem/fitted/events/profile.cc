#include <reference_fem/fitted/events/profile.h>

#include <algorithm>

namespace meltfront::reference_fem::fitted
{
  Profile::Profile(const FittedProblem &problem, const double time,
                   const dealii::Vector<double> &u)
    : problem(problem)
    , time(time)
    , u(u)
  {
    const RayMesh &mesh = problem.mesh();
    for(unsigned int level = 0; level < mesh.n_levels(); level += mesh.surface.degree)
      faces.push_back(problem.coordinate(0, level, u));
  }

  double Profile::evaluate(const double r, const bool derivative) const
  {
    const RayMesh &mesh = problem.mesh();
    const unsigned int degree = mesh.surface.degree;
    const auto layer = static_cast<unsigned int>(
        std::lower_bound(faces.begin() + 1, faces.end() - 1, r) - faces.begin() - 1);
    const double width = faces[layer + 1] - faces[layer];
    const LineBasis basis(degree, {(r - faces[layer]) / width});
    const unsigned int interval = mesh.layers[layer].interval;
    const SourceField field = problem.source(interval, time);
    double sum = derivative ? field.slope(r) : field.value(r);
    for(unsigned int b = 0; b <= degree; ++b)
      sum += problem.theta(interval, 0, layer * degree + b, time, u)
             * (derivative ? basis.derivative(0, b) / width : basis.value(0, b));
    return sum;
  }
} // namespace meltfront::reference_fem::fitted
