#ifndef meltfront_reference_fem_cut_conservative_stage_h
#define meltfront_reference_fem_cut_conservative_stage_h

#include <reference_fem/cut/conservative/phase_operators.h>

#include <array>

namespace meltfront::reference_fem::cut::conservative
{
  /** What a stage sets out from. */
  struct StageData
  {
    StageTime time;
    double duration;            ///< of the stage's own slope, gamma dt (s)
    std::array<Values, 2> heat; ///< carried to it, by phase and hat (J/m)
    Values change;              ///< of the solid's area, carried to it, by hat (m^2)
    Values increment;           ///< of the level set since the step's begin, predicted
    Guess guess;
    int fewest_passes = 1; ///< that are made where a front moves
  };

  struct StageResult
  {
    Values increment;
    Guess guess;                ///< temperatures and front, as they were found
    std::array<Values, 2> heat; ///< J/m
    Values flux; ///< heat that the phases take up through the front, by hat (W/m)
    Values debt; ///< what the front's law is off by, by hat (m^2)
    double wall_power = 0, released_power = 0, source_power = 0; ///< W/m
    bool settled = true;  ///< the passes came to rest
    bool limited = false; ///< a move was cut to one spacing
    long solves = 0;
    long entries = 0; ///< of the matrices
  };

  /**
   * Solves one implicit stage for temperatures and front,
   *
   *   M(theta_p, w) - g S_p(theta_p, w) = carried heat          w: hats of phase p
   *   A(phi; w) - A(phi_begin; w) = carried change + g/(rho L) sum_p F_p(w) +
   * smoothing(w)
   *
   * A(phi; w) the integral of w over the solid, F_p the flux of the condition at the
   * front in the same hats. A pass solves one linear system for temperatures and the
   * increment of the level set, in which the condition at the front follows the increment
   * (Newton's method but for terms of the size of the step's thermal length; see
   * FrontMove for how far the increment is made). Passes end when the front has less than
   * 1e-2 spacings left to move, by how much less each moves it than the one before.
   *
   * However many passes are made no heat is lost: the heat of a hat is that of the last
   * solve's geometry, and what the law of the front is off by is carried on as debt.
   *
   * @param passes at most
   * @throws std::runtime_error where the system is singular or its solution not finite
   * @throws cases::OutOfMemory
   */
  StageResult solve_stage(PhaseAssembly &assembly, const cases::Scene &scene,
                          const TriangleMesh &mesh, const StepFrame &frame,
                          const StageData &data, int passes);

  /** Temperatures that hold given heat, but for what evens out across a fifth of a cell:
   * by a short step without walls, released heat or a flux at the front. */
  Temperatures temperatures_of(PhaseAssembly &assembly, const StepFrame &frame,
                               const StageTime &time, double duration,
                               const std::array<Values, 2> &heat);

  /** The same, and makes them what the hats hold: what has left a phase through its front
   * in that step is spread over the phase by another one without a front. Every phase
   * keeps its heat to round-off. */
  Temperatures spread_heat(PhaseAssembly &assembly, const StepFrame &frame,
                           const StageTime &time, double duration,
                           std::array<Values, 2> &heat);
} // namespace meltfront::reference_fem::cut::conservative

#endif
