#ifndef meltfront_cases_case_file_outline_reader_h
#define meltfront_cases_case_file_outline_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /**
   * Read the outline, its bounding box and its reference length into a domain of that
   * shape.
   * @throws InputError for corners that make no polygon, a radius that closes no curve,
   * both of them or neither
   */
  void read_outline(const PrmFile &prm, Domain &domain);

  /** @throws InputError if a file whose domain has another shape sets a key of an
   * outline. */
  void forbid_outline_keys(const PrmFile &prm, const std::string &shape);
} // namespace meltfront::cases

#endif
