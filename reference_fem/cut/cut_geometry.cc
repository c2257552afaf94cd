#include <reference_fem/cut/cut_geometry.h>

#include <cases/error.h>
#include <reference_fem/cut/quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    double value(const BackgroundMesh &mesh, const Cell &cell, const Values &level_set,
                 const Point &unit)
    {
      double sum = 0;
      for(unsigned int i = 0; i < cell.level_set_dofs.size(); ++i)
        sum += level_set[cell.level_set_dofs[i]]
               * mesh.level_set_element.shape_value(i, unit);
      return sum;
    }

    /** Zeros between 0 and 1 of the parabola through values at 0, 1/2 and 1. */
    std::vector<double> zeros(double first, double middle, double last)
    {
      const double a = 2 * (first - 2 * middle + last), b = last - first - a, c = first;
      const double discriminant = b * b - 4 * a * c;
      if(discriminant < 0)
        return {};
      const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
      std::vector<double> result;
      for(const double root : {q / a, c / q})
        if(root > 0 && root < 1)
          result.push_back(root);
      std::sort(result.begin(), result.end());
      return result;
    }

    Point on_face(const WallFace &face, double tangential)
    {
      Point unit;
      unit[face.direction] = face.upper ? 1 : 0;
      unit[1 - face.direction] = tangential;
      return unit;
    }
  } // namespace

  CutGeometry::CutGeometry(const BackgroundMesh &mesh, const Values &level_set)
  {
    CutIntegrator integrator(mesh, level_set);
    for(unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
    {
      const CutIntegrator::Side side = integrator.sides()[cell];
      if(mesh.place[cell] == Place::outside)
        location.push_back(Location::outside);
      else if(side != CutIntegrator::Side::cut)
        location.push_back(side == CutIntegrator::Side::inside ? Location::solid
                                                               : Location::liquid);
      else
      {
        if(mesh.place[cell] == Place::on_rim)
          throw cases::Refusal("the front has reached the rim of the domain, which "
                               "fem-cut does not simulate");
        CutQuadrature quadrature = integrator.integrate(cell);
        location.push_back(Location::cut);
        cut_cells.push_back(
            {cell,
             {std::move(quadrature.inside), std::move(quadrature.outside)},
             std::move(quadrature.surface)});
      }
    }
    integrate_walls(mesh, level_set);
    measure(mesh);
  }

  void CutGeometry::integrate_walls(const BackgroundMesh &mesh, const Values &level_set)
  {
    const dealii::QGauss<1> gauss(3);
    for(const WallFace &face : mesh.wall_faces)
    {
      const Cell &cell = mesh.cells[face.cell];
      const auto value_at
          = [&](double t) { return value(mesh, cell, level_set, on_face(face, t)); };
      std::vector<double> ends{0};
      if(location[face.cell] == Location::cut)
        for(const double zero : zeros(value_at(0), value_at(0.5), value_at(1)))
          ends.push_back(zero);
      ends.push_back(1);
      Gradient normal;
      normal[face.direction] = face.upper ? 1 : -1;
      for(std::size_t piece = 0; piece + 1 < ends.size(); ++piece)
      {
        const double start = ends[piece], length = ends[piece + 1] - start;
        const Phase phase
            = value_at(start + length / 2) < 0 ? Phase::solid : Phase::liquid;
        for(unsigned int q = 0; q < gauss.size(); ++q)
        {
          const Point unit = on_face(face, start + length * gauss.point(q)[0]);
          const double weight = gauss.weight(q) * length * cell.size[1 - face.direction];
          walls.push_back(
              {face.cell, {unit, weight, normal}, cell.real(unit), face.side, phase});
        }
      }
    }
    for(const CurvedBoundaryCell &rim : mesh.curved_boundary_cells)
      for(const SurfacePoint &point : rim.rim)
        walls.push_back(
            {rim.cell, point, mesh.cells[rim.cell].real(point.unit), rim.side,
             is(location[rim.cell], Phase::solid) ? Phase::solid : Phase::liquid});
  }

  void CutGeometry::measure(const BackgroundMesh &mesh)
  {
    for(const Phase phase : phases)
    {
      double &area = areas[index(phase)];
      for(unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
        if(is(location[cell], phase) && mesh.place[cell] == Place::inside)
          area += mesh.cells[cell].volume();
      visit_parts(mesh, phase,
                  [&area](unsigned int, const std::vector<VolumePoint> &points)
                  {
                    for(const VolumePoint &point : points)
                      area += point.weight;
                  });
    }
  }
} // namespace meltfront::reference_fem::cut
