#ifndef meltfront_reference_fem_cut_options_h
#define meltfront_reference_fem_cut_options_h

#include <cases/method.h>
#include <cases/overshoot.h>
#include <reference_fem/cut/front_band.h>
#include <reference_fem/cut/phase_problem.h>

#include <vector>

namespace meltfront::reference_fem::cut
{
  /** Neither the elements nor BDF2 obey the maximum principle, nor does the projection of
   * a start that waves: of waves as long as the disk's radius 0.05, 0.023 and 0.011 at n
   * = 12, 20, 32, of shorter ones up to 0.034 at n = 20. */
  inline constexpr cases::Overshoot overshoot{0.04, 1.5};

  /** The options of `fem-cut`. */
  std::vector<cases::OptionDeclaration> cut_options();

  /** Their values. */
  struct RunOptions
  {
    explicit RunOptions(const cases::Options &options);

    int degree, level_set_degree;
    int refinement;
    BandWidths widths;
    double step_factor;
    long fewest_steps;
    int solves;
    double smoothing;
    double seed_cells;
    Stabilization stabilization;
  };
} // namespace meltfront::reference_fem::cut

#endif
