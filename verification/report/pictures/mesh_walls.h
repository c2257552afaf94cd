#ifndef meltfront_verification_report_pictures_mesh_walls_h
#define meltfront_verification_report_pictures_mesh_walls_h

#include <cases/scene.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** How gnuplot draws a wall. */
  std::string look_of_wall(cases::BoundaryKind kind);

  /**
   * Write the edges of a mesh of the plane that are its boundary into a script, wall by
   * wall, those of no wall last.
   * @return what is to be plotted; nothing of a mesh in space
   */
  std::vector<std::string> write_mesh_walls(std::string &script,
                                            const cases::Scene &scene);

  /** What the walls of a mesh prescribe: `hot: T = 1; rim: heat flux inward 3`. */
  std::string words_of_mesh_walls(const cases::Scene &scene);
} // namespace meltfront::verification

#endif
