#include <reference_fem/enthalpy/deal_mesh.h>

#include <deal.II/base/multithread_info.h>

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
