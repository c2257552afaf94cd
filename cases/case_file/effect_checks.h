#ifndef meltfront_cases_case_file_effect_checks_h
#define meltfront_cases_case_file_effect_checks_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /**
   * An effect that is switched on must have what it acts on: a wall, a source, a property
   * of its own. @throws InputError
   */
  void check_effects(const PrmFile &prm, const Scene &scene);
} // namespace meltfront::cases

#endif
