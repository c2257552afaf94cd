#ifndef meltfront_reference_fem_enthalpy_mesh_h
#define meltfront_reference_fem_enthalpy_mesh_h

#include <cases/scene.h>
#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/lattice.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace meltfront::reference_fem
{
  /** A node on a wall. */
  struct WallNode
  {
    unsigned int node;
    double area; ///< integral of its shape function over the wall
    cases::Position position;
  };

  /** Nodes (or vertices) among which something is shared, with shares that sum up to one.
   */
  using Shares = std::vector<std::pair<unsigned int, double>>;

  /** A site that is no node: its values are those of nodes around it, in shares. */
  struct HangingSite
  {
    unsigned int site;
    Shares nodes;
  };

  /**
   * A scene's domain discretised with linear elements, as plain arrays: what the solver
   * works on. All integrals are in the measure of the scene (see
   * cases::Snapshot::weights): per area in a slab, also where a strip of it is meshed in
   * two or three dimensions, with the weight 2 pi r or 4 pi r^2 in a radial mesh.
   *
   * A *site* is a vertex of the mesh, a *node* an unknown: on periodic sides several
   * sites share a node, and where cells of two sizes meet a site may hang between nodes.
   */
  struct Discretisation
  {
    int dimension = 1;
    double spacing = 0; ///< cell size along the domain's side (m)
    cases::Symmetry measure = cases::Symmetry::none; ///< of a radial mesh

    std::array<std::vector<double>, 3> site_positions;
    std::vector<unsigned int> node_of_site; ///< of one that hangs the first of its nodes
    std::vector<HangingSite> hanging;
    std::vector<double> site_weights; ///< the node's volume at its first site, else 0
    std::vector<unsigned int> cells;  ///< sites by cell, lexicographic

    std::vector<cases::Position> positions; ///< by node
    std::vector<double> volume;             ///< by node: integral of the shape function
    ConductionMatrix conduction;
    std::optional<Lattice> lattice; ///< of the nodes, where the mesh is Cartesian
    std::array<std::vector<WallNode>, cases::n_sides> walls;
  };

  /** A mesh while the problem is set up: what needs its geometry. */
  class Mesh
  {
  public:
    virtual ~Mesh() = default;

    virtual Discretisation discretise() const = 0;

    /**
     * The nodes among which a point shares a load, with the values of their shape
     * functions there (their sum is one).
     * @throws cases::InputError if the point lies outside of the mesh
     */
    virtual Shares shares(const cases::Position &point) const = 0;

    /** Make shares() faster where it is called many times. */
    virtual void expect_many_points() = 0;

    /** Whether something holds anywhere. @param here whether it does in this part of a
     * mesh that several processes share */
    virtual bool anywhere(bool here) const
    {
      return here;
    }

    /**
     * Averages of a function over the part of each cell nearest to a node: in cells that
     * hold both phases or are beside such up to what jumps (in boxes and simplices by a
     * midpoint rule of 8 points per cell and direction), by Gauss' rule of 4 elsewhere.
     * A pocket of the other phase between those points is not seen.
     * @param solid the phase at a point
     * @param jumps whether the function may jump elsewhere than between the phases
     */
    virtual std::vector<double>
    node_averages(const std::function<double(const cases::Position &)> &function,
                  const std::function<bool(const cases::Position &)> &solid,
                  bool jumps) const = 0;
  };

  /** The dimensions in which a scene can be meshed, the lowest first. */
  std::vector<int> mesh_dimensions(const cases::Scene &scene);

  /** Cells along a scene's side at a resolution n: n itself, but of a mesh file's cells,
   * whose edges n divides, the side over the side of a square or a cube of the mean
   * volume of one (of two triangles, of six tetrahedra). */
  double cells_along(const cases::Scene &scene, int n);

  /** Mean distance (m) of the nodes on a wall of a disk, a ball or a shell, and of other
   * domains the cells' size: of meshes with the scene's own dimension. */
  double spacing_along_wall(const cases::Scene &scene, cases::Side side, int n);

  /** Cells of a shell along a circle in the plane, a multiple of eight: the mesh has the
   * symmetries of a square. In space the times that the six faces of a cube are halved.
   * Their size comes near to side/n in the middle between the walls. */
  unsigned int cells_around_shell(const cases::Domain &domain, int n);
  int halvings_of_shell(const cases::Domain &domain, int n);

  /**
   * Mesh a scene with n cells along the domain's side. The mesh refers to the scene,
   * which has to outlive it.
   *
   * Slab: an interval, or in 2D/3D a strip four cells wide, periodic across. Symmetric
   * ball in 1D: the radius. Box: a Cartesian mesh, cells as near to cubes as the sides
   * allow. Ball in 2D/3D: an unstructured mesh of 4 2^k cells along the diameter. Shell:
   * the interval between its radii, or rings of cells near to squares (2D) or layers of a
   * cube's faces (3D) as near to that size as they come. Axisymmetric body: its half
   * section like a box, with the weight 2 pi r. Mesh file: its cells, all edges halved
   * until there are n in place of one; n is a power of two.
   * On Cartesian meshes mass and stiffness are integrated at the vertices, which makes K
   * an M-matrix for any aspect ratio; elsewhere the masses are row sums, so that the
   * volumes add up to the mesh's volume. A cell that the surface of an inclusion cuts
   * conducts with the harmonic mean over it.
   *
   * @param dimension one of mesh_dimensions()
   * @throws cases::Refusal if the scene cannot be meshed so (outlines: mesh_outline())
   */
  std::unique_ptr<Mesh> make_mesh(const cases::Scene &scene, int dimension, int n);
} // namespace meltfront::reference_fem

#endif
