#ifndef meltfront_cases_case_file_prm_include_h
#define meltfront_cases_case_file_prm_include_h

#include <cstdint>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /** Where a line of a text comes from. */
  struct PrmOrigin
  {
    int reading = 0; ///< index in PrmText::files
    int line = 0;
  };

  /** A parameter file with the lines of what it includes in it. */
  struct PrmText
  {
    std::string text;
    std::vector<std::string> files; ///< as they were read; one may have been read twice
    std::vector<std::string> paths; ///< of the same, where `files` is cut for messages
    std::vector<PrmOrigin> origins; ///< of each line of the text

    /** `FILE:LINE`, as the user wrote it, of a line of the text. */
    std::string place(int line) const;

    /** The path of the file that a line is from. */
    const std::string &path(int line) const;

    /** Which reading of which file a line is from. */
    int reading(int line) const;
  };

  /** A text that includes nothing. @param file names it in messages */
  PrmText plain_text(const std::string &text, const std::string &file);

  /** The text of a file. @throws OutputError if it cannot be read, InputError if it is
   * too large for a parameter file. */
  std::string read_prm_text(const std::string &path);

  /** The same of a file of up to so many bytes. @param what no such file is */
  std::string read_text_file(const std::string &path, std::uintmax_t largest,
                             const std::string &what);

  /**
   * Put the lines of the files that a text includes (`include FILE`, as deal.II has it)
   * in the place of these lines. FILE is searched beside the file that includes it, then
   * in the library's folder. A file may stand in any subsection and closes what it opens.
   *
   * A text that includes nothing stays as it is, byte by byte.
   *
   * @param file names the text in messages
   * @throws InputError, with file and line, for a file that there is not (the nearest of
   * the library is named), for one that includes itself, and for an `end` too few or too
   * many in an included file.
   */
  PrmText expand_includes(const std::string &text, const std::string &file,
                          const std::string &library);
} // namespace meltfront::cases

#endif
