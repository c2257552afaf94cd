#ifndef meltfront_cases_case_file_exact_reader_h
#define meltfront_cases_case_file_exact_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace meltfront::cases
{
  /** What a case file's exact solution knows. */
  struct KnownSolution
  {
    std::shared_ptr<const ExactSolution> solution; ///< null: none
    bool oracle = false;                           ///< computed from the scene itself
    std::function<double(double time)>
        power; ///< of the sink (W or W/m, negative), if it is a sink's solution
    std::function<double(double time)> energy; ///< integral of power from time 0
    std::vector<Field> concentration{};        ///< of each solute, if it is an alloy's
    /** Heat that has to be released throughout for it to hold (W/m^3). */
    std::optional<Field> volumetric_source{};
    /** k grad T (W/m^2), if the solution prescribes fluxes through walls. */
    std::function<std::array<double, 3>(const Position &, double time)> heat_flux{};
  };

  /**
   * Build the exact solution of a case file. The oracle takes walls, material and initial
   * state from the scene.
   */
  KnownSolution read_exact_solution(const PrmFile &prm, const Scene &scene);

  /** The solution in closed form, Neumann's or Frank's or that of a sink, that a key of
   * the exact solution's names. */
  KnownSolution closed_form(const PrmFile &prm, const Scene &scene,
                            const std::string &key);
} // namespace meltfront::cases

#endif
