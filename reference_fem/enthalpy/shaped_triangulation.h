#ifndef meltfront_reference_fem_enthalpy_shaped_triangulation_h
#define meltfront_reference_fem_enthalpy_shaped_triangulation_h

#include <cases/error.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/outline_mesh.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace meltfront::reference_fem
{
  inline constexpr unsigned int strip_width = 4; ///< cells across a slab in 2D and 3D

  inline bool of_simplices(const cases::BodyMesh &mesh)
  {
    return mesh.kind() == cases::CellKind::triangle
           || mesh.kind() == cases::CellKind::tetrahedron;
  }

  /** The cells of a scene's domain: see make_mesh. */
  template <int dim>
  struct ShapedTriangulation
  {
    ShapedTriangulation(const cases::Scene &scene, int n);

    dealii::Triangulation<dim> triangulation;
    bool cartesian;                        ///< cells are boxes along the axes
    bool curved;                           ///< the wall is a circle or a sphere
    bool simplices;                        ///< triangles or tetrahedra
    double spacing = 0;                    ///< cell size along the domain's side (m)
    std::array<unsigned int, 3> n_cells{}; ///< where they are boxes, by direction
    std::pair<dealii::Point<dim>, dealii::Point<dim>> corners; ///< there
    double strip_section = 1; ///< volume over the slab's measure (1, m or m^2)
    cases::Symmetry measure = cases::Symmetry::none; ///< of a radial mesh
    std::vector<cases::Side> sides;                  ///< that the boundary numbers name

  private:
    void mesh_block(const cases::Scene &scene, int n);
    void mesh_radius(const cases::Scene &scene, int n);
    void mesh_ball(const cases::Scene &scene, int n);
    void mesh_shell(const cases::Domain &domain, int n);
    void mesh_what_outline_bounds(const cases::Domain &domain, int n);
    void take_mesh(const cases::BodyMesh &mesh, int n);
    void number_round_walls(const cases::Domain &domain);
    void number_walls_of_mesh(const cases::BodyMesh &mesh);
  };

  template <int dim>
  ShapedTriangulation<dim>::ShapedTriangulation(const cases::Scene &scene, int n)
    : cartesian(scene.domain.rectangular())
    , curved(scene.domain.round() && dim > 1)
    , simplices(scene.domain.mesh && of_simplices(*scene.domain.mesh))
  {
    if(cartesian)
      mesh_block(scene, n);
    else if(scene.domain.mesh)
    {
      take_mesh(*scene.domain.mesh, n);
      spacing = scene.domain.side() / cells_along(scene, n);
    }
    else if(scene.domain.outline)
      mesh_what_outline_bounds(scene.domain, n);
    else if(curved && scene.domain.shape == cases::DomainShape::shell)
      mesh_shell(scene.domain, n);
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
    std::copy(cells.begin(), cells.end(), n_cells.begin());
    corners = {lower, upper};
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
      const double inner = scene.domain.inner_radius;
      const double length = scene.domain.radius - inner;
      const unsigned int cells
          = std::max(1L, std::lround(length / scene.domain.side() * (n + n % 2)));
      dealii::GridGenerator::subdivided_hyper_rectangle(
          triangulation, std::vector<unsigned int>{cells}, dealii::Point<1>(inner),
          dealii::Point<1>(scene.domain.radius));
      n_cells[0] = cells;
      corners = {dealii::Point<1>(inner), dealii::Point<1>(scene.domain.radius)};
      spacing = length / cells;
      measure = scene.domain.dimension == 2 ? cases::Symmetry::cylindrical
                                            : cases::Symmetry::spherical;
      number_round_walls(scene.domain);
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
      spacing = scene.domain.side() / n;
      number_round_walls(scene.domain);
    }
  }

  /** In 2D cells in rings, square in the middle between the walls; in 3D layers of the
   * six faces of a cube, halved. */
  template <int dim>
  void ShapedTriangulation<dim>::mesh_shell(const cases::Domain &domain, int n)
  {
    const double inner = domain.inner_radius, thickness = domain.radius - inner;
    const double wanted = domain.side() / n;
    if constexpr(dim == 2)
    {
      const auto layers
          = static_cast<unsigned int>(std::max(1L, std::lround(thickness / wanted)));
      const unsigned int around = cells_around_shell(domain, n);
      std::vector<dealii::Point<2>> vertices;
      std::vector<dealii::CellData<2>> cells;
      for(unsigned int i = 0; i < around; ++i)
        for(unsigned int j = 0; j <= layers; ++j)
        {
          const double angle = 2 * std::numbers::pi * i / around;
          const double r = inner + thickness * j / layers;
          vertices.emplace_back(r * std::cos(angle), r * std::sin(angle));
          if(j == layers)
            continue;
          const unsigned int here = i * (layers + 1) + j;
          const unsigned int next = (i + 1) % around * (layers + 1) + j;
          cells.emplace_back();
          cells.back().vertices = {here, here + 1, next, next + 1};
        }
      triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
      triangulation.set_all_manifold_ids(0);
      triangulation.set_manifold(0, dealii::SphericalManifold<2>());
      spacing = thickness / layers;
    }
    else if constexpr(dim == 3)
    {
      const int refinements = halvings_of_shell(domain, n);
      const auto layers = static_cast<unsigned int>(
          std::max(1L, std::lround(thickness / wanted / (1 << refinements))));
      dealii::GridGenerator::concentric_hyper_shells(triangulation, dealii::Point<3>(),
                                                     inner, domain.radius, layers, 0., 6);
      triangulation.refine_global(refinements);
      spacing = thickness / (layers << refinements);
    }
    number_round_walls(domain);
  }

  template <int dim>
  void ShapedTriangulation<dim>::mesh_what_outline_bounds(const cases::Domain &domain,
                                                          int n)
  {
    if constexpr(dim == 2)
    {
      spacing = domain.side() / n;
      const QuadrilateralMesh mesh = mesh_outline(*domain.outline, spacing);
      std::vector<dealii::Point<2>> vertices;
      for(const auto &[x, y] : mesh.vertices)
        vertices.emplace_back(x, y);
      std::vector<dealii::CellData<2>> cells(mesh.cells.size());
      for(std::size_t c = 0; c < cells.size(); ++c)
        cells[c].vertices.assign(mesh.cells[c].begin(), mesh.cells[c].end());
      dealii::GridTools::consistently_order_cells(cells);
      triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
      for(const auto &face : triangulation.active_face_iterators())
        if(face->at_boundary())
          face->set_boundary_id(static_cast<unsigned int>(cases::Side::outer));
      sides = {cases::Side::outer};
    }
  }

  /** The cells of a file, halved along their edges as often as n says. Their boundary
   * numbers are those of the mesh's walls, their material numbers its own. */
  template <int dim>
  void ShapedTriangulation<dim>::take_mesh(const cases::BodyMesh &mesh, int n)
  {
    if constexpr(dim > 1)
    {
      if(!std::has_single_bit(static_cast<unsigned int>(n)))
        throw cases::Refusal(
            fmt::format("fem-enthalpy halves the edges of a mesh's cells: "
                        "it takes n = 1, 2, 4, 8, ..., not {}",
                        n));
      std::vector<dealii::Point<dim>> vertices(mesh.vertices().size());
      for(std::size_t v = 0; v < vertices.size(); ++v)
        for(int d = 0; d < dim; ++d)
          vertices[v][d] = mesh.vertices()[v][d];
      const std::size_t corners = mesh.cells().size() / mesh.n_cells();
      std::vector<dealii::CellData<dim>> cells(mesh.n_cells());
      for(std::size_t c = 0; c < cells.size(); ++c)
      {
        const auto first
            = mesh.cells().begin() + static_cast<std::ptrdiff_t>(c * corners);
        cells[c].vertices.assign(first, first + static_cast<std::ptrdiff_t>(corners));
        cells[c].material_id = mesh.material_of_cell(c);
      }
      if(dim == 2 && !simplices)
        dealii::GridTools::consistently_order_cells(cells);
      triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
      number_walls_of_mesh(mesh);
      triangulation.refine_global(std::countr_zero(static_cast<unsigned int>(n)));
    }
  }

  template <int dim>
  void ShapedTriangulation<dim>::number_walls_of_mesh(const cases::BodyMesh &mesh)
  {
    std::map<std::vector<unsigned int>, int> wall_of_face;
    for(const cases::BodyMesh::Face &face : mesh.boundary())
    {
      std::vector<unsigned int> vertices = face.vertices;
      std::ranges::sort(vertices);
      wall_of_face[vertices] = face.wall;
    }
    for(const auto &face : triangulation.active_face_iterators())
      if(face->at_boundary())
      {
        std::vector<unsigned int> vertices;
        for(const unsigned int v : face->vertex_indices())
          vertices.push_back(face->vertex_index(v));
        std::ranges::sort(vertices);
        const int wall = wall_of_face.at(vertices);
        const std::size_t side = wall < 0
                                     ? cases::n_sides
                                     : static_cast<std::size_t>(cases::mesh_wall(wall));
        face->set_boundary_id(static_cast<unsigned int>(side));
      }
    for(std::size_t wall = 0; wall < mesh.walls().size(); ++wall)
      sides.push_back(cases::mesh_wall(wall));
  }

  template <int dim>
  void ShapedTriangulation<dim>::number_round_walls(const cases::Domain &domain)
  {
    const double middle = (domain.inner_radius + domain.radius) / 2;
    for(const auto &cell : triangulation.active_cell_iterators())
      for(const auto face : cell->face_indices())
        if(cell->at_boundary(face))
        {
          const double distance = cell->face(face)->center().norm();
          if(distance > middle)
            cell->face(face)->set_boundary_id(
                static_cast<unsigned int>(cases::Side::outer));
          else if(domain.shape == cases::DomainShape::shell)
            cell->face(face)->set_boundary_id(
                static_cast<unsigned int>(cases::Side::inner));
        }
    sides = {cases::Side::outer};
    if(domain.shape == cases::DomainShape::shell)
      sides.push_back(cases::Side::inner);
  }
} // namespace meltfront::reference_fem

#endif
