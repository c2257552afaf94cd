#include <cases/case_file/generated_mesh.h>
#include <cases/error.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

namespace meltfront::cases
{
  namespace
  {
    constexpr double most_generated_cells = 2e5;

    using Numbers = std::set<unsigned int>;

    std::vector<std::string> names_of(const Numbers &numbers)
    {
      std::vector<std::string> names;
      for(const unsigned int number : numbers)
        names.push_back(std::to_string(number));
      return names;
    }

    unsigned int index_of(unsigned int number, const Numbers &numbers)
    {
      return static_cast<unsigned int>(
          std::distance(numbers.begin(), numbers.find(number)));
    }

    /** An exception of deal.II's in one line. */
    std::string one_line(const dealii::ExceptionBase &error)
    {
      std::ostringstream out;
      error.print_info(out);
      std::istringstream in(out.str());
      std::string result, word;
      while(in >> word)
        result += (result.empty() ? "" : " ") + word;
      return result;
    }

    template <int dim>
    bool follows_a_curve(const dealii::Triangulation<dim> &triangulation)
    {
      for(const dealii::types::manifold_id number : triangulation.get_manifold_ids())
        if(number != dealii::numbers::flat_manifold_id)
          return true;
      return false;
    }

    template <int dim>
    BodyMeshData cells_of(const dealii::Triangulation<dim> &triangulation)
    {
      BodyMeshData result;
      result.kind = dim == 2 ? CellKind::quadrilateral : CellKind::hexahedron;
      for(const dealii::Point<dim> &p : triangulation.get_vertices())
      {
        Position &vertex = result.vertices.emplace_back();
        for(int d = 0; d < dim; ++d)
          vertex[d] = p[d];
      }
      Numbers walls, materials;
      for(const auto &cell : triangulation.active_cell_iterators())
      {
        materials.insert(cell->material_id());
        for(const auto &face : cell->face_iterators())
          if(face->at_boundary())
            walls.insert(face->boundary_id());
      }
      result.walls = names_of(walls);
      result.materials = names_of(materials);
      for(const auto &cell : triangulation.active_cell_iterators())
      {
        for(const unsigned int v : cell->vertex_indices())
          result.cells.push_back(cell->vertex_index(v));
        result.material_of_cell.push_back(index_of(cell->material_id(), materials));
        for(const auto &face : cell->face_iterators())
          if(face->at_boundary())
          {
            auto &named = result.faces.emplace_back();
            named.wall = index_of(face->boundary_id(), walls);
            for(const unsigned int v : face->vertex_indices())
              named.vertices.push_back(face->vertex_index(v));
          }
      }
      return result;
    }

    template <int dim>
    GeneratedMesh generate(const std::string &name, const std::string &arguments,
                           int halvings)
    {
      constexpr bool check_for_distorted_cells = true;
      dealii::Triangulation<dim> triangulation(dealii::Triangulation<dim>::none,
                                               check_for_distorted_cells);
      try
      {
        dealii::GridGenerator::generate_from_name_and_arguments(triangulation, name,
                                                                arguments);
        const double cells
            = triangulation.n_active_cells() * std::exp2(dim * double(halvings));
        if(cells > most_generated_cells)
          throw InputError(fmt::format("makes {:.3g} cells after {} halvings; there may "
                                       "be {:g}",
                                       cells, halvings, most_generated_cells));
        triangulation.refine_global(static_cast<unsigned int>(halvings));
      }
      catch(const dealii::ExceptionBase &error)
      {
        throw InputError(fmt::format("makes no mesh of a {}; deal.II says: {}", name,
                                     one_line(error)));
      }
      return {cells_of(triangulation), follows_a_curve(triangulation)};
    }
  } // namespace

  GeneratedMesh generate_mesh(const MeshGenerator &generator, int dimension,
                              const std::string &arguments, int halvings)
  {
    check_arguments(generator, dimension, arguments);
    return dimension == 2 ? generate<2>(generator.name, arguments, halvings)
                          : generate<3>(generator.name, arguments, halvings);
  }
} // namespace meltfront::cases
