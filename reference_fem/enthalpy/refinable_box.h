#ifndef meltfront_reference_fem_enthalpy_refinable_box_h
#define meltfront_reference_fem_enthalpy_refinable_box_h

#include <reference_fem/enthalpy/local_triangulation.h>
#include <reference_fem/enthalpy/refinable_mesh.h>
#include <reference_fem/enthalpy/row_builder.h>

#include <deal.II/base/quadrature_lib.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace meltfront::reference_fem
{
  /** Box meshes of make_refinable_mesh. Its members are defined in refinable_mesh.cc
   * (construction, places, fields, adaptation) and refinable_box.templates.h (what
   * becomes of it for the solver). */
  template <int dim>
  class RefinableBox : public RefinableMesh
  {
  public:
    RefinableBox(const cases::Scene &scene, int n);

    Discretisation discretise() const override;
    Shares shares(const cases::Position &point) const override;
    void expect_many_points() override
    {
    }
    std::vector<double>
    node_averages(const std::function<double(const cases::Position &)> &function,
                  const std::function<bool(const cases::Position &)> &solid,
                  bool jumps) const override;

    std::vector<int> halvings_left() const override;
    std::vector<double> jumps(const std::vector<double> &values) const override;
    std::size_t cell_at(const cases::Position &point) const override;
    std::vector<NestedLevel> levels(const ConductionMatrix &network) const override;
    bool adapt(const std::vector<Wish> &wishes,
               const std::vector<std::vector<double> *> &fields) override;
    void save(boost::archive::binary_oarchive &state) const override;
    void restore(boost::archive::binary_iarchive &state) override;

  private:
    using Cell = typename LocalTriangulation<dim>::Cell;
    static constexpr unsigned int n_corners = LocalTriangulation<dim>::n_corners;

    void number();
    std::uint64_t place(const dealii::Point<dim> &point) const;
    Cell find(const cases::Position &point) const;

    /** What a corner stands for in its cell, in the measure of the scene; on the face
     * across a direction, where one is given. */
    double part_of_corner(const Cell &cell, unsigned int corner, int across = -1) const;

    template <typename Visit>
    void visit_nodes(unsigned int vertex, double weight, const Visit &visit) const
    {
      LocalTriangulation<dim>::visit_masters(masters, vertex, weight,
                                             [&](unsigned int free, double share)
                                             { visit(node_of_vertex[free], share); });
    }

    std::vector<double> volumes() const;
    std::vector<double> by_vertex(const std::vector<double> &by_node) const;
    void place_sites(Discretisation &result) const;
    void conduct(Discretisation &result) const;
    void conduct_between(RowBuilder &rows, unsigned int a, unsigned int b,
                         double conductance) const;
    void find_walls(Discretisation &result) const;
    struct PlaceInCell
    {
      cases::Position position{};
      double volume = 1; ///< per volume of the unit cell
    };
    PlaceInCell place_in(const Cell &cell, const cases::Position &unit) const;

    template <typename Visit>
    void visit_points(const Cell &cell, const dealii::Quadrature<dim> &points,
                      const Visit &visit) const;

    const cases::Scene &scene;
    double spacing;               ///< of the smallest cells, along the domain's side
    int most_halvings;            ///< of a cell
    dealii::Point<dim> lower;     ///< corner of the domain
    dealii::Tensor<1, dim> sizes; ///< of the smallest cells
    LocalTriangulation<dim> local;
    std::vector<Shares> masters;              ///< by vertex; of one that hangs
    std::vector<unsigned int> vertex_of_site; ///< sites along x first
    std::vector<unsigned int> site_of_vertex;
    std::vector<unsigned int> node_of_vertex; ///< of one that is free
    unsigned int n_nodes = 0;
  };
} // namespace meltfront::reference_fem

#endif
