#ifndef meltfront_particles_scattered_linear_choices_h
#define meltfront_particles_scattered_linear_choices_h

#include <cases/method.h>

#include <algorithm>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /** Names of LinearScheme, in its order. */
  const std::vector<std::string> &linear_scheme_names();

  /** The steps that are asked for, or those by default, of which a run takes no more. */
  long linear_steps(const cases::Resolution &resolution);

  /** The member of an enumeration that has a name, which is one of these. */
  template <typename Enumeration>
  Enumeration choice(const std::vector<std::string> &names, const std::string &name)
  {
    return static_cast<Enumeration>(std::ranges::find(names, name) - names.begin());
  }
} // namespace meltfront::particles

#endif
