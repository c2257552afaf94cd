#include <reference_fem/cut/quadrature.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/non_matching/mesh_classifier.h>
#include <deal.II/non_matching/quadrature_generator.h>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Per direction and smooth piece of a cell. */
    constexpr unsigned int n_gauss_points = 3;

    using NonMatchingLocation = dealii::NonMatching::LocationToLevelSet;

    CutIntegrator::Side side(NonMatchingLocation location)
    {
      return location == NonMatchingLocation::inside    ? CutIntegrator::Side::inside
             : location == NonMatchingLocation::outside ? CutIntegrator::Side::outside
                                                        : CutIntegrator::Side::cut;
    }

    std::vector<VolumePoint> volume_points(const dealii::Quadrature<dim> &quadrature,
                                           const Cell &cell)
    {
      std::vector<VolumePoint> points;
      for(unsigned int q = 0; q < quadrature.size(); ++q)
        points.push_back({quadrature.point(q), quadrature.weight(q) * cell.volume()});
      return points;
    }
  } // namespace

  struct CutIntegrator::Generator
  {
    Generator(const BackgroundMesh &mesh, const dealii::Vector<double> &values)
      : quadrature(gauss, mesh.level_set_dof_handler(), values)
    {
    }

    // The generator refers to it.
    const dealii::hp::QCollection<1> gauss{dealii::QGauss<1>(n_gauss_points)};
    dealii::NonMatching::DiscreteQuadratureGenerator<dim> quadrature;
  };

  CutIntegrator::CutIntegrator(const BackgroundMesh &mesh, const Values &level_set)
    : mesh(mesh)
    , values(level_set.begin(), level_set.end())
    , generator(std::make_unique<Generator>(mesh, values))
  {
    dealii::NonMatching::MeshClassifier<dim> classifier(mesh.level_set_dof_handler(),
                                                        values);
    classifier.reclassify();
    for(const auto &cell : mesh.level_set_dof_handler().active_cell_iterators())
      by_cell.push_back(side(classifier.location_to_level_set(cell)));
  }

  CutIntegrator::~CutIntegrator() = default;

  CutQuadrature CutIntegrator::integrate(unsigned int number)
  {
    const Cell &cell = mesh.cells[number];
    auto &quadrature = generator->quadrature;
    quadrature.generate(mesh.triangulation_cell(number));
    CutQuadrature result{volume_points(quadrature.get_inside_quadrature(), cell),
                         volume_points(quadrature.get_outside_quadrature(), cell),
                         {}};
    const auto &surface = quadrature.get_surface_quadrature();
    for(unsigned int q = 0; q < surface.size(); ++q)
    {
      // Nanson's formula for a map that only stretches.
      Gradient normal = surface.normal_vector(q);
      for(int d = 0; d < dim; ++d)
        normal[d] *= cell.volume() / cell.size[d];
      const double stretch = normal.norm();
      result.surface.push_back(
          {surface.point(q), surface.weight(q) * stretch, normal / stretch});
    }
    return result;
  }

  std::vector<VolumePoint> whole_cell(const Cell &cell, unsigned int points_per_direction)
  {
    return volume_points(dealii::QGauss<dim>(points_per_direction), cell);
  }
} // namespace meltfront::reference_fem::cut
