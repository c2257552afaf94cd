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

  /** What the key `effects` says: the tolerance of `auto within 1e-3`, 0 for `auto`.
   * @throws InputError for anything else */
  double read_effect_tolerance(const PrmFile &prm);
} // namespace meltfront::cases

#endif
