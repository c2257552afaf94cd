#ifndef meltfront_cases_case_file_oracle_reader_h
#define meltfront_cases_case_file_oracle_reader_h

#include <cases/case_file/exact_reader.h>

namespace meltfront::cases
{
  /** The spectral oracle of a scene with a symmetry, walls and start as the scene has
   * them. @throws InputError with file, line and key for what it does not solve */
  KnownSolution read_oracle(const PrmFile &prm, const Scene &scene);

  /** The same of a disk or an annulus, seen in the half section of a cylinder. */
  KnownSolution read_oracle_in_half_section(const PrmFile &prm, const Scene &scene);
} // namespace meltfront::cases

#endif
