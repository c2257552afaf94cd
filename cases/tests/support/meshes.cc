#include <cases/tests/support/meshes.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meltfront::test_support
{
  namespace
  {
    using namespace cases;
    using Corners = std::vector<unsigned int>;

    /** The simplices of a box whose corners are in lexicographic order: along the ways
     * from its first corner to its last (Kuhn 1960). */
    std::vector<Corners> cells_of_box(CellKind kind, const Corners &c)
    {
      switch(kind)
      {
      case CellKind::triangle:
        return {{c[0], c[1], c[3]}, {c[0], c[3], c[2]}};
      case CellKind::tetrahedron:
        return {{c[0], c[1], c[3], c[7]}, {c[0], c[1], c[5], c[7]},
                {c[0], c[2], c[3], c[7]}, {c[0], c[2], c[6], c[7]},
                {c[0], c[4], c[5], c[7]}, {c[0], c[4], c[6], c[7]}};
      default:
        return {c};
      }
    }

    /** The faces of a box on one of its sides, around or as triangles of the same ways.
     */
    std::vector<Corners> faces_of_box(CellKind kind, const Corners &c, int side)
    {
      Corners on;
      for(unsigned int a = 0; a < c.size(); ++a)
        if(static_cast<int>(a >> (side / 2) & 1) == side % 2)
          on.push_back(c[a]);
      if(on.size() == 2)
        return {on};
      if(kind == CellKind::tetrahedron)
        return {{on[0], on[1], on[3]}, {on[0], on[2], on[3]}};
      return {{on[0], on[1], on[3], on[2]}};
    }
  } // namespace

  BodyMeshData lattice_mesh(CellKind kind, int n, const PlaceMap &map,
                            const std::function<bool(const Position &)> &holds)
  {
    const int dimension = dimension_of(kind);
    const unsigned int along = static_cast<unsigned int>(n) + 1;
    const std::array<unsigned int, 3> counts{along, along, dimension == 3 ? along : 1};
    BodyMeshData mesh;
    mesh.kind = kind;
    mesh.materials = {"body"};
    for(unsigned int k = 0; k < counts[2]; ++k)
      for(unsigned int j = 0; j < counts[1]; ++j)
        for(unsigned int i = 0; i < counts[0]; ++i)
        {
          const Position p{double(i) / n, double(j) / n, double(k) / n};
          mesh.vertices.push_back(map ? map(p) : p);
        }
    for(int side = 0; side < 2 * dimension; ++side)
      mesh.walls.emplace_back(to_string(static_cast<Side>(side)));
    for(int k = 0; k < (dimension == 3 ? n : 1); ++k)
      for(int j = 0; j < n; ++j)
        for(int i = 0; i < n; ++i)
        {
          const std::array<int, 3> index{i, j, k};
          if(holds && !holds({(i + 0.5) / n, (j + 0.5) / n, (k + 0.5) / n}))
            continue;
          Corners corners;
          for(unsigned int a = 0; a < (1u << dimension); ++a)
            corners.push_back(((static_cast<unsigned int>(k) + (a >> 2 & 1)) * along
                               + static_cast<unsigned int>(j) + (a >> 1 & 1))
                                  * along
                              + static_cast<unsigned int>(i) + (a & 1));
          for(const Corners &cell : cells_of_box(kind, corners))
          {
            mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
            mesh.material_of_cell.push_back(0);
          }
          for(int side = 0; side < 2 * dimension; ++side)
            if(index[static_cast<std::size_t>(side / 2)] == (side % 2 == 0 ? 0 : n - 1))
              for(const Corners &face : faces_of_box(kind, corners, side))
                mesh.faces.push_back({face, static_cast<unsigned int>(side)});
        }
    return mesh;
  }

  std::string gmsh_text(const BodyMeshData &mesh)
  {
    const int dimension = dimension_of(mesh.kind);
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
    text += fmt::format("{}\n", mesh.walls.size() + mesh.materials.size());
    for(std::size_t wall = 0; wall < mesh.walls.size(); ++wall)
      text += fmt::format("{} {} \"{}\"\n", dimension - 1, wall + 1, mesh.walls[wall]);
    for(std::size_t material = 0; material < mesh.materials.size(); ++material)
      text += fmt::format("{} {} \"{}\"\n", dimension, material + 1,
                          mesh.materials[material]);
    text += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", mesh.vertices.size());
    for(std::size_t v = 0; v < mesh.vertices.size(); ++v)
      text += fmt::format("{} {} {} {}\n", v + 1, mesh.vertices[v][0],
                          mesh.vertices[v][1], mesh.vertices[v][2]);
    text += fmt::format("$EndNodes\n$Elements\n{}\n",
                        mesh.faces.size() + mesh.material_of_cell.size());
    int number = 0;
    const auto add = [&](int type, unsigned int group, Corners vertices)
    {
      for(unsigned int &v : vertices)
        ++v;
      text += fmt::format("{} {} 2 {} 1 {}\n", ++number, type, group + 1,
                          fmt::join(vertices, " "));
    };
    for(const BodyMeshData::NamedFace &face : mesh.faces)
      add(static_cast<int>(face.vertices.size()) - 1, face.wall, face.vertices);
    constexpr int types[] = {2, 3, 4, 5};
    const std::size_t corners = corners_of(mesh.kind);
    for(std::size_t cell = 0; cell < mesh.material_of_cell.size(); ++cell)
    {
      const auto first = mesh.cells.begin() + static_cast<std::ptrdiff_t>(cell * corners);
      Corners vertices(first, first + static_cast<std::ptrdiff_t>(corners));
      if(mesh.kind == CellKind::quadrilateral || mesh.kind == CellKind::hexahedron)
        std::swap(vertices[2], vertices[3]);
      if(mesh.kind == CellKind::hexahedron)
        std::swap(vertices[6], vertices[7]);
      add(types[static_cast<std::size_t>(mesh.kind)], mesh.material_of_cell[cell],
          vertices);
    }
    return text + "$EndElements\n";
  }

  void take_mesh(Scene &scene, const BodyMeshData &data)
  {
    const auto mesh = std::make_shared<const BodyMesh>(data);
    scene.symmetry = Symmetry::none;
    scene.boundaries = {};
    scene.domain = {};
    scene.domain.shape = DomainShape::mesh;
    scene.domain.dimension = mesh->dimension();
    scene.domain.mesh = mesh;
    scene.domain.lower = mesh->lower();
    scene.domain.upper = mesh->upper();
    for(int d = 0; d < 3; ++d)
      scene.domain.reference_length
          = std::max(scene.domain.reference_length, mesh->upper()[d] - mesh->lower()[d]);
    for(std::size_t wall = 0; wall < mesh->walls().size(); ++wall)
      scene.boundaries[static_cast<std::size_t>(mesh_wall(wall))] = Boundary();
  }
} // namespace meltfront::test_support
