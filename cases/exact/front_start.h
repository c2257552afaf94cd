#ifndef meltfront_cases_exact_front_start_h
#define meltfront_cases_exact_front_start_h

#include <cases/scene.h>

#include <functional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /** A state with a front in the plane, from which a method with a sharp front sets out.
   */
  struct FrontStart
  {
    using Function = std::function<double(const Position &)>;

    double time = 0;    ///< s; after the scene's start where the front was seeded
    Function level_set; ///< negative in the solid; only sign and zeros matter
    Function temperature;
    std::string description; ///< how the front was found, in words
  };

  /** How a method seeds the fronts around sinks. */
  struct SeedRule
  {
    std::string method; ///< its name, for messages
    std::string pieces; ///< what makes it finer if there are more: nodes or cells
    /** Bounds of the radius of the smallest seed (m). */
    double smallest = 0, largest = 0;
    /** Neighbours and walls must change a similarity solution by less than this part. */
    double negligible = 1e-6;
    /** Where the bisection for a front constant stops, relative to it. */
    double closed_bracket = 1e-16;
    /** Walls that may feel what is around a sink. */
    std::vector<Side> exempt_walls{};
  };

  /**
   * The exact solution's front, the scene's level set, where the initial temperature is
   * the melting temperature, or, around line sinks in a uniform liquid, the similarity
   * solution of each (LineSink) at the time at which the smallest has grown to a radius:
   * the largest one before walls or other sinks are felt.
   *
   * @param scene outlives the start
   * @throws Refusal where none of these applies
   */
  FrontStart find_front_start(const Scene &scene, const SeedRule &rule);
} // namespace meltfront::cases

#endif
