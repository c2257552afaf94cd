#ifndef meltfront_cases_case_file_conduction_reader_h
#define meltfront_cases_case_file_conduction_reader_h

#include <cases/case_file/exact_reader.h>
#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Declare the keys of steady scenes, of heat released throughout the domain and of
   * inclusions, and those of the exact solutions without a front. */
  void declare_conduction(PrmFile &prm);

  /** Whether the file asks for a steady temperature. */
  ProblemKind read_problem(const PrmFile &prm);

  /**
   * Volumetric source and inclusion of a scene whose domain and material are known.
   * @throws InputError (file, line, key) also for an inclusion where the material changes
   * phase: it belongs to conduction alone.
   */
  void read_conduction(const PrmFile &prm, Scene &scene);

  /** The exact solution of a scene without change of phase: a formula, or the five-point
   * scheme on a fine lattice. */
  KnownSolution read_frontless_solution(const PrmFile &prm, const Scene &scene);

  /** Forbid the keys of solutions without a front for one of another kind. */
  void forbid_frontless_keys(const PrmFile &prm, const std::string &kind);

  /** Volumetric source and inclusion must be finite. */
  void check_conduction(const PrmFile &prm, const Scene &scene,
                        const std::vector<Position> &points);
} // namespace meltfront::cases

#endif
