#ifndef meltfront_cases_exact_mapped_phase_h
#define meltfront_cases_exact_mapped_phase_h

#include <cases/exact/chebyshev.h>
#include <cases/exact/oracle.h>
#include <cases/scene.h>

#include <Eigen/Dense>

#include <functional>

namespace meltfront::cases::spectral
{
  /** What bounds a phase at one end. */
  struct PhaseEnd
  {
    enum Kind
    {
      front, ///< at the melting temperature
      wall,
      axis ///< axis or centre: what lies there is an unknown
    };

    /** A wall, with its law ready for heat_through(). */
    static PhaseEnd at_wall(const OracleWall &wall);

    Kind kind = front;
    std::function<double(double time)> value{}; ///< of a wall, as in OracleWall
    Boundary law{};                             ///< of a wall
  };

  /**
   * One phase on its fixed interval, between fronts, walls or the axis.
   *
   * Values are excesses T - T_m. Differentiation matrices have entries as large as the
   * fourth power of the number of nodes towards the ends, where values differ little; the
   * derivatives are therefore taken of differences from the nearer end, and the value at
   * a wall through which heat flows by a law is found as a difference from its neighbour.
   * In the half next to a wall this keeps the round-off of a derivative two powers
   * smaller.
   */
  struct MappedPhase
  {
    /** Values at all nodes, and as differences from either end. */
    struct Nodal
    {
      Eigen::VectorXd excess;
      Eigen::VectorXd from_low, from_high; ///< less the value at the first, last node
    };

    /** In the mapped coordinate. */
    struct Derivatives
    {
      Eigen::VectorXd first, second;
    };

    int unknowns() const;

    /** First node that is an unknown: all are but fronts and walls. */
    int first_unknown() const;

    /**
     * Complete the unknowns by the values at the ends.
     * @param length  dr/dx at the ends now (m): the thickness, or half the radius where
     * the axis is one end
     */
    Nodal complete(double time, double length,
                   const Eigen::Ref<const Eigen::VectorXd> &unknown_values) const;

    Derivatives derivatives(const Nodal &nodal) const;

    PhaseProperties material;
    bool solid;
    double melting_temperature;
    PhaseEnd low, high; ///< at x = 0 and x = 1
    bool solved;        ///< false: at the melting temperature throughout, no unknowns
    ChebyshevBasis basis;

  private:
    /** The value at a wall from the heat that flows through it. */
    void complete_wall(double time, double length, bool at_low, Nodal &nodal) const;
  };
} // namespace meltfront::cases::spectral

#endif
