#ifndef meltfront_cases_case_file_prm_lines_h
#define meltfront_cases_case_file_prm_lines_h

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** The lines of a text without their ends, LF or CRLF. */
  std::vector<std::string> lines_of(const std::string &text);

  /** Lines as a text, each with LF at its end. */
  std::string joined(const std::vector<std::string> &lines);

  /** Put another statement in place of the one that begins on a line (counted from 0);
   * the lines on which that went on by a backslash are left empty, so that all others
   * keep their numbers. */
  void replace_statement(std::vector<std::string> &lines, std::size_t first,
                         const std::string &statement);
} // namespace meltfront::cases

#endif
