#ifndef meltfront_cases_case_file_prm_scan_h
#define meltfront_cases_case_file_prm_scan_h

#include <cases/case_file/prm_include.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  /** One `set KEY = VALUE` of a parameter file. */
  struct PrmAssignment
  {
    std::string subsection; ///< path from the top, `Scene/Material`; empty at the top
    std::string key;
    std::string value;
    int line = 0;
  };

  /** A parameter file taken apart, with the line of everything in it. */
  struct PrmScan
  {
    std::vector<PrmAssignment> assignments; ///< in the file's order
    std::map<std::string, int> subsections; ///< path -> line on which it first opens
    /** First and last lines of what one file sets and another one sets again later. */
    std::vector<std::pair<int, int>> overridden;
  };

  /**
   * Take a parameter file apart: `set KEY = VALUE`, `subsection NAME`, `end`, comments
   * from
   * `#` to the end of the line, and a backslash at the end of a line that goes on below.
   * Line ends may be LF or CRLF; a byte order mark is skipped.
   *
   * @throws InputError, one sentence `FILE:LINE: ...`, for a line that is none of these,
   * a key set twice, an `end` too few or too many, and bytes that are not UTF-8 text.
   */
  PrmScan scan_prm(const std::string &text, const std::string &file);

  /** The same of a text put together from several files, of which the last one that sets
   * a key counts; a file by itself may set it only once. */
  PrmScan scan_prm(const PrmText &text);

  /** A text as it may stand in a message: at most 60 characters and nothing unprintable.
   */
  std::string quotable(const std::string &text);

  /** `key 'KEY' in subsection 'PATH'`, or `key 'KEY' at the top level`. */
  std::string name_of_key(const std::string &subsection, const std::string &key);

  /** The path of the subsection that holds another one; empty at the top level. */
  std::string parent_subsection(const std::string &path);

  /** The parts of a text between separators, each without blanks around it. */
  std::vector<std::string> split_list(const std::string &text, char separator);

  /** A text without blanks at its ends. */
  std::string trimmed(const std::string &text);
} // namespace meltfront::cases

#endif
