#ifndef meltfront_cases_exact_front_fixing_h
#define meltfront_cases_exact_front_fixing_h

#include <cases/exact/mapped_phase.h>
#include <cases/exact/oracle.h>

#include <Eigen/Dense>

#include <vector>

namespace meltfront::cases::spectral
{
  /**
   * The Stefan problem in space: each phase mapped onto [0, 1] and collocated.
   *
   * The state holds the nodal excesses T - T_m of each phase from the inner wall on, then
   * the fronts. Nodes on fronts (T = T_m) and on walls (given by the condition there) are
   * left out. A phase that holds the axis or the centre is mapped by x = (r/s)^2, in
   * which it is smooth:
   *
   *   T_t = a (4 x T_xx + 2 (1 + m) T_x)/s^2 + 2 x s'/s T_x;
   *
   * other phases linearly, with the nodes of the last one drawn towards its front where
   * its initial profile is steep there. With a line sink the T of the first excludes
   * Q/(2 pi k) ln(r/s), for which a uniform source Q/(2 pi k) s'/s stands in.
   */
  class FrontFixing
  {
  public:
    /** Temperatures at a time, ready to be evaluated anywhere. */
    struct Profile
    {
      double time;
      std::vector<double> edges; ///< inner end, fronts, outer end
      /** Of each phase at all nodes, without the sink's logarithm. */
      std::vector<Eigen::VectorXd> excess;
    };

    /** @param intervals  of each phase from the inner wall on */
    FrontFixing(const OracleProblem &problem, const std::vector<int> &intervals);

    Eigen::VectorXd initial_state() const;

    void rate(double time, const Eigen::VectorXd &state, Eigen::VectorXd &rate) const;

    Eigen::VectorXd scale(const Eigen::VectorXd &state) const;

    /** The fronts lie inside the domain in their order. */
    bool admissible(const Eigen::VectorXd &state) const;

    /** @throws NumericalError where a front is at a wall or another one, a phase is
     * beyond the melting temperature (unless metastable), or a value is not finite. */
    void check(long step, double time, const Eigen::VectorXd &state) const;

    /** How far the temperature of a wall is beyond the melting temperature, at most (K);
     * negative: not at all. */
    double beyond_at_walls(double time, const Eigen::VectorXd &state) const;

    /** Last Chebyshev coefficients of each phase, relative to the scale of temperature.
     */
    std::vector<double> resolution_defects(double time,
                                           const Eigen::VectorXd &state) const;

    Profile profile(double time, const Eigen::VectorXd &state) const;

    double temperature(const Profile &profile, double coordinate) const;

    double heat_content(const Profile &profile, double lower, double upper) const;

  private:
    void add_phases(const std::vector<int> &intervals);
    void find_temperature_scale();

    std::size_t n_fronts() const
    {
      return phases.size() - 1;
    }

    /** The phase at the inner end holds the axis. */
    bool holds_axis(std::size_t phase) const
    {
      return phases[phase].low.kind == PhaseEnd::axis;
    }

    std::vector<double> edges(const Eigen::VectorXd &state) const;
    MappedPhase::Nodal nodal(std::size_t phase, double time,
                             const Eigen::VectorXd &state) const;

    /** Heat that arrives at a front from both sides, positive where the phase before it
     * loses heat by it (W/m^2). */
    double heat_to_front(std::size_t front, const std::vector<double> &edge,
                         const std::vector<MappedPhase::Derivatives> &u) const;

    void axis_rates(const MappedPhase::Derivatives &u, double front, double speed,
                    Eigen::VectorXd &rate) const;

    /** Speeds (m/s) of a phase's ends, and of the material at its lower end. */
    struct Speeds
    {
      double lower = 0, upper = 0, material = 0;
    };
    void rates(std::size_t phase, const MappedPhase::Derivatives &u, double lower,
               double upper, const Speeds &speeds, Eigen::VectorXd &rate) const;

    double logarithm(double coordinate, double front) const;
    double excess(const Profile &profile, double coordinate) const;

    /** Number of the phase that holds a coordinate; at a front the one before it. */
    std::size_t phase_at(const Profile &profile, double coordinate) const;

    OracleProblem problem;
    int exponent;                    ///< m: 0 planar, 1 cylindrical, 2 spherical
    std::vector<MappedPhase> phases; ///< from the inner wall on
    std::vector<int> first;          ///< of each phase in the state, then of the fronts
    double sink_factor;              ///< Q/(2 pi k), K
    double temperature_scale;
  };
} // namespace meltfront::cases::spectral

#endif
