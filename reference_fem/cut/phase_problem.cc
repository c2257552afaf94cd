#include <reference_fem/cut/phase_problem.h>

#include <reference_fem/cut/quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace meltfront::reference_fem::cut
{
  namespace
  {
    /** Of the ghost penalty's weight: a full share, which the shortest steps would make
     * the whole, stiffens the elements at the front more than it steadies them. */
    constexpr double mass_share = 0.1;

    LocalVector shape_values(const dealii::FE_Q<dim> &element, const Point &unit)
    {
      LocalVector result(element.n_dofs_per_cell());
      for(unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        result[i] = element.shape_value(i, unit);
      return result;
    }

    /** One row per direction. */
    LocalMatrix shape_gradients(const dealii::FE_Q<dim> &element, const Cell &cell,
                                const Point &unit)
    {
      LocalMatrix result(dim, element.n_dofs_per_cell());
      for(unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
      {
        const Gradient gradient = element.shape_grad(i, unit);
        for(int d = 0; d < dim; ++d)
          result(d, i) = gradient[d] / cell.size[d];
      }
      return result;
    }

    /** Mass and stiffness of a cell, unit coefficients. */
    struct CellMatrices
    {
      LocalMatrix mass, stiffness;
    };

    CellMatrices cell_matrices(const dealii::FE_Q<dim> &element, const Cell &cell,
                               const std::vector<VolumePoint> &points)
    {
      const long n = element.n_dofs_per_cell();
      CellMatrices result{LocalMatrix::Zero(n, n), LocalMatrix::Zero(n, n)};
      for(const VolumePoint &point : points)
      {
        const LocalVector values = shape_values(element, point.unit);
        const LocalMatrix gradients = shape_gradients(element, cell, point.unit);
        result.mass += point.weight * values * values.transpose();
        result.stiffness += point.weight * gradients.transpose() * gradients;
      }
      return result;
    }

    LocalVector gather(const Values &field, const std::vector<unsigned int> &dofs)
    {
      LocalVector result(dofs.size());
      for(std::size_t i = 0; i < dofs.size(); ++i)
        result[static_cast<long>(i)] = field[dofs[i]];
      return result;
    }

    /** Derivatives of a cell's shape functions in one direction of the axes. */
    LocalVector axis_derivatives(const dealii::FE_Q<dim> &element, const Cell &cell,
                                 const Point &unit, int direction, int order)
    {
      LocalVector result(element.n_dofs_per_cell());
      for(unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        result[i] = order == 1
                        ? element.shape_grad(i, unit)[direction] / cell.size[direction]
                        : element.shape_grad_grad(i, unit)[direction][direction]
                              / (cell.size[direction] * cell.size[direction]);
      return result;
    }
  } // namespace

  double field_value(const BackgroundMesh &mesh, const Cell &cell, const Values &field,
                     const Point &unit)
  {
    double sum = 0;
    for(unsigned int i = 0; i < cell.dofs.size(); ++i)
      sum += field[cell.dofs[i]] * mesh.element.shape_value(i, unit);
    return sum;
  }

  PhaseProblem::PhaseProblem(const BackgroundMesh &mesh, const CutGeometry &geometry,
                             const Values &level_set, Phase phase,
                             const Stabilisation &stabilisation)
    : mesh(mesh)
    , geometry(geometry)
    , phase(phase)
    , stabilisation(stabilisation)
    , active(mesh.cells.size())
  {
    const double band = stabilisation.extension * mesh.spacing;
    for(std::size_t cell = 0; cell < active.size(); ++cell)
      active[cell] = geometry.location[cell] != Location::outside
                     && (CutGeometry::is(geometry.location[cell], phase)
                         || geometry.location[cell] == Location::cut
                         || distance_to_phase(mesh.cells[cell], level_set, phase) < band);
  }

  Values PhaseProblem::solve(const PhaseEquation &equation)
  {
    SparseSystem system(mesh, active);
    add_whole_cells(equation, system);
    add_parts(equation, system);
    add_ghost_penalty(equation, system);
    add_front(equation, system);
    if(equation.wall)
      add_walls(equation, system);
    Values solution(mesh.positions.size());
    for(std::size_t dof = 0; dof < solution.size(); ++dof)
      if(!system.contains(static_cast<unsigned int>(dof)))
        solution[dof] = equation.front_value(mesh.positions[dof]);
    if(!system.solve(solution))
      throw std::runtime_error("the matrix of a phase is not positive definite");
    unknowns = system.unknowns();
    entries = system.entries();
    return solution;
  }

  void PhaseProblem::add_whole_cells(const PhaseEquation &equation,
                                     SparseSystem &system) const
  {
    std::map<double, CellMatrices> by_size;
    for(unsigned int number = 0; number < mesh.cells.size(); ++number)
    {
      if(!CutGeometry::is(geometry.location[number], phase)
         || mesh.place[number] != Place::inside)
        continue;
      const Cell &cell = mesh.cells[number];
      if(equation.source)
      {
        add_points(equation, number, whole_cell(cell), system);
        continue;
      }
      auto found = by_size.find(cell.size[0]);
      if(found == by_size.end())
        found = by_size
                    .emplace(cell.size[0],
                             cell_matrices(mesh.element, cell, whole_cell(cell)))
                    .first;
      const auto &[mass, stiffness] = found->second;
      system.add(cell.dofs,
                 LocalMatrix(equation.mass * mass + equation.conductivity * stiffness));
      if(!equation.load.empty())
        system.add(cell.dofs, LocalVector(mass * gather(equation.load, cell.dofs)));
    }
  }

  void PhaseProblem::add_points(const PhaseEquation &equation, unsigned int number,
                                const std::vector<VolumePoint> &points,
                                SparseSystem &system) const
  {
    const Cell &cell = mesh.cells[number];
    const auto [mass, stiffness] = cell_matrices(mesh.element, cell, points);
    system.add(cell.dofs,
               LocalMatrix(equation.mass * mass + equation.conductivity * stiffness));
    LocalVector load = LocalVector::Zero(mass.rows());
    if(!equation.load.empty())
      load = mass * gather(equation.load, cell.dofs);
    if(equation.source)
      for(const VolumePoint &point : points)
        load += point.weight * equation.source(cell.real(point.unit))
                * shape_values(mesh.element, point.unit);
    if(equation.divergence_source)
      for(const VolumePoint &point : points)
      {
        const Gradient flux = equation.divergence_source(cell, point.unit);
        load += point.weight * shape_gradients(mesh.element, cell, point.unit).transpose()
                * Eigen::Vector2d(flux[0], flux[1]);
      }
    system.add(cell.dofs, load);
  }

  void PhaseProblem::add_parts(const PhaseEquation &equation, SparseSystem &system) const
  {
    geometry.visit_parts(mesh, phase,
                         [&](unsigned int cell, const std::vector<VolumePoint> &points)
                         { add_points(equation, cell, points, system); });
  }

  PhaseProblem::TraceValues PhaseProblem::trace(const Cell &cell,
                                                const SurfacePoint &point) const
  {
    const LocalMatrix gradients = shape_gradients(mesh.element, cell, point.unit);
    return {shape_values(mesh.element, point.unit),
            gradients.row(0).transpose() * point.normal[0]
                + gradients.row(1).transpose() * point.normal[1]};
  }

  double PhaseProblem::penalty(const PhaseEquation &equation, const Cell &cell) const
  {
    const double degree = mesh.element.degree;
    return stabilisation.penalty * degree * degree * equation.conductivity / cell.width();
  }

  /** Nitsche's terms for T = value; the point's normal leaves the phase. */
  void PhaseProblem::add_condition(const PhaseEquation &equation, const Cell &cell,
                                   const SurfacePoint &point, double value,
                                   SparseSystem &system) const
  {
    const auto [shape, derivative] = trace(cell, point);
    const LocalVector flux
        = equation.conductivity * derivative - penalty(equation, cell) * shape;
    system.add(cell.dofs,
               LocalMatrix(-point.weight
                           * (shape * flux.transpose()
                              + equation.conductivity * derivative * shape.transpose())));
    system.add(cell.dofs, LocalVector(-point.weight * value * flux));
  }

  void PhaseProblem::add_front(const PhaseEquation &equation, SparseSystem &system) const
  {
    for(const CutCell &cut : geometry.cut_cells)
      for(SurfacePoint point : cut.front)
      {
        const Cell &cell = mesh.cells[cut.cell];
        if(phase == Phase::liquid)
          point.normal *= -1;
        add_condition(equation, cell, point, equation.front_value(cell.real(point.unit)),
                      system);
        if(equation.divergence_source)
          system.add(
              cell.dofs,
              LocalVector(-point.weight
                          * (equation.divergence_source(cell, point.unit) * point.normal)
                          * shape_values(mesh.element, point.unit)));
      }
  }

  void PhaseProblem::add_walls(const PhaseEquation &equation, SparseSystem &system) const
  {
    for(const WallPoint &wall : geometry.walls)
    {
      if(wall.phase != phase)
        continue;
      const Cell &cell = mesh.cells[wall.cell];
      const WallCondition condition = equation.wall(wall);
      if(condition.fixes_temperature)
        add_condition(equation, cell, wall.point, condition.value, system);
      else if(condition.value != 0 || condition.slope != 0)
      {
        const LocalVector shape = shape_values(mesh.element, wall.point.unit);
        system.add(cell.dofs, LocalVector(wall.point.weight * condition.value * shape));
        if(condition.slope != 0)
          system.add(cell.dofs, LocalMatrix(-wall.point.weight * condition.slope * shape
                                            * shape.transpose()));
      }
    }
  }

  void PhaseProblem::add_ghost_penalty(const PhaseEquation &equation,
                                       SparseSystem &system) const
  {
    const int degree = static_cast<int>(mesh.element.degree);
    const dealii::QGauss<1> gauss(mesh.element.degree + 1);
    const auto whole = [&](unsigned int cell)
    {
      return CutGeometry::is(geometry.location[cell], phase)
             && mesh.place[cell] == Place::inside;
    };
    for(const InnerFace &face : mesh.inner_faces)
    {
      if(!active[face.fine] || !active[face.coarse]
         || (whole(face.fine) && whole(face.coarse)))
        continue;
      const Cell &fine = mesh.cells[face.fine], &coarse = mesh.cells[face.coarse];
      const double h = fine.size[face.direction];
      const double coefficient
          = stabilisation.ghost
            * (equation.conductivity + mass_share * equation.mass * h * h);
      std::vector<unsigned int> dofs = fine.dofs;
      dofs.insert(dofs.end(), coarse.dofs.begin(), coarse.dofs.end());
      const long n = static_cast<long>(dofs.size());
      LocalMatrix matrix = LocalMatrix::Zero(n, n);
      for(unsigned int q = 0; q < gauss.size(); ++q)
      {
        Point unit;
        unit[face.direction] = face.upper ? 1 : 0;
        unit[1 - face.direction] = gauss.point(q)[0];
        const Point other = coarse.unit(fine.real(unit));
        const double weight = gauss.weight(q) * fine.size[1 - face.direction];
        for(int order = 1; order <= degree; ++order)
        {
          LocalVector jump(n);
          jump << axis_derivatives(mesh.element, fine, unit, face.direction, order),
              -axis_derivatives(mesh.element, coarse, other, face.direction, order);
          matrix += weight * coefficient * std::pow(h, 2 * order - 1) * jump
                    * jump.transpose();
        }
      }
      system.add(dofs, matrix);
    }
  }

  std::vector<double> PhaseProblem::front_flux(const PhaseEquation &equation,
                                               const Values &solution) const
  {
    std::vector<double> result;
    for(const CutCell &cut : geometry.cut_cells)
    {
      const Cell &cell = mesh.cells[cut.cell];
      const LocalVector values = gather(solution, cell.dofs);
      for(SurfacePoint point : cut.front)
      {
        if(phase == Phase::liquid)
          point.normal *= -1;
        const auto [shape, derivative] = trace(cell, point);
        result.push_back(
            equation.conductivity * derivative.dot(values)
            - penalty(equation, cell)
                  * (shape.dot(values) - equation.front_value(cell.real(point.unit))));
      }
    }
    return result;
  }

  double PhaseProblem::wall_heat(const PhaseEquation &equation,
                                 const Values &solution) const
  {
    double sum = 0;
    for(const WallPoint &wall : geometry.walls)
    {
      if(wall.phase != phase)
        continue;
      const Cell &cell = mesh.cells[wall.cell];
      const WallCondition condition = equation.wall(wall);
      double flux = condition.value;
      const LocalVector values = gather(solution, cell.dofs);
      if(condition.slope != 0)
        flux += condition.slope * shape_values(mesh.element, wall.point.unit).dot(values);
      if(condition.fixes_temperature)
      {
        const auto [shape, derivative] = trace(cell, wall.point);
        flux = equation.conductivity * derivative.dot(values)
               - penalty(equation, cell) * (shape.dot(values) - condition.value);
      }
      sum += wall.point.weight * flux;
    }
    return sum;
  }
} // namespace meltfront::reference_fem::cut
