#ifndef meltfront_verification_matrix_matrix_file_h
#define meltfront_verification_matrix_matrix_file_h

#include <verification/matrix/matrix.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * Read a matrix file:
   *
   *     set title = Two methods on two cases
   *     subsection Block 1
   *       set cases       = plane-freezing, line-sink
   *       set methods     = sph, fem-enthalpy
   *       set resolutions = 20, 40, 80, 160
   *       set options     = sph.step_factor = 0.5 | 0.9; sph.jitter = 0.2
   *     end
   *
   * `Acceptance` is read by read_criteria().
   * A block's `variations = Scene/Material/latent heat = 7 | 70` give values to keys of
   * its cases; `Finding i` and `Picture i` are read by read_findings() and
   * read_pictures().
   *
   * Its name is the file's without the ending.
   *
   * @throws InputError, one sentence with file, line and key; OutputError if it cannot be
   * read.
   */
  Matrix read_matrix(const std::string &path);

  /** Read a text; `file` is its name in messages. @throws InputError */
  Matrix read_matrix_text(const std::string &text, const std::string &file);

  /** The matrices of the library, sorted. */
  std::vector<std::string> matrix_names();

  /** A matrix of the library by its name, or of a file by its path. @throws as
   * read_matrix(); InputError for an unknown name, with the nearest one, and for a file
   * that there is not. */
  Matrix load_matrix(const std::string &name_or_path);

  /** All keys of a matrix file with default and meaning, as a commented file. */
  std::string matrix_file_reference();
} // namespace meltfront::verification

#endif
