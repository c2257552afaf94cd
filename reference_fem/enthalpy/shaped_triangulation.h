#ifndef meltfront_reference_fem_enthalpy_shaped_triangulation_h
#define meltfront_reference_fem_enthalpy_shaped_triangulation_h

#include <cases/error.h>
#include <cases/scene.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace meltfront::reference_fem
{
  inline constexpr unsigned int strip_width = 4; ///< cells across a slab in 2D and 3D

  /** The cells of a scene's domain: see make_mesh. */
  template <int dim>
  struct ShapedTriangulation
  {
    ShapedTriangulation(const cases::Scene &scene, int n);

    dealii::Triangulation<dim> triangulation;
    bool cartesian;           ///< cells are boxes along the axes
    bool curved;              ///< the wall is a circle or a sphere
    double spacing = 0;       ///< cell size along the domain's side (m)
    double strip_section = 1; ///< volume over the slab's measure (1, m or m^2)
    cases::Symmetry measure = cases::Symmetry::none; ///< of a radial mesh
    std::vector<cases::Side> sides;                  ///< that the boundary numbers name

  private:
    void mesh_block(const cases::Scene &scene, int n);
    void mesh_radius(const cases::Scene &scene, int n);
    void mesh_ball(const cases::Scene &scene, int n);
  };

  template <int dim>
  ShapedTriangulation<dim>::ShapedTriangulation(const cases::Scene &scene, int n)
    : cartesian(scene.domain.shape != cases::DomainShape::ball)
    , curved(!cartesian && dim > 1)
  {
    if(cartesian)
      mesh_block(scene, n);
    else if(curved)
      mesh_ball(scene, n);
    else
      mesh_radius(scene, n);
  }

  template <int dim>
  void ShapedTriangulation<dim>::mesh_block(const cases::Scene &scene, int n)
  {
    const cases::Domain &domain = scene.domain;
    const bool strip = domain.shape == cases::DomainShape::slab;
    spacing = domain.side() / n;
    dealii::Point<dim> lower, upper;
    std::vector<unsigned int> cells(dim, n);
    for(int d = 0; d < dim; ++d)
    {
      lower[d] = domain.lower[d];
      upper[d] = domain.upper[d];
      if(d > 0 && strip)
      {
        cells[d] = strip_width;
        upper[d] = lower[d] + strip_width * spacing;
        strip_section *= strip_width * spacing;
      }
      else if(d > 0)
        cells[d]
            = std::max(1, static_cast<int>(std::lround((upper[d] - lower[d]) / spacing)));
    }
    dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, cells, lower, upper,
                                                      true);
    // deal.II numbers the sides of a block in the order of cases::Side.
    sides = scene.sides();
  }

  template <int dim>
  void ShapedTriangulation<dim>::mesh_radius(const cases::Scene &scene, int n)
  {
    if constexpr(dim == 1)
    {
      const unsigned int cells = std::max(1, (n + 1) / 2);
      dealii::GridGenerator::subdivided_hyper_rectangle(
          triangulation, std::vector<unsigned int>{cells}, dealii::Point<1>(0),
          dealii::Point<1>(scene.domain.radius));
      spacing = scene.domain.radius / cells;
      measure = scene.domain.dimension == 2 ? cases::Symmetry::cylindrical
                                            : cases::Symmetry::spherical;
      for(const auto &cell : triangulation.active_cell_iterators())
        for(const auto face : cell->face_indices())
          if(cell->at_boundary(face) && cell->face(face)->center()[0] > 0)
            cell->face(face)->set_boundary_id(
                static_cast<unsigned int>(cases::Side::outer));
      sides = {cases::Side::outer};
    }
  }

  template <int dim>
  void ShapedTriangulation<dim>::mesh_ball(const cases::Scene &scene, int n)
  {
    if constexpr(dim > 1)
    {
      int refinements = 0;
      while((4 << refinements) < n)
        ++refinements;
      if((4 << refinements) != n)
        throw cases::Refusal(fmt::format(
            "fem-enthalpy meshes a ball in {}D only with n = 4, 8, 16, 32, ... cells "
            "along the diameter, not {}",
            dim, n));
      dealii::GridGenerator::hyper_ball_balanced(triangulation, dealii::Point<dim>(),
                                                 scene.domain.radius);
      triangulation.refine_global(refinements);
      for(const auto &face : triangulation.active_face_iterators())
        if(face->at_boundary())
          face->set_boundary_id(static_cast<unsigned int>(cases::Side::outer));
      spacing = scene.domain.side() / n;
      sides = {cases::Side::outer};
    }
  }
} // namespace meltfront::reference_fem

#endif
