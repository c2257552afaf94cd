#ifndef meltfront_cases_body_mesh_h
#define meltfront_cases_body_mesh_h

#include <cases/position.h>
#include <cases/simplices.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  enum class CellKind
  {
    triangle,
    quadrilateral,
    tetrahedron,
    hexahedron
  };

  /** The plural: `triangles`. */
  const char *to_string(CellKind kind);

  /** 2 or 3. */
  int dimension_of(CellKind kind);

  unsigned int corners_of(CellKind kind);

  /** What a mesh file says of a body. */
  struct BodyMeshData
  {
    /** An edge in the plane, a face in space, that belongs to a named part of the
     * boundary. */
    struct NamedFace
    {
      std::vector<unsigned int> vertices;
      unsigned int wall;
    };

    CellKind kind = CellKind::triangle;
    std::vector<Position> vertices;
    /** Vertices by cell; of quadrilaterals and hexahedra in lexicographic order. */
    std::vector<unsigned int> cells;
    std::vector<unsigned int> material_of_cell;
    std::vector<std::string> materials;
    std::vector<NamedFace> faces;
    std::vector<std::string> walls;
  };

  /**
   * A body given by a mesh: one that is bounded by straight edges in the plane, by plane
   * or bilinear faces in space. What is asked of it (volume, areas, whether a point lies
   * inside) is exact to round-off for the mesh as it is, whatever smooth body it stands
   * for.
   */
  class BodyMesh
  {
  public:
    struct Face
    {
      std::vector<unsigned int> vertices; ///< in the plane 2; in space 3, or 4 around
      int wall;                           ///< index of the wall; -1: of none
    };

    /** A point and the length, area or volume that it stands for. */
    using WeightedPointVisitor = std::function<void(const Position &, double weight)>;

    /**
     * Cells that are turned inside out as a whole are turned back; vertices that no cell
     * has, and named faces inside of the body, are left out.
     * @throws InputError, one clause without place, for a mesh that has no cells, folded
     * or flat ones, some that overlap, vertices at the same place, or parts that share no
     * face; for a face of two walls
     */
    explicit BodyMesh(BodyMeshData data);

    CellKind kind() const
    {
      return data.kind;
    }
    int dimension() const
    {
      return dimension_of(data.kind);
    }
    std::size_t n_cells() const
    {
      return data.material_of_cell.size();
    }
    const std::vector<Position> &vertices() const
    {
      return data.vertices;
    }
    /** See BodyMeshData::cells. */
    const std::vector<unsigned int> &cells() const
    {
      return data.cells;
    }
    unsigned int material_of_cell(std::size_t cell) const
    {
      return data.material_of_cell[cell];
    }
    const std::vector<std::string> &materials() const
    {
      return data.materials;
    }
    /** Names of parts of the boundary; of some that the body may have no face of. */
    const std::vector<std::string> &walls() const
    {
      return data.walls;
    }
    /** All of the boundary. */
    const std::vector<Face> &boundary() const
    {
      return faces;
    }

    /** m^2 in the plane, m^3 in space */
    double volume() const
    {
      return total_volume;
    }
    /** Of a wall, or (-1) of what belongs to none: m in the plane, m^2 in space. */
    double area(int wall) const;

    /** Corners of the bounding box (m). */
    const Position &lower() const
    {
      return lower_corner;
    }
    const Position &upper() const
    {
      return upper_corner;
    }

    /** The cell that holds a point, the lowest of several where it lies between them; the
     * boundary counts as inside. */
    std::optional<std::size_t> cell_at(const Position &point) const;

    /** Visit points over the body, one in each simplex that its cells are divided into,
     * or in each of 2^(levels dimension) parts of these. */
    void visit_volume(int levels, const WeightedPointVisitor &visit) const;

    /** The same over a wall. */
    void visit_wall(unsigned int wall, int levels,
                    const WeightedPointVisitor &visit) const;

    /** Distance from the boundary (m), on either side of it. */
    double distance_from_boundary(const Position &point) const;

  private:
    std::vector<Simplex> simplices_of_cell(std::size_t cell) const;
    std::vector<Simplex> simplices_of_face(const std::vector<unsigned int> &face) const;
    Position mean_of(const std::vector<unsigned int> &vertices) const;
    std::vector<unsigned int> corners(std::size_t cell) const;

    void drop_unused_vertices();
    void find_box();
    void require_separate_vertices() const;
    void turn_cells();
    void find_boundary();
    void sort_cells_into_bins();
    std::size_t bin_of(const std::array<std::size_t, 3> &index) const;
    std::array<std::size_t, 3> index_at(const Position &point) const;

    BodyMeshData data;
    std::vector<Face> faces;
    double total_volume = 0;
    Position lower_corner{}, upper_corner{};
    std::array<std::size_t, 3> n_bins{1, 1, 1};
    std::vector<std::vector<std::size_t>> bins; ///< the cells whose boxes touch each
  };
} // namespace meltfront::cases

#endif
