#ifndef meltfront_reference_fem_cut_background_mesh_h
#define meltfront_reference_fem_cut_background_mesh_h

#include <cases/scene.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
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
  struct RimCell
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
   * cuts it as the front does. deal.II holds triangulation, degrees of freedom and
   * hanging nodes; the rest reads them from plain arrays.
   */
  class BackgroundMesh
  {
  public:
    /**
     * @param n cells along the domain's side
     * @param degree of the temperature's elements, 1 or 2
     * @param level_set_degree of the level set's elements, 1 or 2
     * @throws cases::Refusal for a scene that is not two-dimensional
     */
    BackgroundMesh(const cases::Scene &scene, int n, int degree, int level_set_degree);

    const dealii::FE_Q<dim> element, level_set_element;
    std::vector<Cell> cells;
    std::vector<InnerFace> inner_faces;
    std::vector<WallFace> wall_faces;
    std::vector<RimCell> rim_cells;
    std::vector<Place> place;
    std::vector<Point> positions, level_set_positions; ///< by degree of freedom
    double spacing; ///< shortest side of the finest cells (m)

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
    void number();
    void read_cells();
    void read_faces();
    void cut_rim();

    const cases::Domain domain;
    dealii::Triangulation<dim> triangulation;
    std::vector<dealii::Triangulation<dim>::active_cell_iterator> triangulation_cells;
    dealii::DoFHandler<dim> dofs, level_set_dofs;
    dealii::AffineConstraints<double> constraints, level_set_constraints;
    std::vector<std::vector<std::pair<unsigned int, double>>> expansions;
  };
} // namespace meltfront::reference_fem::cut

#endif
