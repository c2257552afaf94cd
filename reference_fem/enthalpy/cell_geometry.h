#ifndef meltfront_reference_fem_enthalpy_cell_geometry_h
#define meltfront_reference_fem_enthalpy_cell_geometry_h

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem
{
  /** Where the points of one quadrilateral or hexahedron are, and how much volume lies
   * about them, at far less than what a mapping takes for a single point: by polynomials
   * of the degree of those along which cells bend, on a tensor product of points. */
  template <int dim>
  class CellGeometry
  {
  public:
    CellGeometry(const dealii::Mapping<dim> &mapping,
                 const dealii::FiniteElement<dim> &element)
      : line(n_along)
      , nodes(line)
      , basis(dealii::Polynomials::generate_complete_Lagrange_basis(line.get_points()))
      , values(mapping, element, nodes,
               dealii::update_JxW_values | dealii::update_quadrature_points)
    {
    }

    template <typename Cell>
    void reinit(const Cell &cell)
    {
      values.reinit(cell);
    }

    struct Place
    {
      dealii::Point<dim> point;
      double volume = 0; ///< per volume of the unit cell
    };

    Place operator()(const dealii::Point<dim> &unit) const
    {
      std::array<std::array<double, n_along>, dim> along;
      for(int d = 0; d < dim; ++d)
        for(unsigned int k = 0; k < n_along; ++k)
          along[d][k] = basis[k].value(unit[d]);
      Place result;
      for(const unsigned int q : values.quadrature_point_indices())
      {
        double share = 1;
        for(unsigned int d = 0, rest = q; d < dim; ++d, rest /= n_along)
          share *= along[d][rest % n_along];
        result.point += share * values.quadrature_point(q);
        result.volume += share * values.JxW(q) / nodes.weight(q);
      }
      return result;
    }

  private:
    static constexpr unsigned int n_along = 5;

    dealii::QGaussLobatto<1> line;
    dealii::Quadrature<dim> nodes;
    std::vector<dealii::Polynomials::Polynomial<double>> basis;
    dealii::FEValues<dim> values;
  };
} // namespace meltfront::reference_fem

#endif
