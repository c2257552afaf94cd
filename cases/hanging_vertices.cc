#include <cases/hanging_vertices.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    bool lies_on(const BodyMesh &mesh, const BodyMesh::Face &face, const Position &p,
                 double tolerance)
    {
      const auto at = [&](std::size_t a) { return mesh.vertices()[face.vertices[a]]; };
      if(face.vertices.size() == 2)
        return distance_from({at(0), at(1)}, p) <= tolerance;
      bool on = distance_from({at(0), at(1), at(2)}, p) <= tolerance;
      if(face.vertices.size() == 4)
        on = on || distance_from({at(0), at(2), at(3)}, p) <= tolerance;
      return on;
    }
  } // namespace

  std::optional<Position> hanging_vertex(const BodyMesh &mesh, double tolerance)
  {
    std::vector<unsigned int> on_boundary;
    for(const BodyMesh::Face &face : mesh.boundary())
      on_boundary.insert(on_boundary.end(), face.vertices.begin(), face.vertices.end());
    const auto x = [&mesh](unsigned int v) { return mesh.vertices()[v][0]; };
    std::ranges::sort(on_boundary, {},
                      [&x](unsigned int v) { return std::pair(x(v), v); });
    on_boundary.erase(std::ranges::unique(on_boundary).begin(), on_boundary.end());
    for(const BodyMesh::Face &face : mesh.boundary())
    {
      const auto [first, last] = std::ranges::minmax(face.vertices, {}, x);
      for(auto v = std::ranges::lower_bound(on_boundary, x(first) - tolerance, {}, x);
          v != on_boundary.end() && x(*v) <= x(last) + tolerance; ++v)
        if(std::ranges::find(face.vertices, *v) == face.vertices.end()
           && lies_on(mesh, face, mesh.vertices()[*v], tolerance))
          return mesh.vertices()[*v];
    }
    return {};
  }
} // namespace meltfront::cases
