#ifndef meltfront_cases_case_file_prm_attachment_h
#define meltfront_cases_case_file_prm_attachment_h

#include <optional>
#include <string>

namespace meltfront::cases
{
  /**
   * A text as comments of a parameter file, with its name: so a case that is stored holds
   * the files that it needs.
   *
   *     #@ file body.msh
   *     #|$MeshFormat
   *     ...
   */
  std::string attachment(const std::string &name, const std::string &text);

  /** The text that a parameter file's text holds under a name, if it does. */
  std::optional<std::string> attachment_in(const std::string &text,
                                           const std::string &name);

  /** A parameter file's text with the names of what it holds so, but not the texts. */
  std::string without_attachments(const std::string &text);

  /** The text of a file that is to be held so. @throws OutputError if it cannot be read,
   * InputError, with file and line, if it is larger than 64 MB or no UTF-8 text */
  std::string read_attachment(const std::string &path);
} // namespace meltfront::cases

#endif
