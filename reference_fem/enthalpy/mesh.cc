#include <reference_fem/enthalpy/deal_mesh.h>

#include <deal.II/base/multithread_info.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem
{
  using cases::DomainShape;

  std::vector<int> mesh_dimensions(const cases::Scene &scene)
  {
    switch(scene.domain.shape)
    {
    case DomainShape::slab:
      return {1, 2, 3};
    case DomainShape::box:
    case DomainShape::axisymmetric:
    case DomainShape::mesh:
      return {scene.domain.dimension};
    default:
      if(scene.symmetry == cases::Symmetry::cylindrical
         || scene.symmetry == cases::Symmetry::spherical)
        return {1, scene.domain.dimension};
      return {scene.domain.dimension};
    }
  }

  double cells_along(const cases::Scene &scene, int n)
  {
    const auto &mesh = scene.domain.mesh;
    if(!mesh)
      return n;
    const double cells_of_box = !of_simplices(*mesh) ? 1 : mesh->dimension() == 2 ? 2 : 6;
    const double box
        = mesh->volume() / static_cast<double>(mesh->n_cells()) * cells_of_box;
    return n * scene.domain.side() / std::pow(box, 1. / mesh->dimension());
  }

  unsigned int cells_around_shell(const cases::Domain &domain, int n)
  {
    using std::numbers::pi;
    const double middle = (domain.inner_radius + domain.radius) / 2;
    const double eighths = 2 * pi * middle / (domain.side() / n) / 8;
    return static_cast<unsigned int>(8 * std::max(1L, std::lround(eighths)));
  }

  int halvings_of_shell(const cases::Domain &domain, int n)
  {
    const double middle = (domain.inner_radius + domain.radius) / 2;
    const double quarter = std::numbers::pi / 2 * middle;
    return std::max(
        0, static_cast<int>(std::lround(std::log2(quarter / (domain.side() / n)))));
  }

  double spacing_along_wall(const cases::Scene &scene, cases::Side side, int n)
  {
    using std::numbers::pi;
    const cases::Domain &domain = scene.domain;
    if(!domain.round())
      return domain.side() / n;
    const bool shell = domain.shape == cases::DomainShape::shell;
    const double radius
        = side == cases::Side::inner ? domain.inner_radius : domain.radius;
    // A ball's wall has 8 edges, in space 24 squares, before it is halved.
    if(domain.dimension == 2)
      return 2 * pi * radius / (shell ? cells_around_shell(domain, n) : 2 * n);
    const double faces = shell ? 6 * std::exp2(2 * halvings_of_shell(domain, n))
                               : 24 * (n / 4.) * (n / 4.);
    return radius * std::sqrt(4 * pi / faces);
  }

  std::unique_ptr<Mesh> make_mesh(const cases::Scene &scene, int dimension, int n)
  {
    // With threads, deal.II rounds its integrals over cells and its sums over vectors
    // differently.
    dealii::MultithreadInfo::set_thread_limit(1);
    switch(dimension)
    {
    case 1:
      return std::make_unique<DealMesh<1>>(scene, n);
    case 2:
      return std::make_unique<DealMesh<2>>(scene, n);
    default:
      return std::make_unique<DealMesh<3>>(scene, n);
    }
  }
} // namespace meltfront::reference_fem
