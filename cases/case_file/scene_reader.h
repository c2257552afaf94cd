#ifndef meltfront_cases_case_file_scene_reader_h
#define meltfront_cases_case_file_scene_reader_h

#include <cases/case_file/exact_reader.h>
#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /**
   * The scene of a case file but for what it takes from the exact solution, which
   * complete_scene() fills in.
   */
  Scene read_scene(const PrmFile &prm);

  /** Take walls, sources and initial state from the exact solution where the file says
   * so.
   */
  void complete_scene(const PrmFile &prm, const KnownSolution &known, Scene &scene);

  /** Fill in the breakpoints of what walls prescribe and of the heat released.
   * @throws InputError where one varies faster than can be told. */
  void find_scene_breakpoints(const PrmFile &prm, Scene &scene);
} // namespace meltfront::cases

#endif
