#ifndef meltfront_cases_exact_radau_h
#define meltfront_cases_exact_radau_h

#include <Eigen/Dense>

#include <functional>
#include <string>
#include <vector>

namespace meltfront::cases::spectral
{
  /** An initial value problem y' = f(t, y), stiff. */
  struct StiffProblem
  {
    std::function<void(double time, const Eigen::VectorXd &state, Eigen::VectorXd &rate)>
        rate;
    /** The size of each component that errors are measured against. */
    std::function<Eigen::VectorXd(const Eigen::VectorXd &state)> scale;
    /** False for states at which the rate has no meaning: the step is made smaller. */
    std::function<bool(const Eigen::VectorXd &state)> admissible;
    /** Called at the start and after each step; may throw. */
    std::function<void(long step, double time, const Eigen::VectorXd &state)> observe;
    /** If given: true ends the integration before its end. Asked after each step. */
    std::function<bool(double time, const Eigen::VectorXd &state)> finished{};
    std::string name; ///< for messages
  };

  /** A solution as one polynomial in time per step. */
  class Trajectory
  {
  public:
    Eigen::VectorXd state(double time) const;

    /** Where the last piece ends. */
    double end() const;

    long steps() const
    {
      return static_cast<long>(pieces.size());
    }

  private:
    struct Piece
    {
      double start, length;
      Eigen::MatrixXd states; ///< one column per abscissa
    };

    friend class RadauIntegrator;

    Eigen::VectorXd value(const Piece &piece, double time) const;

    std::vector<Piece> pieces;
    Eigen::VectorXd abscissae; ///< 0 and those of the stages, in units of the step
    Eigen::VectorXd weights;   ///< barycentric
  };

  /**
   * Radau IIA collocation (Hairer and Wanner 1996, IV.5 and IV.8): L-stable, order
   * 2 stages - 1 at the end of a step and stages + 1 within it. The stages are found by
   * simplified Newton iteration in the eigenbasis of the inverse coefficient matrix, the
   * step by comparing the collocation polynomial with the one of a degree less.
   */
  class RadauIntegrator
  {
  public:
    explicit RadauIntegrator(int stages);

    /**
     * @param tolerance  of each step, relative to StiffProblem::scale, maximum norm over
     * components and over the step
     * @throws NumericalError where the step becomes too small.
     */
    Trajectory integrate(const StiffProblem &problem, const Eigen::VectorXd &initial,
                         double start, double end, double tolerance) const;

  private:
    /** Find the stages of a step in place; false where the iteration does not converge.
     */
    bool solve_stages(const StiffProblem &problem, double time, double length,
                      const Eigen::MatrixXd &jacobian, const Eigen::VectorXd &scale,
                      double tolerance, Eigen::MatrixXd &states) const;

    int stages;
    Eigen::VectorXd abscissae;         ///< of the stages
    Eigen::MatrixXd inverse;           ///< of the coefficient matrix
    Eigen::VectorXcd eigenvalues;      ///< of the inverse
    Eigen::MatrixXcd eigenvectors;     ///< of the inverse
    Eigen::MatrixXcd from_eigenvector; ///< inverse of eigenvectors
    Eigen::VectorXd predictor;         ///< weights of the stages' polynomial at 0
  };
} // namespace meltfront::cases::spectral

#endif
