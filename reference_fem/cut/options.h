#ifndef meltfront_reference_fem_cut_options_h
#define meltfront_reference_fem_cut_options_h

#include <cases/method.h>
#include <cases/option_binder.h>
#include <cases/overshoot.h>
#include <reference_fem/cut/front_band.h>
#include <reference_fem/cut/phase_problem.h>

#include <string>

namespace meltfront::reference_fem::cut
{
  /** Neither the elements nor BDF2 obey the maximum principle, nor does the projection of
   * a start that waves: of waves as long as the disk's radius 0.05, 0.023 and 0.011 at n
   * = 12, 20, 32, of shorter ones up to 0.034 at n = 20. */
  inline constexpr cases::Overshoot overshoot{0.04, 1.5};

  /** How heat and front are carried through time. */
  enum class Scheme
  {
    automatic,   ///< conservative, but where an option of the extension is set
    extension,   ///< BDF2 on phases that reach beyond the front
    conservative ///< the heat of each hat function and the solid's area, SDIRK
  };

  /** Where the front comes from. */
  enum class StartFrom
  {
    automatic, ///< the scene; where that has none, or jumps, the enthalpy method
    scene,
    enthalpy
  };

  /** The options of `fem-cut`. */
  struct RunOptions
  {
    void bind(cases::OptionBinder &options);

    Scheme scheme = Scheme::automatic;
    int passes = 12;
    int degree = 1, level_set_degree = 2;
    int refinement = 0;
    BandWidths widths;
    double cfl = 0.25;
    long fewest_steps = 0;
    int solves = 2;
    double speed_smoothing = 0.25;
    double seed_cells = 3;
    StartFrom start = StartFrom::automatic;
    double start_depth = 3;
    int start_refinement = 4;
    Stabilisation stabilisation;
  };

  /** A scheme, and why it is the one. */
  struct SchemeChoice
  {
    Scheme scheme; ///< not automatic
    std::string why;
  };

  /**
   * The options of a run, with its fewest steps if none are given: of the conservative
   * scheme as many as cells along the side, so that errors of time and of space fall
   * alike, and fifty or more; a hundred or more where the scene gives something that
   * varies with time, and of the extension.
   * @throws cases::InputError
   */
  RunOptions options_for(const cases::Scene &scene, const cases::Resolution &resolution);

  /** The name of an option that is set and that only the extension knows; else empty. */
  std::string option_of_extension(const RunOptions &options);

  /** The scheme of a run: what the option says, or what `automatic` makes of the others.
   */
  SchemeChoice chosen_scheme(const RunOptions &options);
} // namespace meltfront::reference_fem::cut

#endif
