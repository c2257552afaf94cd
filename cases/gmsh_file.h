#ifndef meltfront_cases_gmsh_file_h
#define meltfront_cases_gmsh_file_h

#include <cases/body_mesh.h>

#include <string>

namespace meltfront::cases
{
  /**
   * The cells of a mesh file of gmsh: text in its formats 2.2 and 4.1. Of the elements
   * those of the highest dimension are the cells, all of one kind and linear; their
   * physical groups are materials. Elements of one dimension less that are of a physical
   * group are named faces. A group is known by its name, or by its number where it has
   * none; elements of no group belong to the material `0`, or to no wall.
   *
   * deal.II's own reader drops the names of groups and does not end on some files that
   * break off.
   *
   * @param file names it in messages
   * @param dimension that the cells are to have; in the plane all vertices have the same
   * z
   * @throws InputError, `FILE:LINE: ...`, for anything that is not as above
   */
  BodyMeshData read_gmsh(const std::string &text, const std::string &file, int dimension);
} // namespace meltfront::cases

#endif
