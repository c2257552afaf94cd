#ifndef meltfront_verification_matrix_matrix_h
#define meltfront_verification_matrix_matrix_h

#include <cases/case.h>
#include <cases/method.h>
#include <verification/judge/finding.h>
#include <verification/record/label.h>

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /** Values that a matrix gives to an option of a method. */
  struct OptionAxis
  {
    std::string method;
    std::string key;
    std::vector<std::string> values;
  };

  /** Values that a matrix gives to a key of its cases. */
  struct CaseAxis
  {
    std::string key; ///< with its subsections: `Scene/Material/latent heat`
    std::vector<std::string> values;
  };

  /** Every case, with every combination of the values of its keys, with every method at
   * every resolution, with every combination of the option values that are the method's.
   */
  struct MatrixBlock
  {
    std::vector<std::string> cases; ///< by name, or by the path of a file
    std::vector<std::string> methods;
    std::vector<int> resolutions;
    std::vector<OptionAxis> options;
    std::vector<std::uint64_t> seeds{1};
    std::vector<int> threads{1};
    std::vector<CaseAxis> variations{}; ///< empty: the cases as they are written
  };

  /** A bound on what the matrix runs, beside those that its cases bring. */
  struct MatrixCriterion
  {
    std::string case_name; ///< of a PlannedCase, or a family of them (in_family())
    cases::Criterion criterion;
    std::string place; ///< `FILE:LINE: key 'criterion 1' in subsection '...'`
  };

  /** Cases x methods x resolutions: what is to be run. */
  struct Matrix
  {
    std::string name;
    std::string title;
    std::string description;
    bool hard_cases = false; ///< the report shows the table held / refused / failed
    double time_limit = 600; ///< of one run (wall s)
    std::vector<MatrixBlock> blocks;
    std::vector<MatrixCriterion> criteria{};
    std::vector<Finding> findings{}; ///< what the runs are claimed to show
    std::vector<Picture> pictures{}; ///< what its report draws
    /** What a reader must know of how it was planned, a sentence each. */
    std::vector<std::string> remarks{};
    bool careful_timing = false; ///< times are taken by time_carefully()
  };

  /** A case of a matrix: as written, or with values that the matrix gives to its keys. */
  struct PlannedCase
  {
    /** `bar`, or `bar[conductivity=10,latent_heat=7]`: the keys without their
     * subsections, as far as that tells them apart, sorted. */
    std::string name;
    std::string base; ///< the case as the matrix names it, by name or path
    std::vector<std::pair<std::string, std::string>> settings; ///< keys and their values
  };

  /** One cell of a matrix. */
  struct PlannedRun
  {
    std::string case_name;
    std::string method;
    std::string label;
    cases::Resolution resolution;

    /** `CASE/LABEL/n=N`, with `,seed=S` after N for a seed other than 1. */
    std::string identity() const;

    /** `runs/IDENTITY/run.json` */
    std::string file() const;
  };

  /** Finds a case by name. @throws InputError */
  using CaseLoader = std::function<cases::Case(const std::string &name)>;

  /** The name of a case that is given by name or by the path of its file: `x` for
   * `folder/x.prm`. */
  std::string short_case_name(const std::string &name_or_path);

  /** The cases of a matrix, each once and as written, in the order in which they are
   * first named. */
  std::vector<std::string> case_names(const Matrix &matrix);

  /** The cases of a matrix with what it varies in them, each once, in the same order.
   * @throws InputError for a key that is varied without any value. */
  std::vector<PlannedCase> planned_cases(const Matrix &matrix);

  /** The labels that a matrix runs at a case, a PlannedCase, each with its n. */
  std::map<std::string, std::set<int>> planned_labels(const Matrix &matrix,
                                                      const PlannedCase &planned);

  /**
   * The runs of a matrix, each once: by case as planned_cases() orders them, then by
   * method, option values, resolution and seed as written.
   *
   * @throws InputError for a method that there is not, an option that the method does not
   * have or a value that it does not take, options of a method that the block does not
   * name, a resolution or number of threads below 1, and a block without any run.
   */
  std::vector<PlannedRun> plan_runs(const Matrix &matrix, const MethodLookup &methods);

  /** A run of a plan by its identity, or by its place in it, from 1 on.
   * @throws InputError, which names the nearest, if there is none. */
  const PlannedRun &find_run(const std::vector<PlannedRun> &plan,
                             const std::string &identity_or_number);

  /**
   * Hold the names in a matrix's findings and pictures against what there is.
   * @throws InputError for a case that the matrix does not have, a method, option or
   * value that there is not, and a quantity that no table has.
   */
  void check_findings(const Matrix &matrix, const MethodLookup &methods);
} // namespace meltfront::verification

#endif
