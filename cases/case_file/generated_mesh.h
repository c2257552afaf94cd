#ifndef meltfront_cases_case_file_generated_mesh_h
#define meltfront_cases_case_file_generated_mesh_h

#include <cases/body_mesh.h>
#include <cases/case_file/mesh_generators.h>

#include <string>

namespace meltfront::cases
{
  struct GeneratedMesh
  {
    /** Walls and materials are named by the numbers that the generator gives. */
    BodyMeshData cells;
    bool curved = false; ///< halved cells follow a curve
  };

  /**
   * The mesh of one of deal.II's generators.
   * @param halvings how often edges are halved, new vertices being put on the body's
   * curves
   * @throws InputError, one clause without place, for arguments that make no mesh or one
   * of too many cells
   */
  GeneratedMesh generate_mesh(const MeshGenerator &generator, int dimension,
                              const std::string &arguments, int halvings);
} // namespace meltfront::cases

#endif
