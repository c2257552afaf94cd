#include <verification/report/chapters/scene_words.h>
#include <verification/report/pictures/mesh_walls.h>
#include <verification/report/plots/plot_layout.h>

#include <fmt/format.h>

#include <iterator>

namespace meltfront::verification
{
  std::string look_of_wall(cases::BoundaryKind kind)
  {
    if(kind == cases::BoundaryKind::insulated)
      return fmt::format("lw 2 dt (3,3) lc rgb '{}'", plot_colours::axis);
    if(kind == cases::BoundaryKind::periodic)
      return fmt::format("lw 1 dt (8,6) lc rgb '{}'", plot_colours::axis);
    return "lw 4 lc rgb 'black'";
  }

  std::vector<std::string> write_mesh_walls(std::string &script,
                                            const cases::Scene &scene)
  {
    const cases::BodyMesh &mesh = *scene.domain.mesh;
    const auto out = std::back_inserter(script);
    std::vector<std::string> plots;
    if(mesh.dimension() != 2)
      return plots;
    const int n_walls = static_cast<int>(mesh.walls().size());
    for(int number = 0; number <= n_walls; ++number)
    {
      const int wall = number == n_walls ? -1 : number;
      if(!(mesh.area(wall) > 0))
        continue;
      fmt::format_to(out, "$wall_{} << end_of_data\n", number);
      for(const cases::BodyMesh::Face &face : mesh.boundary())
        if(face.wall == wall)
        {
          for(const unsigned int v : face.vertices)
            fmt::format_to(out, "{:.8g} {:.8g}\n", mesh.vertices()[v][0],
                           mesh.vertices()[v][1]);
          fmt::format_to(out, "\n");
        }
      fmt::format_to(out, "end_of_data\n");
      const cases::BoundaryKind kind
          = wall < 0
                ? cases::BoundaryKind::insulated
                : scene.boundary(cases::mesh_wall(static_cast<std::size_t>(wall))).kind;
      plots.push_back(fmt::format("$wall_{} with lines {}", number, look_of_wall(kind)));
    }
    return plots;
  }

  std::string words_of_mesh_walls(const cases::Scene &scene)
  {
    std::string words;
    for(const cases::Side side : scene.sides())
      if(scene.boundary(side).kind != cases::BoundaryKind::insulated)
        words += fmt::format("{}{}: {}", words.empty() ? "" : "; ",
                             name_of(scene.domain, side),
                             short_words(scene.boundary(side)));
    return words;
  }
} // namespace meltfront::verification
