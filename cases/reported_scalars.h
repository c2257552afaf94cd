#ifndef meltfront_cases_reported_scalars_h
#define meltfront_cases_reported_scalars_h

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** A quantity that only the method can count, see Observer::report. */
  struct ReportedScalar
  {
    std::string name;
    std::string meaning; ///< one clause
  };

  /** Most particles of a solid of which it is told whether they are fluid at the end. */
  inline constexpr int most_named_particles = 46;

  /**
   * All of them, of particle solids: steps at which things happened (NaN if never),
   * numbers of particles and bonds, shares (0 or 1 in one run, a probability over the
   * seeds).
   */
  const std::vector<ReportedScalar> &reported_scalars();
} // namespace meltfront::cases

#endif
