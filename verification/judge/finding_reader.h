#ifndef meltfront_verification_judge_finding_reader_h
#define meltfront_verification_judge_finding_reader_h

#include <cases/case_file/prm_file.h>
#include <verification/judge/finding.h>

#include <vector>

namespace meltfront::verification
{
  /** Declare the subsections `Finding i` and `Picture i` of a matrix file. */
  void declare_findings(cases::PrmFile &prm);

  /**
   *     subsection Finding 1
   *       set claim = Backward Euler is of first order in time ({1}).
   *       set evidence 1 = bar: rkpm[scheme=euler]: order of front_end in 0.9 .. 1.3
   *     end
   *
   * @throws InputError, one sentence with file, line and key
   */
  std::vector<Finding> read_findings(const cases::PrmFile &prm);

  /** @throws InputError, one sentence with file, line and key */
  std::vector<Picture> read_pictures(const cases::PrmFile &prm);
} // namespace meltfront::verification

#endif
