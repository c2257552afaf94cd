#ifndef meltfront_cases_tests_support_course_h
#define meltfront_cases_tests_support_course_h

#include <cases/method.h>
#include <cases/scene.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/** How tests of all methods run scenes, and what they see of them. */
namespace meltfront::test_support
{
  /** Options of a method by their keys. */
  using OptionTexts = std::vector<std::pair<std::string, std::string>>;

  /** Asks for nothing and keeps nothing. */
  struct NoObserver : cases::Observer
  {
    bool wants(long, double) override
    {
      return false;
    }

    void observe(const cases::Snapshot &) override
    {
    }
  };

  /** What a run shows, step by step; arrays of sites are those of the last snapshot. */
  struct Course : cases::Observer
  {
    bool wants(long, double) override
    {
      return true;
    }

    void begin(const cases::RunDescription &run) override
    {
      description = run;
    }

    void observe(const cases::Snapshot &snapshot) override;

    void note(double, const std::string &event) override
    {
      notes.push_back(event);
    }

    cases::Position place(std::size_t site) const
    {
      return {positions[0][site], positions[1].empty() ? 0 : positions[1][site],
              positions[2].empty() ? 0 : positions[2][site]};
    }

    /** Of the heat balance, the largest of all steps. */
    double worst_budget_defect() const;

    cases::RunDescription description;
    cases::Cost cost;
    std::vector<std::string> notes;

    std::vector<double> time;
    std::vector<long> step;
    std::vector<double> solid, volume;   ///< sums over the sites (m, m^2, m^3)
    std::vector<double> first_front;     ///< x of the first point of the front, -1: none
    std::vector<double> budget_defect;   ///< of the heat balance
    std::vector<double> lowest, highest; ///< temperatures

    std::array<std::vector<double>, 3> positions, front_points;
    std::vector<double> weights, temperature, solid_fraction;
    std::vector<unsigned int> cells;
    std::array<std::vector<double>, cases::most_solutes> concentration;
    bool obeys_maximum_principle = true; ///< so it says
    double worst_solute_defect = 0;      ///< of all solutes and steps
    cases::HeatBudget heat;
    cases::SubstanceBudget mass;
    std::array<cases::SubstanceBudget, cases::most_solutes> solute;
  };

  /** A course beside an exact solution, or beside none. */
  struct FrontCourse : Course
  {
    FrontCourse() = default;

    /** @param temperature_from coordinate from which temperature errors count (m) */
    FrontCourse(Course seen, const cases::Scene &scene, const cases::ExactSolution *exact,
                double temperature_from = 0);

    /** Largest |front - exact| over steps after a time, over the exact front at the end.
     */
    double worst_front_error(double after = -1e300) const;
    double final_front_error() const;

    std::vector<double> front; ///< of the region that holds the phase of the origin (m)
    std::vector<double> front_exact; ///< zeros without a solution
    double temperature_error = 0;    ///< relative L2 of T - T_m at the end
  };

  /** Options set by their texts; the text `threads` sets the number of threads. */
  cases::Resolution resolution_of(const cases::Method &method, int n,
                                  const OptionTexts &options = {}, int threads = 1,
                                  std::uint64_t seed = 1);

  /** Run a scene with its own effects. */
  cases::Cost solve(const cases::Method &method, const cases::Scene &scene,
                    const cases::Resolution &resolution, cases::Observer &observer);

  /** The same, each step looked at. */
  Course course_of(const cases::Method &method, const cases::Scene &scene, int n,
                   const OptionTexts &options = {}, int threads = 1);

  /** Exponent of `spacing` in `errors` by least squares in the logarithms. */
  double fitted_order(const std::vector<double> &spacing,
                      const std::vector<double> &errors);

  /** Exponent of 1/n. */
  double fitted_order(const std::vector<int> &n, const std::vector<double> &errors);
} // namespace meltfront::test_support

#endif
