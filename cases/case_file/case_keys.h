#ifndef meltfront_cases_case_file_case_keys_h
#define meltfront_cases_case_file_case_keys_h

#include <cases/case_file/prm_file.h>

namespace meltfront::cases
{
  /** A reader with every key of case files declared. */
  PrmFile case_keys();

  inline constexpr int most_sources = 8; ///< subsections `Scene/Source 1` ...
} // namespace meltfront::cases

#endif
