#ifndef meltfront_cases_tests_support_meshes_h
#define meltfront_cases_tests_support_meshes_h

#include <cases/body_mesh.h>
#include <cases/scene.h>

#include <functional>
#include <string>

/** Meshes that tests of several folders share. */
namespace meltfront::test_support
{
  using PlaceMap = std::function<cases::Position(const cases::Position &)>;

  /**
   * The unit square or cube in n cells along each direction, or in the two triangles or
   * six tetrahedra of each, with its vertices moved by a map. Its material is `body`; its
   * walls are `x_min` to `y_max` or `z_max`.
   * @param holds which cells there are, by their middles before they are moved; what that
   * lays bare is of no wall
   */
  cases::BodyMeshData
  lattice_mesh(cases::CellKind kind, int n, const PlaceMap &map = {},
               const std::function<bool(const cases::Position &)> &holds = {});

  /** The mesh as a file of gmsh's format 2.2. */
  std::string gmsh_text(const cases::BodyMeshData &mesh);

  /** A scene's domain becomes a mesh; all walls are insulated. */
  void take_mesh(cases::Scene &scene, const cases::BodyMeshData &mesh);
} // namespace meltfront::test_support

#endif
