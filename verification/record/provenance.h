#ifndef meltfront_verification_record_provenance_h
#define meltfront_verification_record_provenance_h

#include <map>
#include <string>

namespace meltfront::verification
{
  /** What produced a run, as far as the program knows it by itself: `compiler`, `flags`,
   * `cpu`, `system`, `packages` (with their versions). */
  std::map<std::string, std::string> build_provenance();

  /** Now, `2026-11-21 07:30:36 UTC`. */
  std::string current_date();
} // namespace meltfront::verification

#endif
