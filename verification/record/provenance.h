#ifndef meltfront_verification_record_provenance_h
#define meltfront_verification_record_provenance_h

#include <cases/method.h>

#include <map>
#include <string>

namespace meltfront::verification
{
  /** What produced a run, as far as the program knows it by itself: `compiler`, `flags`,
   * `kernels` (the level of x86-64 that the loader chose for the particle methods),
   * `cpu`, `system`, `packages` (with their versions). */
  std::map<std::string, std::string> build_provenance();

  /** SHA-256 over the file of the running program and the shared libraries of meltfront
   * that it has loaded. */
  std::string program_hash();

  /** Say which plugin a method came from, by its file's SHA-256. */
  void note_plugin(const std::string &method, const std::string &hash);

  /** What a run with these options depends on beside the program and the case:
   * Method::further_provenance(), and the `plugin_hash` of a plugin's method. */
  std::map<std::string, std::string> method_provenance(const cases::Method &method,
                                                       const cases::Options &options);

  /** Now, `2026-11-21 07:30:36 UTC`. */
  std::string current_date();
} // namespace meltfront::verification

#endif
