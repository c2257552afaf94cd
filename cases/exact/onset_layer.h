#ifndef meltfront_cases_exact_onset_layer_h
#define meltfront_cases_exact_onset_layer_h

#include <cases/exact/chebyshev.h>
#include <cases/exact/layered_solution.h>
#include <cases/exact/oracle.h>
#include <cases/material.h>

#include <Eigen/Dense>

#include <memory>
#include <vector>

namespace meltfront::cases
{
  /** What sets in at a wall. */
  enum class Onset
  {
    wall_layer, ///< the wall's law, in a phase of uniform temperature; no new phase
    jump,       ///< a new phase under a wall held beyond the melting temperature
    at_melting, ///< the same from a wall that passes the melting temperature, or from a
                ///< phase at it whose heat begins to be drawn (supplied)
    by_wall_law ///< from a wall that heat leaves (enters) by a law when it passes the
                ///< melting temperature
  };

  struct OnsetProblem
  {
    Onset onset = Onset::wall_layer;
    /** The solution as it would go on without what sets in: beyond the melting
     * temperature, or with an insulated wall where the wall sets off at the start. Known
     * until time + longest. */
    std::shared_ptr<const LayeredSolution> before;
    Material material; ///< of equal densities
    bool at_inner = true;
    OracleWall wall;
    double time = 0;    ///< of the onset (s)
    double longest = 1; ///< time after the onset that is asked for at most (s)
  };

  /**
   * The short while after something has set in at a wall, when all depends on the root of
   * the time, tau.
   *
   * A new phase of the thickness l grows from the wall into the old one, which the
   * solution before, U, and a layer make up: with y the distance from the wall,
   *
   *   T = T_m + tau^e p(y/l, tau)  in the new phase,   l = tau^q sigma(tau),
   *   T = U + tau^g v(xi, tau)     in the old one,     y = l + 2 sqrt(a) tau xi,
   *
   * where p, v and sigma are regular in tau. With (q, e, g) = (1, 0, 0) this is Neumann's
   * start from a jump, with (2, 2, 2) one from a temperature that passes the melting
   * point, with (3, 3, 2) one under a law of heat, where the old phase's flux is the
   * wall's at first. Polynomials in tau through points at which the heat equation in both
   * phases, the wall's law and the Stefan condition hold (collocation in both directions;
   * a singular point of the first kind at tau = 0, which is none of the points) are found
   * by Newton's method. They are used as long as their last coefficients are at round-off
   * and the layer stays away from what lies beyond: up to end_time().
   */
  class OnsetLayer : public LayeredSolution
  {
  public:
    /** @throws NumericalError where no time is short enough for the polynomials. */
    explicit OnsetLayer(const OnsetProblem &problem);

    std::string description() const override;
    Symmetry symmetry() const override;
    double start_time() const override;
    double end_time() const;
    bool solid_at_origin() const override;
    double inner() const override;
    double outer() const override;
    std::vector<double> fronts(double time) const override;

    using ExactSolution::temperature;
    double temperature(double coordinate, double time) const override;

    double heat_content(double lower, double upper, double time) const override;

  private:
    /** What depends on the time at one point of collocation. */
    struct Instant
    {
      double tau, time;
      double reach;               ///< of the polynomial for U (m)
      Eigen::VectorXd old_excess; ///< U - T_m at its nodes
      double given;               ///< value of the wall
    };

    /** Unknowns of an instant, in this order: v, p, sigma. */
    struct Unknowns
    {
      Eigen::VectorXd v, p; ///< with the zeros at the far end and at the front
      double sigma;
    };

    bool grows() const
    {
      return problem.onset != Onset::wall_layer;
    }

    int size() const;
    Unknowns unpack(const Eigen::VectorXd &values) const;
    Instant instant(double tau) const;
    Eigen::VectorXd first_guess(const Instant &last) const;
    double range_of_wall_layer(const Instant &last) const;

    /** Of the equations at an instant; slopes are tau d/dtau of the values. */
    Eigen::VectorXd residual(const Instant &at, const Eigen::VectorXd &values,
                             const Eigen::VectorXd &slopes) const;
    void new_phase_residual(const Instant &at, const Unknowns &u, const Unknowns &slope,
                            Eigen::VectorXd &result) const;

    double longest_tau() const;

    /** Find the polynomials up to a tau; false where they do not resolve it. */
    bool solve(double last_tau);
    bool newton(const std::vector<Instant> &instants);

    /** What the unknowns of a point count for, of what they do at the last one. */
    Eigen::VectorXd weights_at(int point) const;

    /** @param range  of the temperature (K) */
    bool resolved(double range) const;

    /** Of the time, 0 before the onset. */
    double root_of_time(double time) const;
    Eigen::VectorXd at(double tau) const;
    double layer_excess(const Unknowns &u, double tau, double thickness,
                        double distance) const;

    /** Where the layer's erfc and its integrals are below 1e-16 of their start, in xi. */
    static constexpr double last_xi = 6;

    OnsetProblem problem;
    PhaseProperties old_phase, new_phase;
    double sign;        ///< of freezing: 1, of melting: -1
    double wall, along; ///< coordinate of the wall, direction from it into the domain
    int exponent;       ///< of the symmetry
    int q = 1, e = 0, g = 0;
    spectral::ChebyshevBasis layer_basis, phase_basis, before_basis;
    Eigen::VectorXd points;          ///< of collocation, in units of last_tau
    Eigen::MatrixXd differentiation; ///< among them
    double last_tau = 0;
    Eigen::VectorXd scale;    ///< of the unknowns of an instant
    Eigen::MatrixXd solution; ///< a column for each point
  };
} // namespace meltfront::cases

#endif
