#ifndef meltfront_verification_studies_ladders_ladder_growth_h
#define meltfront_verification_studies_ladders_ladder_growth_h

#include <cases/method.h>
#include <verification/judge/matrix_result.h>
#include <verification/matrix/runner.h>
#include <verification/studies/ladders/capable_methods.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A method with the resolutions that it was given. */
  struct GrowingLadder
  {
    const cases::Method *method;
    std::string label; ///< of its runs, as run_label() gives it
    std::vector<int> resolutions;
    std::string stopped{};    ///< why no finer one follows; empty while one may
    bool passed_over = false; ///< the finest was refused
    int checked = 0;          ///< level that is made at half its step, too; 0: none
    long checked_steps = 0;
  };

  /**
   * Resolutions of several methods on one case, coarse to fine, that are chosen while
   * time lasts.
   *
   * Each stage makes the next level of every ladder, in parallel and resumable by
   * run_matrix(). A level is made if the time it is predicted to take, t (n'/n)^q with
   * the growth q of other cases (method_prior()) and half as much again, fits into what
   * is left; the dearest are left out first. A run that takes longer than all that is
   * left is ended; its ladder ends at the level before.
   */
  class LadderGrowth
  {
  public:
    /**
     * @param case_name by name or path
     * @param domain of the case: levels are those whose lattices fill it
     * @param load_case is called at every stage
     * @param within seconds by the clock for all
     * @param settings of the methods' options
     */
    LadderGrowth(const std::string &case_name, const cases::Domain &domain,
                 const std::string &title,
                 const std::vector<const cases::Method *> &methods,
                 const RunnerOptions &options, CaseLoader load_case, MethodLookup lookup,
                 double within, MethodSettings settings = {});

    /** Make the next level of every ladder that has time for it.
     * @param share of the time left that it may take
     * @return false if there is none */
    bool grow(double share = 1);

    /** Make one level of one method, whatever it takes. */
    void make(const cases::Method &method, int n);

    /** Make these levels of every method, the coarsest first, and go on after failures;
     * what there is no time for is left out. */
    void make_all(const std::vector<int> &resolutions);

    /** Of every ladder whose steps were refined too little with space to tell their error
     * (hides_time_error()), one more run of its finest level at half the step, or of the
     * level before it where time is left for that only; none where for neither. */
    void check_steps();

    /** The least resolution from n on at which a method's lattice fills the domain; n
     * itself where that is far off. */
    int fitting(const cases::Method &method, int n) const;

    double seconds_left() const;

    /** What has been made, each stage over again. */
    const MatrixResult &result() const;

    const std::vector<GrowingLadder> &ladders() const;

    /** A sentence for every ladder that ended for another reason than enough levels. */
    std::vector<std::string> stops() const;

    /** Write the plan anew, with remarks on how its levels were chosen, and do what is to
     * be done with the result. */
    void conclude(const std::vector<std::string> &remarks,
                  const std::function<void(MatrixResult &)> &what);

    /** The finished run of a method at its finest level; null for none. */
    const RunRecord *finest(const cases::Method &method) const;

    /** Seconds that a method is predicted to take at n; NaN before it has run. */
    double predicted_seconds(const cases::Method &method, int n) const;

  private:
    Matrix matrix() const;
    void run(const std::function<void(MatrixResult &)> &what);
    const RunRecord *last_run(const GrowingLadder &ladder) const;
    void drop_out_of_time(GrowingLadder &ladder);
    void drop_ended(GrowingLadder &ladder);
    void drop_checks_that_ended();
    std::filesystem::path folder_of(const RunRecord &run) const;

    std::string case_name;
    int coarsest;      ///< level of every ladder, if its lattice fills the domain
    bool halves_cells; ///< those of a mesh file: levels are powers of two
    int whole_cells;   ///< fewest_whole_cells()
    std::string title;
    std::vector<std::string> remarks;
    std::vector<GrowingLadder> growing;
    RunnerOptions options;
    CaseLoader load_case;
    MethodLookup lookup;
    double within;
    MethodSettings settings;
    std::chrono::steady_clock::time_point start;
    MatrixResult made;
  };
} // namespace meltfront::verification

#endif
