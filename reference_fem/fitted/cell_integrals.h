#ifndef meltfront_reference_fem_fitted_cell_integrals_h
#define meltfront_reference_fem_fitted_cell_integrals_h

#include <reference_fem/fitted/physics.h>
#include <reference_fem/fitted/ray_mesh.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /** Quadrature points of [0, 1] with their weights. */
  struct LineRule
  {
    std::vector<double> points, weights;

    static LineRule gauss(int points);

    /** zeta = v^3 with Gauss points v: exact to round-off for r ln r times polynomials.
     */
    static LineRule towards_centre(int points);
  };

  /** Shape functions at the quadrature points of the cells; point = surface point x
   * points across, function = ray of the cell x node across. */
  struct CellTables
  {
    CellTables(const FrontSurface &surface, const SurfaceRule &rule,
               const LineRule &line);

    unsigned int n_points() const
    {
      return static_cast<unsigned int>(value.rows());
    }

    LineRule line;
    Eigen::MatrixXd value;  ///< phi
    Eigen::MatrixXd across; ///< d phi/d zeta
    Eigen::MatrixXd rays;   ///< psi, by point and ray of the cell
    struct Along
    {
      Eigen::ArrayXd weight;                     ///< of the surface at r = 1 x line
      std::array<Eigen::MatrixXd, 2> derivative; ///< of phi along the tangents
      std::array<Eigen::MatrixXd, 2> rays;       ///< of psi along the tangents
    };
    std::vector<Along> cells; ///< of the surface
  };

  /** The state of one cell: its share of the unknowns and of their rates. */
  struct CellState
  {
    Eigen::VectorXd temperature; ///< theta = T - T_m - S by node
    /** h (m) and dh/dclock by ray, of each front that its interval ends at. */
    std::vector<Eigen::VectorXd> front, front_rate;
  };

  /** What holds in a cell. */
  struct CellPhysics
  {
    Phase phase;
    SourceField source;
    double displacement = 0; ///< of the liquid, of the front's speed
    double time_rate = 1;    ///< dt/dclock
  };

  /** Integrals of one cell, by node. */
  struct CellVectors
  {
    Eigen::VectorXd mass, flow;
  };

  /** Derivatives of the integrals, by node and by node (theta) or ray (h, its rate). */
  struct CellMatrices
  {
    struct ByFront
    {
      Eigen::MatrixXd mass, flow, flow_rate;
    };

    Eigen::MatrixXd mass_temperature, flow_temperature;
    std::vector<ByFront> fronts; ///< as in CellState
  };

  /**
   * The integrals of a cell whose points lie at r = a + sum c h(xi) on their rays, the
   * sum over the fronts that its interval ends at.
   *
   * With r' = dr/dzeta, the area g = mu r^m, the slope p = sum grad h c/r' of the levels
   * and D phi = grad phi - phi' p the derivative along the surface at fixed r,
   *
   *   M = int phi e g r',
   *   F = - int phi' e g (sum c dh/dclock - u)
   *       - dt/dclock int k [ phi' g T_r + D phi . D T g r'/r^2 ]
   *
   * (no division by r^2 for rays that are parallel), with T_r = theta'/r' + dS/dr and
   * u = displacement x dh/dclock (h/r)^m the speed of the liquid beyond the only front.
   */
  class CellIntegrals
  {
  public:
    /** The arguments must outlive the object. */
    CellIntegrals(const CellTables &tables, unsigned int surface_cell, const Layer &layer,
                  const FrontSurface &surface, const CellPhysics &physics,
                  const CellState &state);

    CellVectors vectors() const;
    CellMatrices matrices() const;

    /** dt/dclock int q phi of heat released throughout, by node; @p released is q at the
     * points (W/m^3). */
    Eigen::VectorXd source_flow(const Eigen::ArrayXd &released) const;

    /** Its derivative by node and ray, with respect to a front as in CellState. @param
     * slope dq/dr at the points */
    Eigen::MatrixXd source_flow_front(std::size_t k, const Eigen::ArrayXd &released,
                                      const Eigen::ArrayXd &slope) const;

    /** Shares of the cell in the volume, and in the heat above the melting temperature.
     */
    double volume() const;
    double sensible_heat() const;

    Eigen::ArrayXd r;      ///< coordinate of the points on their rays (m)
    Eigen::ArrayXd weight; ///< g r': volumes that the points stand for
    Eigen::ArrayXd excess; ///< T - T_m at the points (K)

  private:
    using Array = Eigen::ArrayXd;

    void differentiate_flow(CellMatrices &result) const;
    void differentiate_flow_by_front(std::size_t k, CellMatrices &result) const;

    const CellTables &tables;
    const CellTables::Along &along;
    const CellPhysics &physics;
    int tangents, exponent;
    bool round;
    std::vector<Array> c;                  ///< dr/dh by front
    std::vector<double> c_slope;           ///< dc/dzeta by front
    Array r_slope;                         ///< r'
    Array per_r;                           ///< 1/r, 0 where areas do not depend on r
    Array area;                            ///< g x quadrature weight
    Array theta_slope;                     ///< theta'
    Array source_slope, source_curvature;  ///< dS/dr and d^2S/dr^2
    Array conduction;                      ///< g r'/r^2
    Array heat;                            ///< e (J/m^3)
    Array speed, liquid_speed;             ///< sum c dh/dclock - u, and u
    Array front;                           ///< h of the only front, beside moving liquid
    std::array<Array, 2> slope;            ///< p
    std::array<Array, 2> level_derivative; ///< D theta
  };
} // namespace meltfront::reference_fem::fitted

#endif
