#ifndef meltfront_reference_fem_enthalpy_tests_support_h
#define meltfront_reference_fem_enthalpy_tests_support_h

#include <cases/exact_solution.h>
#include <cases/method.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/run.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meltfront::reference_fem::tests
{
  using ExactPointer = std::shared_ptr<const cases::ExactSolution>;

  /** k = c = rho = L = 1 with T_m = 1: the normalised case, lambda = 1/2 for this wall.
   */
  cases::Material normalised_material();
  inline constexpr double normalised_wall = 0.1906024227888705;
  inline constexpr double normalised_far = 1.2;

  /** Water and ice with equal densities, degrees Celsius. */
  cases::Material water();

  cases::Boundary fixed_wall(double temperature);
  cases::Boundary varying_wall(std::function<double(double)> temperature);
  cases::Boundary exact_wall(const ExactPointer &exact);
  cases::Boundary flux_wall(double flux);

  /** A slab 0 <= x <= length at a uniform initial temperature, insulated on both sides.
   */
  cases::Scene slab(const cases::Material &material, double length, double temperature,
                    double start, double end);

  /** A disk or ball with an insulated rim at a uniform initial temperature. */
  cases::Scene ball(const cases::Material &material, int dimension, double radius,
                    double temperature, double end);

  /** An insulated box. */
  cases::Scene box(const cases::Material &material, int dimension,
                   const cases::Position &lower, const cases::Position &upper,
                   double temperature, double end);

  void set_boundary(cases::Scene &scene, cases::Side side,
                    const cases::Boundary &boundary);

  /** Take initial state and, where they prescribe a temperature, walls from a solution.
   */
  void start_from(cases::Scene &scene, const ExactPointer &exact);

  /** What a run showed, one entry per step. */
  struct RunRecord
  {
    cases::Cost cost;
    StepStatistics statistics;
    cases::RunDescription description;
    std::vector<double> time;
    std::vector<double> front; ///< of the region that holds the solid (m)
    std::vector<double> front_exact;
    std::vector<double> budget_defect;
    std::vector<double> lowest, highest; ///< temperatures
    std::vector<double> positions[3], temperature, solid_fraction,
        weights; ///< at the end
    std::vector<unsigned int> cells;
    cases::HeatBudget heat;
    std::array<std::vector<double>, cases::most_solutes> concentration; ///< at the end
    cases::SubstanceBudget mass;
    std::array<cases::SubstanceBudget, cases::most_solutes> solute;
    double worst_solute_defect = 0;
    double temperature_error = 0; ///< relative L2 of T - T_m at the end

    double worst_budget_defect() const;

    /** Largest |front - exact| over steps after the given time, over the exact front at
     * the end. */
    double worst_front_error(double after) const;
    double final_front_error() const;
  };

  using OptionTexts = std::map<std::string, std::string>;

  /** Run a scene with its own effects, every step recorded. The text `threads` sets the
   * number of threads, any other an option of the method. */
  RunRecord run(const cases::Scene &scene, int n, const OptionTexts &options = {},
                const cases::ExactSolution *exact = nullptr);

  /** Exponent of h in errors by least squares. */
  double fitted_order(const std::vector<int> &n, const std::vector<double> &errors);
} // namespace meltfront::reference_fem::tests

#endif
