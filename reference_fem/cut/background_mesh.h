#ifndef meltfront_reference_fem_cut_background_mesh_h
#define meltfront_reference_fem_cut_background_mesh_h

#include <cases/scene.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace meltfront::reference_fem::cut
{
  inline constexpr int dim = 2;
  using Point = dealii::Point<dim>;
  using Gradient = dealii::Tensor<1, dim>;

  /** Values by degree of freedom. */
  using Values = std::vector<double>;

  cases::Position position(const Point &point);

  /** A point of a quadrature over a cell or a part of it. */
  struct VolumePoint
  {
    Point unit;    ///< in the unit cell
    double weight; ///< m^2
  };

  /** A point of a quadrature over a curve in a cell. */
  struct SurfacePoint
  {
    Point unit;      ///< in the unit cell
    double weight;   ///< m
    Gradient normal; ///< unit vector out of the inside of the level set
  };

  /** A rectangle of the mesh with its degrees of freedom. */
  struct Cell
  {
    Point lower;
    Gradient size; ///< m
    std::vector<unsigned int> dofs;
    std::vector<unsigned int> level_set_dofs;

    Point real(const Point &unit) const;
    Point unit(const Point &real) const;
    double volume() const;

    /** Shortest side (m). */
    double width() const;
  };

  /** Whether a cell, given by its lower corner and its size, is to be divided. */
  using RefinementCriterion
      = std::function<bool(const Point &lower, const Gradient &size)>;

  /** Divides the cells that the rim of a disk or of an annulus cuts. */
  RefinementCriterion divided_at_rim(const cases::Domain &domain);

  /** A face between two cells; where they differ in size `fine` is the smaller. */
  struct InnerFace
  {
    unsigned int fine, coarse;
    int direction; ///< of the normal
    bool upper;    ///< of the fine cell
  };

  /** A face on a side of a box. */
  struct WallFace
  {
    unsigned int cell;
    int direction;
    bool upper;
    cases::Side side;
  };

  /** A cell that the rim of a disk or of an annulus cuts. */
  struct CurvedBoundaryCell
  {
    unsigned int cell;
    cases::Side side;
    std::vector<VolumePoint> volume; ///< of the part inside of the domain
    std::vector<SurfacePoint> rim;   ///< normals out of the domain
  };

  /** Where a cell lies with respect to the domain. */
  enum class Place : char
  {
    inside,
    on_rim,
    outside
  };

  /**
   * The Cartesian mesh behind a scene: it fills a box; the rim of a disk or of an annulus
   * cuts it as the front does. Cells may be divided where it matters; neighbours, also
   * across a corner, differ by one division at most. deal.II holds triangulation, degrees
   * of freedom and hanging nodes; the rest reads them from plain arrays.
   */
  class BackgroundMesh
  {
  public:
    /**
     * @param n finest cells along the domain's side
     * @param degree of the temperature's elements, 1 or 2
     * @param level_set_degree of the level set's elements, 1 or 2
     * @param refinement divisions of the base mesh's cells, of which n / 2^refinement lie
     * along the side
     * @param divided which cells are divided; empty: none
     * @param finest_rim a mesh with the finest cells all along the rim, for the parts of
     * larger cells that lie inside: the domain is then the same on every mesh. Needed
     * where cells of unequal size may meet the rim.
     * @throws cases::Refusal for a scene that is not two-dimensional and for a number of
     * finest cells that the base mesh's cells cannot be divided into
     */
    BackgroundMesh(const cases::Scene &scene, int n, int degree, int level_set_degree,
                   int refinement = 0, const RefinementCriterion &divided = {},
                   const BackgroundMesh *finest_rim = nullptr);

    const dealii::FE_Q<dim> element, level_set_element;
    std::vector<Cell> cells;
    std::vector<InnerFace> inner_faces;
    std::vector<WallFace> wall_faces;
    std::vector<CurvedBoundaryCell> curved_boundary_cells;
    std::vector<Place> place;
    std::vector<Point> positions, level_set_positions; ///< by degree of freedom
    double spacing; ///< shortest side of the finest cells (m)

    /** Whether a cell is one of the finest. */
    bool finest(unsigned int cell) const
    {
      return cells[cell].width() < 1.5 * spacing;
    }

    /** The cell that holds a point. */
    unsigned int cell_at(const Point &point) const;

    /** Unconstrained degrees of freedom and weights that a degree of freedom of the
     * temperature stands for. */
    const std::vector<std::pair<unsigned int, double>> &expansion(unsigned int dof) const
    {
      return expansions[dof];
    }

    /** Values at the level set's degrees of freedom of a field of the temperature's
     * elements. */
    Values to_level_set_dofs(const Values &field) const;

    /** Give constrained degrees of freedom their values. */
    void distribute(Values &field) const;
    void distribute_level_set(Values &level_set) const;

    const dealii::DoFHandler<dim> &level_set_dof_handler() const
    {
      return level_set_dofs;
    }

    const dealii::Triangulation<dim>::active_cell_iterator &
    triangulation_cell(unsigned int cell) const
    {
      return triangulation_cells[cell];
    }

  private:
    void divide(const RefinementCriterion &divided);
    void number();
    void read_cells();
    void read_faces();
    void cut_rim();
    void take_rim(const BackgroundMesh &finest_rim);

    const cases::Domain domain;
    const int refinement;
    std::array<unsigned int, dim> base_cells; ///< by direction
    dealii::Triangulation<dim> triangulation;
    std::vector<dealii::Triangulation<dim>::active_cell_iterator> triangulation_cells;
    dealii::DoFHandler<dim> dofs, level_set_dofs;
    dealii::AffineConstraints<double> constraints, level_set_constraints;
    std::vector<std::vector<std::pair<unsigned int, double>>> expansions;
  };
} // namespace meltfront::reference_fem::cut

#endif
