#include <reference_fem/cut/front_speed.h>

#include <reference_fem/cut/quadrature.h>
#include <reference_fem/cut/sparse_system.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Half the width of the band that the field fills, in cells: wide enough for the
     * cells that the front may cut after a step. */
    constexpr double band_cells = 1.5;

    /** Share of isotropic smoothing in the band, against checkerboards that the
     * derivative along the normal does not see. */
    constexpr double isotropic_share = 0.01;

    std::vector<char> cells_in_band(const BackgroundMesh &mesh,
                                    const CutGeometry &geometry, const Values &level_set)
    {
      std::vector<char> result(mesh.cells.size());
      const double width = band_cells * mesh.spacing;
      for(std::size_t cell = 0; cell < result.size(); ++cell)
        result[cell]
            = geometry.location[cell] == Location::cut
              || (geometry.location[cell] != Location::outside
                  && distance_to_phase(mesh.cells[cell], level_set, Phase::solid) < width
                  && distance_to_phase(mesh.cells[cell], level_set, Phase::liquid)
                         < width);
      return result;
    }

    /** The gradients of an element's shape functions, one column each. */
    LocalMatrix gradients(const dealii::FE_Q<dim> &element, const Cell &cell,
                          const Point &unit)
    {
      LocalMatrix result(dim, element.n_dofs_per_cell());
      for(unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        for(int d = 0; d < dim; ++d)
          result(d, i) = element.shape_grad(i, unit)[d] / cell.size[d];
      return result;
    }

    void add_band_cell(const BackgroundMesh &mesh, const Cell &cell,
                       const Values &level_set, SparseSystem &system)
    {
      const long n = mesh.element.n_dofs_per_cell();
      LocalMatrix matrix = LocalMatrix::Zero(n, n);
      for(const VolumePoint &point : whole_cell(cell))
      {
        const LocalMatrix shapes = gradients(mesh.element, cell, point.unit);
        const LocalMatrix level_set_shapes
            = gradients(mesh.level_set_element, cell, point.unit);
        Eigen::Vector2d normal = Eigen::Vector2d::Zero();
        for(unsigned int i = 0; i < cell.level_set_dofs.size(); ++i)
          normal += level_set[cell.level_set_dofs[i]] * level_set_shapes.col(i);
        const double length = normal.norm();
        if(length > 0)
          normal /= length;
        const LocalVector along = shapes.transpose() * normal;
        matrix += point.weight * cell.width()
                  * (along * along.transpose()
                     + isotropic_share * shapes.transpose() * shapes);
      }
      system.add(cell.dofs, matrix);
    }

    void add_front_point(const BackgroundMesh &mesh, const Cell &cell,
                         const SurfacePoint &point, double speed, double smoothing,
                         SparseSystem &system)
    {
      const long n = mesh.element.n_dofs_per_cell();
      LocalVector values(n);
      for(unsigned int i = 0; i < n; ++i)
        values[i] = mesh.element.shape_value(i, point.unit);
      const Eigen::Vector2d tangent(-point.normal[1], point.normal[0]);
      const LocalVector along
          = gradients(mesh.element, cell, point.unit).transpose() * tangent;
      const double h = cell.width();
      system.add(cell.dofs,
                 LocalMatrix(point.weight
                             * (values * values.transpose()
                                + smoothing * h * h * along * along.transpose())));
      system.add(cell.dofs, LocalVector(point.weight * speed * values));
    }
  } // namespace

  SpeedField extend_speed(const BackgroundMesh &mesh, const CutGeometry &geometry,
                          const Values &level_set, const std::vector<double> &speed,
                          double smoothing)
  {
    const std::vector<char> in_band = cells_in_band(mesh, geometry, level_set);
    SparseSystem system(mesh, in_band);
    for(std::size_t cell = 0; cell < in_band.size(); ++cell)
      if(in_band[cell])
        add_band_cell(mesh, mesh.cells[cell], level_set, system);
    std::size_t number = 0;
    for(const CutCell &cut : geometry.cut_cells)
      for(const SurfacePoint &point : cut.front)
        add_front_point(mesh, mesh.cells[cut.cell], point, speed[number++], smoothing,
                        system);
    Values field(mesh.positions.size());
    if(number > 0 && !system.solve(field))
      throw std::runtime_error(
          "the matrix of the front's speed is not positive definite");
    SpeedField result{mesh.to_level_set_dofs(field), std::vector<char>(level_set.size()),
                      0};
    for(std::size_t cell = 0; cell < in_band.size(); ++cell)
      if(in_band[cell])
        for(const unsigned int dof : mesh.cells[cell].level_set_dofs)
        {
          result.band[dof] = 1;
          if(geometry.location[cell] == Location::cut)
            result.largest = std::max(result.largest, std::abs(result.values[dof]));
        }
    return result;
  }
} // namespace meltfront::reference_fem::cut
