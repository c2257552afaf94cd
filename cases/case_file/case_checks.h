#ifndef meltfront_cases_case_file_case_checks_h
#define meltfront_cases_case_file_case_checks_h

#include <cases/case.h>
#include <cases/case_file/exact_reader.h>
#include <cases/case_file/prm_file.h>

namespace meltfront::cases
{
  /** The key that gives a wall's value. */
  const char *value_key(const Boundary &boundary);

  /** Points all over a domain at which values are checked. */
  std::vector<Position> sample_points(const Domain &domain);

  /**
   * Expressions must be finite, and symmetric where the scene is: temperatures are
   * sampled over the domain and its walls. @throws InputError
   */
  void check_fields(const PrmFile &prm, const Scene &scene);

  /**
   * The exact solution must satisfy the scene's walls and initial state, unless the case
   * states by how much it is off (Measurement::front_floor). @throws InputError
   */
  void check_exact_solution(const PrmFile &prm, const Case &c);
} // namespace meltfront::cases

#endif
