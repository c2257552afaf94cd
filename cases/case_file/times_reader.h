#ifndef meltfront_cases_case_file_times_reader_h
#define meltfront_cases_case_file_times_reader_h

#include <cases/case_file/exact_reader.h>
#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** When the scene begins and ends, where the file says it by times. @throws InputError
   */
  void read_times(const PrmFile &prm, Scene &scene);

  /** The times at which the front of Neumann's solution, 2 lambda sqrt(a t), is where the
   * file lets the scene begin and end; nothing where it says it by times. */
  void take_times_from_fronts(const PrmFile &prm, const KnownSolution &known,
                              Scene &scene);
} // namespace meltfront::cases

#endif
