#ifndef meltfront_reference_fem_enthalpy_cell_rules_h
#define meltfront_reference_fem_enthalpy_cell_rules_h

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem
{
  /** Linear elements on cells of one kind: shape functions, mapping, quadrature. */
  template <int dim>
  struct CellRules
  {
    /** @param simplices triangles and tetrahedra, else lines, quadrilaterals, hexahedra
     * @param cartesian integrals are taken at the vertices
     * @param curved cells follow the curves of their manifold */
    CellRules(bool simplices, bool cartesian, bool curved);

    unsigned int corners() const
    {
      return element->n_dofs_per_cell();
    }

    /** Whether a corner's shape function is other than zero on a face. deal.II 9.4 says
     * so of all of a simplex. */
    bool supports_on_face(unsigned int corner, unsigned int face) const;

    /** For each point of a rule the corner whose shape function is the largest there. */
    std::vector<unsigned int> nearest_corners(const dealii::Quadrature<dim> &rule) const;

    bool simplices;
    std::unique_ptr<dealii::FiniteElement<dim>> element;
    std::unique_ptr<dealii::Mapping<dim>> mapping;
    dealii::Quadrature<dim> cell;
    dealii::Quadrature<dim - 1> face;
    /** Composite rules: where a function is smooth, and where it may jump. Each point is
     * nearer to one corner than to the others. */
    dealii::Quadrature<dim> smooth, jumps;

  private:
    static dealii::Quadrature<dim> collapsed(const dealii::Quadrature<dim> &of_cube);
  };

  template <int dim>
  CellRules<dim>::CellRules(bool simplices, bool cartesian, bool curved)
    : simplices(simplices)
  {
    const dealii::QIterated<dim> few(dealii::QGauss<1>(2), 2),
        many(dealii::QMidpoint<1>(), 8);
    if constexpr(dim > 1)
      if(simplices)
      {
        element = std::make_unique<dealii::FE_SimplexP<dim>>(1);
        mapping = std::make_unique<dealii::MappingFE<dim>>(*element);
        cell = dealii::QGaussSimplex<dim>(2);
        face = dealii::QGaussSimplex<dim - 1>(2);
        smooth = collapsed(few);
        jumps = collapsed(many);
        return;
      }
    element = std::make_unique<dealii::FE_Q<dim>>(1);
    mapping = std::make_unique<dealii::MappingQ<dim>>(curved ? 4 : 1);
    if(cartesian)
      cell = dealii::QTrapezoid<dim>();
    else
      cell = dealii::QGauss<dim>(3);
    face = dealii::QGauss<dim - 1>(3);
    smooth = few;
    jumps = many;
  }

  /** The rule of a cube on the simplex that it collapses to (Duffy 1982). */
  template <int dim>
  dealii::Quadrature<dim>
  CellRules<dim>::collapsed(const dealii::Quadrature<dim> &of_cube)
  {
    std::vector<dealii::Point<dim>> points = of_cube.get_points();
    std::vector<double> weights = of_cube.get_weights();
    for(std::size_t q = 0; q < points.size(); ++q)
    {
      double left = 1;
      for(int d = 0; d < dim; ++d)
      {
        points[q][d] *= left;
        weights[q] *= left;
        left -= points[q][d];
      }
    }
    return {points, weights};
  }

  template <int dim>
  bool CellRules<dim>::supports_on_face(unsigned int corner, unsigned int face) const
  {
    if(!simplices)
      return element->has_support_on_face(corner, face);
    const auto reference_cell = element->reference_cell();
    for(unsigned int v = 0; v < dim; ++v)
      if(reference_cell.face_to_cell_vertices(face, v, 1) == corner)
        return true;
    return false;
  }

  template <int dim>
  std::vector<unsigned int>
  CellRules<dim>::nearest_corners(const dealii::Quadrature<dim> &rule) const
  {
    std::vector<unsigned int> result;
    for(const dealii::Point<dim> &unit : rule.get_points())
    {
      unsigned int nearest = 0;
      for(unsigned int a = 1; a < corners(); ++a)
        if(element->shape_value(a, unit) > element->shape_value(nearest, unit))
          nearest = a;
      result.push_back(nearest);
    }
    return result;
  }
} // namespace meltfront::reference_fem

#endif
