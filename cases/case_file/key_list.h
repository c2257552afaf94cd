#ifndef meltfront_cases_case_file_key_list_h
#define meltfront_cases_case_file_key_list_h

#include <cases/case_file/prm_file.h>

#include <vector>

namespace meltfront::cases
{
  /** All keys of case files one by one, in their order. */
  std::vector<PrmKey> case_file_keys();
} // namespace meltfront::cases

#endif
