#ifndef meltfront_cases_case_h
#define meltfront_cases_case_h

#include <cases/exact_solution.h>
#include <cases/scene.h>

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /** What a criterion asks of a quantity. */
  enum class Statistic
  {
    value,  ///< the quantity at one n, the mean over the seeds
    median, ///< the quantity at one n, the median over the seeds
    order,  ///< the exponent fitted over all n of the table
    worst,  ///< the largest value over all n of the table
    failure ///< whether the run at one n ends with a numerical error, as it is known to
  };

  /** Stands for the label in a criterion that every label has to keep by itself. */
  inline constexpr const char *any_method = "any method";

  /** A bound that a result must keep: an acceptance criterion of a case or a matrix. */
  struct Criterion
  {
    std::string text;     ///< as written in the file
    std::string method;   ///< or a label, `fem-fitted[degree=2]`; `[degree=*]`: any
    std::string quantity; ///< a column of the convergence table, e.g. `front_rms`
    Statistic statistic = Statistic::value;
    int n = 0;      ///< for Statistic::value, median and failure
    int n_from = 0; ///< for the others: rows n_from <= n <= n_to of the table count
    int n_to = std::numeric_limits<int>::max();
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    /** Why it is not met and by how much, measured; empty when it is met. Does not make
     * it pass. */
    std::string expected_failure;
  };

  /** The run that others are held against where no exact solution exists. */
  struct Reference
  {
    std::string label; ///< of the method, with its options in brackets, as in tables
    int n = 0;
  };

  /** A number printed in a paper that a table restates. */
  struct PrintedValue
  {
    std::string source; ///< e.g. `Monaghan et al. 2005, Table 1`
    std::string method;
    std::string quantity;
    int n = 0;
    double value = 0;
  };

  /** Plots of a case's report that restate figures of a paper. */
  inline constexpr std::array<const char *, 5> figure_names{
      "particles", "temperature", "solid fraction", "concentration", "front"};

  /** What happens once in a run, and when is measured. */
  enum class TimedEvent
  {
    first_contact, ///< the bodies of ice around two sinks connect
    half_frozen,   ///< half of the volume is solid
    all_frozen     ///< no liquid is left
  };
  inline constexpr std::size_t n_timed_events = 3;

  /** The words for the events, in the order of the enumeration. */
  inline constexpr std::array<const char *, n_timed_events> timed_event_names{
      "first_contact", "half_frozen", "all_frozen"};

  /** Most times at which a case measures the volume that is solid. */
  inline constexpr int most_intermediate_times = 8;

  /** How the case is measured. */
  struct Measurement
  {
    int samples = 100; ///< snapshots over the run, at least 50; 0: every step
    bool square_root_clock = false; ///< samples equidistant in sqrt(t) rather than in t
    double temperature_from
        = 0; ///< coordinates between which temperature is compared (m)
    double temperature_to = std::numeric_limits<double>::infinity();
    double front_floor
        = 0; ///< error of the exact solution itself in this domain (m); 0: exact
    bool monotone_front = true; ///< physics says that the front never turns back
    /**
     * m > 0: the amplitude of cos(m phi) in a perturbed circular front is measured, from
     * the solid's moment of that angle.
     */
    int front_mode = 0;
    /** The straight line through the squares of the front's positions over time is
     * measured from the first time on at which the front has come so far (m). Absent: it
     * is not. */
    std::optional<double> front_square_from;
    /** Times at which the volume that is solid is measured, at most
     * `most_intermediate_times` (s), ascending; the end beside them. */
    std::vector<double> intermediate_times;
    /**
     * Absolute zero on the scene's scale of temperature, -273.15 for degrees Celsius: the
     * entropy is measured, which must never fall in an isolated scene. Absent: it is not.
     */
    std::optional<double> absolute_zero;
    /** Events whose times are measured; every step is looked at until they have happened.
     */
    std::vector<TimedEvent> events;
    /** The direction (0, 1, 2 for x, y, z) in which the temperature is compared with its
     * mirror image about the origin. Absent: it is not. */
    std::optional<int> mirror;
    /** Number of the intermediate time, from 1, at which a picture of the scene is kept
     * beside that of the end; 0: none. */
    int picture_time = 0;
  };

  /** A scene, what is known of its solution, what to measure and what to accept. */
  struct Case
  {
    Scene scene;
    std::string title;
    std::string description;
    std::vector<std::string> tags;
    std::vector<std::string> limits; ///< sentences for `limits and omissions`
    /** Effects are left out that change front and temperature by less than this, all of
     * them together (effects_within()); 0: none is. */
    double effect_tolerance = 0;
    std::shared_ptr<const ExactSolution> exact;
    std::optional<Reference> reference; ///< where there is no exact solution
    Measurement measurement;
    std::vector<Criterion> criteria;
    std::vector<PrintedValue> printed;
    /** By the plot, one of `figure_names`: `Monaghan et al. 2005, Fig. 6`. */
    std::map<std::string, std::string> printed_figures;
    std::string file; ///< path that it was read from
    std::string text; ///< the file's text, for hashes and records
  };
} // namespace meltfront::cases

#endif
