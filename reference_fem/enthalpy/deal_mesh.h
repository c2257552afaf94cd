#ifndef meltfront_reference_fem_enthalpy_deal_mesh_h
#define meltfront_reference_fem_enthalpy_deal_mesh_h

#include <reference_fem/enthalpy/cell_geometry.h>
#include <reference_fem/enthalpy/cell_rules.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/shaped_triangulation.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/grid_tools_cache.h>

#include <optional>
#include <utility>

namespace meltfront::reference_fem
{
  template <int dim>
  cases::Position position(const dealii::Point<dim> &point)
  {
    cases::Position result{};
    for(int d = 0; d < dim; ++d)
      result[d] = point[d];
    return result;
  }

  /** A mesh of deal.II's. */
  template <int dim>
  class DealMesh : public Mesh
  {
  public:
    DealMesh(const cases::Scene &scene, int n);

    Discretisation discretise() const override;
    Shares shares(const cases::Position &point) const override;
    void expect_many_points() override
    {
      finder.emplace(shape.triangulation, *rules.mapping);
    }
    std::vector<double>
    node_averages(const std::function<double(const cases::Position &)> &function,
                  const std::function<bool(const cases::Position &)> &solid,
                  bool jumps) const override;

  private:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    /** A cell and a point of its unit cell. */
    using Place = std::pair<Cell, dealii::Point<dim>>;

    std::optional<Place> find(const dealii::Point<dim> &point) const;
    std::optional<Place> find_in_file(const dealii::Point<dim> &point) const;
    bool periodic(int direction) const;
    void number_nodes();
    void number_along_lattice();

    /** The measure of the scene at a point, per volume of the mesh. */
    double weight(const dealii::Point<dim> &point) const;

    std::vector<unsigned int> sites(const Cell &cell) const;
    std::vector<unsigned int> neighbours_at_most() const;
    std::vector<char>
    cells_about_fronts(dealii::FEValues<dim> &values,
                       const std::function<bool(const cases::Position &)> &solid) const;
    std::vector<double>
    excess_about_corners(const CellGeometry<dim> &geometry,
                         const std::function<double(const cases::Position &)> &function,
                         double usual) const;
    void integrate_cells(Discretisation &result) const;

    /** Conductivity of a cell over that outside of the inclusion. */
    double relative_conductivity(const Cell &cell) const;
    void integrate_walls(Discretisation &result) const;
    void place_sites(Discretisation &result) const;

    const cases::Scene &scene;
    ShapedTriangulation<dim> shape;
    CellRules<dim> rules;
    dealii::DoFHandler<dim> dof_handler;
    std::optional<dealii::GridTools::Cache<dim>> finder;
    std::vector<unsigned int> node_of_site;
    unsigned int n_nodes = 0;
    std::optional<Lattice> lattice; ///< of the nodes, where cells are boxes
  };

} // namespace meltfront::reference_fem

#endif
