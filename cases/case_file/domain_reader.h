#ifndef meltfront_cases_case_file_domain_reader_h
#define meltfront_cases_case_file_domain_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

#include <string>

namespace meltfront::cases
{
  /** What the file says that the solution depends on. */
  Symmetry read_symmetry(const PrmFile &prm);

  /** The domain; keys of other shapes than its own are complained of. */
  Domain read_domain(const PrmFile &prm);

  /** Complain of a symmetry that the domain does not have. */
  void check_symmetry(const PrmFile &prm, const Domain &domain, Symmetry symmetry);

  /** A point with as many coordinates as the domain has dimensions. */
  Position read_position(const PrmFile &prm, const std::string &subsection,
                         const std::string &key, int dimension);
} // namespace meltfront::cases

#endif
