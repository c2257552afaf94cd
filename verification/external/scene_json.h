#ifndef meltfront_verification_external_scene_json_h
#define meltfront_verification_external_scene_json_h

#include <cases/effects.h>
#include <cases/method.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace meltfront::cases
{
  struct Scene;
}

namespace meltfront::verification::external
{
  /** How values that vary in space and time are tabulated. */
  struct Sampling
  {
    bool expressions = false; ///< also what an expression tells; else what none does
    bool at_vertices = false; ///< at the ends of the n cells, not at their middles
    int times = 1025;         ///< equidistant, from start to end
  };

  /**
   * A scene of heat as the protocol has it: every number with its unit; expressions as
   * text; values that are taken from an exact solution, and on request all others that
   * vary, in tables.
   *
   * Tables hold values at places of the lattice of cells of n along the domain's side
   * and, on a wall, at those of its cells that lie at it: along the one coordinate of a
   * cylindrical or spherical scene; of other round or outlined walls at 4 n points at
   * equal distances.
   *
   * @throws cases::Refusal for what the protocol has no words for (alloys, walls of a
   * ball in space that vary), and for tables of more than four million numbers
   */
  nlohmann::json scene_json(const cases::Scene &scene, int n, const Sampling &sampling);

  /** All that a program is asked: the scene, its effects, n, options and the times of
   * which snapshots are wanted. */
  nlohmann::json request_json(const cases::Scene &scene, const cases::EffectSet &effects,
                              const cases::Resolution &resolution,
                              const cases::Options &options_of_program,
                              const std::vector<double> &times, const Sampling &sampling);
} // namespace meltfront::verification::external

#endif
