#ifndef meltfront_cases_initial_level_h
#define meltfront_cases_initial_level_h

#include <cases/scene.h>

namespace meltfront::cases
{
  /** A level set of an exact solution's front: negative in the solid. */
  inline Field exact_level(const std::shared_ptr<const ExactSolution> &exact)
  {
    const double sign = exact->solid_at_origin() ? 1 : -1;
    return {"exact", [exact, sign](const Position &p, double time)
            { return sign * exact->signed_distance(p, time); }};
  }

  /**
   * A level set that is negative in what is solid at the start: that of the scene's own
   * front, or its temperature (K) over the melting one; what is at the melting
   * temperature is solid where at least half of it is
   * (Initial::solid_fraction_at_melting).
   */
  inline Field initial_level(const Scene &scene)
  {
    if(scene.initial.front)
      return *scene.initial.front;
    const double melting = scene.material.melting_temperature;
    const double at_melting = scene.initial.solid_fraction_at_melting < 0.5 ? 1 : -1;
    return {"", [temperature = scene.initial.temperature, melting,
                 at_melting](const Position &p, double time)
            {
              const double excess = temperature(p, time) - melting;
              return excess != 0 ? excess : at_melting;
            }};
  }
} // namespace meltfront::cases

#endif
