#ifndef meltfront_cases_case_file_case_file_h
#define meltfront_cases_case_file_case_file_h

#include <cases/case.h>

#include <string>
#include <vector>

namespace meltfront::cases
{
  /**
   * Read a case file.
   * @throws InputError, one sentence with file, line and key, for anything wrong in it;
   * OutputError if it cannot be read.
   */
  Case read_case(const std::string &path);

  /** Read a case from a text; `file` is its name in messages, and names the scene. */
  Case read_case_text(const std::string &text, const std::string &file);

  /** Names of the library's cases, sorted. */
  std::vector<std::string> library_names();

  /** The title of a case of the library, without reading the rest of it. */
  std::string library_title(const std::string &name);

  /** The library's file for a case, whether it exists or not. */
  std::string library_path(const std::string &name);

  /**
   * A case of the library by its name, or any other by the path of its file (a path holds
   * a slash or ends in `.prm`).
   * @throws InputError naming the nearest case when there is none of that name.
   */
  Case load_case(const std::string &name_or_path);

  /** All keys of case files with unit, default and a sentence each. */
  std::string case_file_reference();
} // namespace meltfront::cases

#endif
