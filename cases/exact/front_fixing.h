#ifndef meltfront_cases_exact_front_fixing_h
#define meltfront_cases_exact_front_fixing_h

#include <cases/exact/mapped_phase.h>
#include <cases/exact/oracle.h>

#include <Eigen/Dense>

namespace meltfront::cases::spectral
{
  /**
   * The Stefan problem in space: each phase mapped onto [0, 1] and collocated.
   *
   * The state holds the nodal excesses T - T_m of the phase at the inner wall, those of
   * the phase beyond the front, and the front. Nodes on the front (T = T_m) and on walls
   * (given by the condition there) are left out. A phase that holds the axis or the
   * centre is mapped by x = (r/s)^2, in which it is smooth:
   *
   *   T_t = a (4 x T_xx + 2 (1 + m) T_x)/s^2 + 2 x s'/s T_x;
   *
   * other phases linearly, with the nodes of the outer one drawn towards the front where
   * its initial profile is steep there. With a line sink its T excludes Q/(2 pi k)
   * ln(r/s), for which a uniform source Q/(2 pi k) s'/s stands in.
   */
  class FrontFixing
  {
  public:
    /** Temperatures at a time, ready to be evaluated anywhere. */
    struct Profile
    {
      double time;
      double front;
      Eigen::VectorXd near, far; ///< excesses at all nodes, without the sink's logarithm
    };

    FrontFixing(const OracleProblem &problem, int near_intervals, int far_intervals);

    Eigen::VectorXd initial_state() const;

    void rate(double time, const Eigen::VectorXd &state, Eigen::VectorXd &rate) const;

    Eigen::VectorXd scale(const Eigen::VectorXd &state) const;

    /** The front lies inside the domain. */
    bool admissible(const Eigen::VectorXd &state) const;

    /** @throws NumericalError where the front is at a wall, a phase is beyond the melting
     * temperature (unless metastable), or a value is not finite. */
    void check(long step, double time, const Eigen::VectorXd &state) const;

    /** Last Chebyshev coefficients of each phase, relative to the scale of temperature.
     */
    struct Defect
    {
      double near, far;
    };
    Defect resolution_defect(double time, const Eigen::VectorXd &state) const;

    Profile profile(double time, const Eigen::VectorXd &state) const;

    double temperature(const Profile &profile, double coordinate) const;

    double heat_content(const Profile &profile, double lower, double upper) const;

  private:
    void find_temperature_scale();
    MappedPhase::Nodal near_nodal(double time, const Eigen::VectorXd &state) const;
    MappedPhase::Nodal far_nodal(double time, const Eigen::VectorXd &state) const;
    void near_rates(const MappedPhase::Derivatives &u, double front, double speed,
                    Eigen::VectorXd &rate) const;
    void far_rates(const MappedPhase::Derivatives &u, double front, double speed,
                   Eigen::VectorXd &rate) const;
    double logarithm(double coordinate, double front) const;
    double excess(const Profile &profile, double coordinate) const;

    OracleProblem problem;
    int exponent;          ///< m: 0 planar, 1 cylindrical, 2 spherical
    MappedPhase near, far; ///< at the inner wall, beyond the front
    int size;              ///< of the state
    double sink_factor;    ///< Q/(2 pi k), K
    double temperature_scale;
  };
} // namespace meltfront::cases::spectral

#endif
