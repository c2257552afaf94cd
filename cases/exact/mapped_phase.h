#ifndef meltfront_cases_exact_mapped_phase_h
#define meltfront_cases_exact_mapped_phase_h

#include <cases/exact/chebyshev.h>
#include <cases/exact/oracle.h>

#include <Eigen/Dense>

namespace meltfront::cases::spectral
{
  /**
   * One phase on its fixed interval, with the front at one end, where T = T_m, and a wall
   * or the axis at the other.
   *
   * Values are excesses T - T_m. Differentiation matrices have entries as large as the
   * fourth power of the number of nodes towards the ends, where values differ little; the
   * derivatives are therefore taken of differences from the nearer end, and the value at
   * a wall under a flux is found as a difference from its neighbour. In the half next to
   * a wall this keeps the round-off of a derivative two powers smaller.
   */
  struct MappedPhase
  {
    /** Values at all nodes, as differences from either end. */
    struct Nodal
    {
      Eigen::VectorXd from_front; ///< the excess itself
      Eigen::VectorXd from_wall;  ///< less the value at the wall or axis
    };

    /** In the mapped coordinate. */
    struct Derivatives
    {
      Eigen::VectorXd first, second;
    };

    int unknowns() const;

    /** First node that is an unknown: all are but the front and a wall. */
    int first_unknown() const;

    /**
     * Complete the unknowns by the front's and the wall's value.
     * @param length  of the phase now (m)
     */
    Nodal complete(double time, double length,
                   const Eigen::Ref<const Eigen::VectorXd> &unknown_values) const;

    Derivatives derivatives(const Nodal &nodal) const;

    PhaseProperties material;
    bool solid;
    OracleWall wall;
    double melting_temperature;
    bool wall_is_first; ///< node 0 is the wall and the last one the front, or vice versa
    bool axis;   ///< the axis or centre in the place of a wall: its node is an unknown
    bool solved; ///< false: at the melting temperature throughout, no unknowns
    ChebyshevBasis basis;

  private:
    void complete_flux_wall(double time, double length, Nodal &nodal) const;
  };
} // namespace meltfront::cases::spectral

#endif
