#ifndef meltfront_cases_case_file_prm_entry_h
#define meltfront_cases_case_file_prm_entry_h

#include <cases/case_file/prm_file.h>

#include <deal.II/base/patterns.h>

#include <memory>
#include <string>

namespace meltfront::cases
{
  /** deal.II's pattern for the values of a key. */
  std::unique_ptr<dealii::Patterns::PatternBase> pattern(const PrmEntry &entry);

  /** What a key needs, in words: `a number greater than 0 (m)`. */
  std::string expectation(const PrmEntry &entry);

  /** A value that the key's pattern accepts: what stands in the handler until it is set.
   */
  std::string acceptable_text(const PrmEntry &entry);
} // namespace meltfront::cases

#endif
