#ifndef meltfront_verification_matrix_criteria_reader_h
#define meltfront_verification_matrix_criteria_reader_h

#include <cases/case_file/prm_file.h>
#include <verification/matrix/matrix.h>

#include <vector>

namespace meltfront::verification
{
  /** Declare the subsections `Acceptance/CASE` of a matrix file. */
  void declare_criteria(cases::PrmFile &prm);

  /**
   *     subsection Acceptance
   *       subsection line-sink
   *         set criterion 1 = sph: front_rms at n=40 <= 1.05e-3
   *       end
   *     end
   *
   * The name may be that of a family, `line-sink-lambda-*`: then the worst of the cases
   * that the matrix has of it has to keep the bound.
   *
   * What the blocks of the matrix do not run can never be judged, and is a mistake.
   *
   * @throws InputError, one sentence with file, line and key, for a case, a label or an n
   * that no block runs, for an unknown quantity, and for a bound set twice.
   */
  std::vector<MatrixCriterion> read_criteria(const cases::PrmFile &prm,
                                             const Matrix &matrix);

  /** Whether two criteria bound the same figure on the same side. */
  bool bound_the_same(const cases::Criterion &one, const cases::Criterion &other);
} // namespace meltfront::verification

#endif
