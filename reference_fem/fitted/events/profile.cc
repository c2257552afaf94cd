#include <reference_fem/fitted/events/profile.h>

namespace meltfront::reference_fem::fitted
{
  double Profile::evaluate(const double r, const bool derivative) const
  {
    const RayMesh &mesh = problem.mesh();
    const unsigned int degree = mesh.surface.degree;
    std::size_t layer = 0;
    while(layer + 1 < mesh.layers.size() && r > mesh.layers[layer].fixed[1])
      ++layer;
    const double lower = mesh.layers[layer].fixed[0];
    const double width = mesh.layers[layer].fixed[1] - lower;
    const LineBasis basis(degree, {(r - lower) / width});
    double sum = 0;
    for(unsigned int b = 0; b <= degree; ++b)
      sum += u[mesh.node(0, static_cast<unsigned int>(layer) * degree + b)]
             * (derivative ? basis.derivative(0, b) / width : basis.value(0, b));
    return sum;
  }
} // namespace meltfront::reference_fem::fitted
