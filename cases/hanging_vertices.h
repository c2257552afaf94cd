#ifndef meltfront_cases_hanging_vertices_h
#define meltfront_cases_hanging_vertices_h

#include <cases/body_mesh.h>

#include <optional>

namespace meltfront::cases
{
  /** A vertex on the boundary that lies on a face without being one of its vertices, if
   * there is one: cells of two sizes meet there, and no heat would pass between them.
   * @param tolerance distance at which a vertex counts as lying on a face (m) */
  std::optional<Position> hanging_vertex(const BodyMesh &mesh, double tolerance);
} // namespace meltfront::cases

#endif
