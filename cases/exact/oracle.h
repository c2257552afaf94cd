#ifndef meltfront_cases_exact_oracle_h
#define meltfront_cases_exact_oracle_h

#include <cases/exact/layered_solution.h>
#include <cases/material.h>
#include <cases/scene.h>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace meltfront::cases
{
  /** What holds at one end of the oracle's domain. */
  struct OracleWall
  {
    /** Any kind but periodic. */
    BoundaryKind kind = BoundaryKind::insulated;
    /** The temperature, the heat flux into the domain (W/m^2) or the ambient temperature
     * at a time; smooth in time. Empty for an insulated wall. */
    std::function<double(double time)> value;
    /** As of Boundary. */
    double heat_transfer_coefficient = 0, emission_coefficient = 0, absolute_zero = 0;

    /** For heat_through(). */
    Boundary law() const;
  };

  /** A Stefan problem in one coordinate. */
  struct OracleProblem
  {
    Symmetry symmetry = Symmetry::planar;
    Material material;
    double inner
        = 0; ///< coordinate of the inner wall (m); 0 in a cylindrical or
             ///< spherical problem is the axis or centre: no wall is needed there
    double outer = 1; ///< coordinate of the outer wall (m)
    OracleWall inner_wall, outer_wall;
    double start_time = 0; ///< s
    double end_time = 1;   ///< s

    /** Where the state at start_time comes from, and what is known before it; if null,
     * the two members after it. */
    std::shared_ptr<const ExactSolution> start;
    std::vector<double> initial_fronts;                ///< m, ascending; none: one phase
    std::function<double(double)> initial_temperature; ///< of the coordinate

    /** The liquid (the solid) stays at the melting temperature and its walls are of no
     * effect. */
    bool liquid_at_melting = false, solid_at_melting = false;
    bool solid_at_origin = true; ///< which phase lies at the inner wall

    /** Heat removed per length by a line sink on the axis (W/m): cylindrical, inner = 0,
     * solid_at_origin. */
    double line_sink = 0;

    /** Undercooled liquid or superheated solid is meant, not an error. */
    bool metastable = false;

    /** The run ends before its end time where a wall has been beyond the melting
     * temperature for so long (s); what a new front there starts from. */
    double longest_beyond = std::numeric_limits<double>::infinity();

    /**
     * Chebyshev intervals per phase. 0: raised in each phase until its last coefficients
     * are at round-off throughout the run; where initial and wall values do not quite
     * agree, until the front no longer changes by more than 10 tolerances of the domain.
     */
    int nodes = 0;
    double tolerance = 1e-12; ///< of each time step, relative
  };

  /**
   * A solution accurate enough to be called exact where no closed form exists: each phase
   * between fronts and walls is mapped onto a fixed interval (Landau 1950), collocated at
   * Chebyshev points, and the whole is advanced by a Radau IIA method of seven stages
   * (order 13) with step control. The whole run is made on construction and kept as
   * polynomials in time, so that any later question is answered at the same accuracy.
   *
   * In a phase that lies at rest T_t = a (T_rr + m/r T_r), m = 0, 1, 2; a front, at
   * T_m, moves with rho L ds/dt = [k T_r] and the phase beyond it is displaced where the
   * densities differ (through the outer wall). Initial and wall values must be smooth and
   * agree with each other; where they do not, accuracy is algebraic only.
   */
  class SpectralOracle : public LayeredSolution
  {
  public:
    /**
     * Solve the problem.
     * @throws InputError for a problem that is incomplete or inconsistent.
     * @throws NumericalError, at its time, where a front reaches a wall or another front
     * (a phase vanishes), a phase is driven beyond the melting temperature (another front
     * would form), a value is not finite or the step cannot be made small enough.
     */
    explicit SpectralOracle(const OracleProblem &problem);
    ~SpectralOracle() override;

    std::string description() const override;
    Symmetry symmetry() const override;

    /** That of the solution it started from, else of the problem. */
    double start_time() const override;

    /** Of the problem, or where the run ended. */
    double end_time() const;

    bool solid_at_origin() const override;

    double inner() const override;
    double outer() const override;

    /** @throws InputError outside start_time() ... end_time(), as all that take a time.
     */
    std::vector<double> fronts(double time) const override;

    using ExactSolution::temperature;

    /** Coordinates beyond a wall count as the wall. */
    double temperature(double coordinate, double time) const override;

    double heat_content(double lower, double upper, double time) const override;

    /** Chebyshev intervals in use in each phase, from the inner wall on. */
    const std::vector<int> &nodes() const;

    /** Time steps taken. */
    long steps() const;

    /** An estimate of the error in space: the largest share of the two highest Chebyshev
     * coefficients over the run, relative to the range of temperature; or, where the
     * nodes were chosen by comparison, the change of the fronts at the last comparison,
     * relative to the domain. */
    double resolution_defect() const;

  private:
    class Run;
    std::unique_ptr<const Run> run;
  };
} // namespace meltfront::cases

#endif
