#ifndef meltfront_cases_case_file_manufactured_reader_h
#define meltfront_cases_case_file_manufactured_reader_h

#include <cases/case_file/exact_reader.h>
#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Declare the keys of the exact solution `manufactured`. */
  void declare_manufactured(PrmFile &prm);

  /** Forbid them for a solution of another kind. */
  void forbid_manufactured_keys(const PrmFile &prm);

  /**
   * The solution whose front a family gives, and the heat that the scene has to release.
   * @throws InputError (file, line, key) where the scene cannot be that solution's.
   */
  KnownSolution read_manufactured_solution(const PrmFile &prm, const Scene &scene);
} // namespace meltfront::cases

#endif
