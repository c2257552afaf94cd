#include <reference_fem/fitted/cell_integrals.h>

#include <deal.II/base/quadrature_lib.h>

namespace meltfront::reference_fem::fitted
{
  using Eigen::ArrayXd;
  using Eigen::MatrixXd;

  LineRule LineRule::gauss(int n)
  {
    const dealii::QGauss<1> rule(n);
    LineRule result;
    for(int q = 0; q < n; ++q)
    {
      result.points.push_back(rule.point(q)[0]);
      result.weights.push_back(rule.weight(q));
    }
    return result;
  }

  LineRule LineRule::towards_centre(int n)
  {
    LineRule result = gauss(n);
    for(int q = 0; q < n; ++q)
    {
      const double v = result.points[q];
      result.points[q] = v * v * v;
      result.weights[q] *= 3 * v * v;
    }
    return result;
  }

  namespace
  {
    /** (a x b)(point of a x point of b, function of a x function of b). */
    MatrixXd tensor(const MatrixXd &a, const MatrixXd &b)
    {
      MatrixXd result(a.rows() * b.rows(), a.cols() * b.cols());
      for(Eigen::Index i = 0; i < a.rows(); ++i)
        for(Eigen::Index j = 0; j < a.cols(); ++j)
          result.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
      return result;
    }
  } // namespace

  CellTables::CellTables(const FrontSurface &surface, const SurfaceRule &rule,
                         const LineRule &line)
    : line(line)
  {
    const LineBasis basis(surface.degree, line.points);
    const MatrixXd ones = MatrixXd::Ones(line.points.size(), 1);
    const MatrixXd weights
        = Eigen::Map<const Eigen::VectorXd>(line.weights.data(), line.weights.size());
    value = tensor(rule.value, basis.value);
    across = tensor(rule.value, basis.derivative);
    rays = tensor(rule.value, ones);
    for(const SurfaceRule::Cell &cell : rule.cells)
    {
      Along entry;
      entry.weight = tensor(cell.weight.matrix(), weights).array();
      for(int j = 0; j < surface.tangents; ++j)
      {
        entry.derivative[j] = tensor(cell.gradient[j], basis.value);
        entry.rays[j] = tensor(cell.gradient[j], ones);
      }
      cells.push_back(entry);
    }
  }

  CellIntegrals::CellIntegrals(const CellTables &tables, unsigned int surface_cell,
                               const Layer &layer, const FrontSurface &surface,
                               const CellPhysics &physics, const CellState &state)
    : tables(tables)
    , along(tables.cells[surface_cell])
    , physics(physics)
    , tangents(surface.tangents)
    , exponent(surface.exponent)
    , round(surface.round)
  {
    const Eigen::Map<const ArrayXd> zeta(tables.line.points.data(),
                                         tables.line.points.size());
    const Eigen::Index repeats = tables.value.rows() / zeta.size();
    double along_zeta = layer.fixed[1] - layer.fixed[0];
    r = (layer.fixed[0] + along_zeta * zeta).replicate(repeats, 1);
    speed = ArrayXd::Zero(r.size());
    for(int j = 0; j < tangents; ++j)
      slope[j] = ArrayXd::Zero(r.size());
    r_slope = ArrayXd::Constant(r.size(), along_zeta);
    for(std::size_t k = 0; k < layer.carried.size(); ++k)
    {
      const auto &[at_inner, at_outer] = layer.carried[k];
      const Array h = (tables.rays * state.front[k]).array();
      c_slope.push_back(at_outer - at_inner);
      c.push_back((at_inner + c_slope[k] * zeta).replicate(repeats, 1));
      r += c[k] * h;
      r_slope += c_slope[k] * h;
      speed += c[k] * (tables.rays * state.front_rate[k]).array();
      for(int j = 0; j < tangents; ++j)
        slope[j] += c[k] * (along.rays[j] * state.front[k]).array();
    }
    area = along.weight;
    for(int m = 0; m < exponent; ++m)
      area *= r;
    weight = area * r_slope;
    per_r = exponent > 0 ? ArrayXd(1 / r) : ArrayXd(ArrayXd::Zero(r.size()));

    theta_slope = (tables.across * state.temperature).array();
    source_slope = source_curvature = ArrayXd::Zero(r.size());
    excess = (tables.value * state.temperature).array();
    if(physics.source.strength != 0)
      for(Eigen::Index q = 0; q < r.size(); ++q)
      {
        excess[q] += physics.source.value(r[q]);
        source_slope[q] = physics.source.slope(r[q]);
        source_curvature[q] = physics.source.curvature(r[q]);
      }
    heat = physics.phase.latent + physics.phase.capacity * excess;
    if(physics.displacement != 0)
    {
      front = tables.rays * state.front[0];
      liquid_speed = physics.displacement * (tables.rays * state.front_rate[0]).array();
      for(int m = 0; m < exponent; ++m)
        liquid_speed *= front / r;
      speed -= liquid_speed;
    }

    conduction = weight;
    if(round)
      conduction /= r * r;
    for(int j = 0; j < tangents; ++j)
    {
      slope[j] /= r_slope;
      level_derivative[j]
          = (along.derivative[j] * state.temperature).array() - theta_slope * slope[j];
    }
  }

  CellVectors CellIntegrals::vectors() const
  {
    const double k = physics.time_rate * physics.phase.conductivity;
    Array flux = area * (theta_slope / r_slope + source_slope);
    for(int j = 0; j < tangents; ++j)
      flux -= conduction * level_derivative[j] * slope[j];
    CellVectors result;
    result.mass = tables.value.transpose() * (weight * heat).matrix();
    result.flow = tables.across.transpose() * (-k * flux - area * heat * speed).matrix();
    for(int j = 0; j < tangents; ++j)
      result.flow += along.derivative[j].transpose()
                     * (-k * conduction * level_derivative[j]).matrix();
    return result;
  }

  CellMatrices CellIntegrals::matrices() const
  {
    const double capacity = physics.phase.capacity;
    CellMatrices result;
    result.mass_temperature
        = tables.value.transpose()
          * ((weight * capacity).matrix().asDiagonal() * tables.value);
    differentiate_flow(result);
    for(std::size_t k = 0; k < c.size(); ++k)
    {
      const Array by_front
          = weight * heat * (exponent * c[k] * per_r + c_slope[k] / r_slope)
            + weight * capacity * source_slope * c[k];
      result.fronts.emplace_back();
      result.fronts[k].mass
          = tables.value.transpose() * (by_front.matrix().asDiagonal() * tables.rays);
      differentiate_flow_by_front(k, result);
    }
    return result;
  }

  void CellIntegrals::differentiate_flow(CellMatrices &result) const
  {
    const double k = physics.time_rate * physics.phase.conductivity;
    // The factors of phi', and what multiplies the tangential derivatives.
    MatrixXd by_theta
        = (-k * area / r_slope).matrix().asDiagonal() * tables.across
          + (-area * physics.phase.capacity * speed).matrix().asDiagonal() * tables.value;
    MatrixXd along_surface = MatrixXd::Zero(tables.value.cols(), tables.value.cols());
    for(int j = 0; j < tangents; ++j)
    {
      // D phi_b of the trial functions.
      const MatrixXd trial
          = along.derivative[j] - slope[j].matrix().asDiagonal() * tables.across;
      by_theta += (k * conduction * slope[j]).matrix().asDiagonal() * trial;
      along_surface += along.derivative[j].transpose()
                       * ((-k * conduction).matrix().asDiagonal() * trial);
    }
    result.flow_temperature = tables.across.transpose() * by_theta + along_surface;
  }

  void CellIntegrals::differentiate_flow_by_front(const std::size_t number,
                                                  CellMatrices &result) const
  {
    const double capacity = physics.phase.capacity;
    const double k = physics.time_rate * physics.phase.conductivity;
    const Array &c = this->c[number];
    const double c_slope = this->c_slope[number];

    const Array area_by_front = area * exponent * c * per_r;
    Array flux_by_front
        = area_by_front * (theta_slope / r_slope + source_slope)
          + area * (source_curvature * c - theta_slope * c_slope / (r_slope * r_slope));
    const Array conduction_by_front
        = conduction * ((exponent - (round ? 2 : 0)) * c * per_r + c_slope / r_slope);
    for(int j = 0; j < tangents; ++j)
      flux_by_front -= conduction_by_front * level_derivative[j] * slope[j]
                       - conduction * (level_derivative[j] - theta_slope * slope[j])
                             * slope[j] * c_slope / r_slope;
    Array across_by_front
        = -k * flux_by_front
          - (area_by_front * heat + area * capacity * source_slope * c) * speed;
    Array speed_by_rate = c;
    if(physics.displacement != 0)
    {
      if(exponent > 0)
        across_by_front
            += area * heat * liquid_speed * exponent * (1 / front - c * per_r);
      Array ratio = Array::Constant(r.size(), physics.displacement);
      for(int m = 0; m < exponent; ++m)
        ratio *= front / r;
      speed_by_rate -= ratio;
    }
    MatrixXd by_front = across_by_front.matrix().asDiagonal() * tables.rays;

    MatrixXd along_surface = MatrixXd::Zero(tables.value.cols(), tables.rays.cols());
    for(int j = 0; j < tangents; ++j)
    {
      const Array slope_by_gradient = c / r_slope;
      const Array slope_by_front = -slope[j] * c_slope / r_slope;
      by_front += (k * conduction * (level_derivative[j] - theta_slope * slope[j])
                   * slope_by_gradient)
                      .matrix()
                      .asDiagonal()
                  * along.rays[j];
      const MatrixXd along_by_front
          = (-k
             * (conduction_by_front * level_derivative[j]
                - conduction * theta_slope * slope_by_front))
                    .matrix()
                    .asDiagonal()
                * tables.rays
            + (k * conduction * theta_slope * slope_by_gradient).matrix().asDiagonal()
                  * along.rays[j];
      along_surface += along.derivative[j].transpose() * along_by_front;
    }
    CellMatrices::ByFront &sums = result.fronts[number];
    sums.flow = tables.across.transpose() * by_front + along_surface;
    sums.flow_rate
        = tables.across.transpose()
          * ((-area * heat * speed_by_rate).matrix().asDiagonal() * tables.rays);
  }

  Eigen::VectorXd CellIntegrals::source_flow(const Array &released) const
  {
    return tables.value.transpose() * (physics.time_rate * weight * released).matrix();
  }

  MatrixXd CellIntegrals::source_flow_front(const std::size_t k, const Array &released,
                                            const Array &slope) const
  {
    const Array by_front
        = weight
          * (released * (exponent * c[k] * per_r + c_slope[k] / r_slope) + slope * c[k]);
    return tables.value.transpose()
           * ((physics.time_rate * by_front).matrix().asDiagonal() * tables.rays);
  }

  double CellIntegrals::volume() const
  {
    return weight.sum();
  }

  double CellIntegrals::sensible_heat() const
  {
    return physics.phase.capacity * (weight * excess).sum();
  }
} // namespace meltfront::reference_fem::fitted
