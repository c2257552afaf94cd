#ifndef meltfront_cases_case_file_prm_library_h
#define meltfront_cases_case_file_prm_library_h

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** A folder of parameter files, each named by its file's name without the ending. */
  struct PrmLibrary
  {
    std::string folder;
    std::string what; ///< one of them: `case`

    /** All names, sorted. @throws OutputError if the folder cannot be read */
    std::vector<std::string> names() const;

    std::string path(const std::string &name) const;

    /** The path of a name; what has a slash or the ending is a path.
     * @throws InputError naming the nearest where there is none of that name */
    std::string find(const std::string &name_or_path) const;
  };
} // namespace meltfront::cases

#endif
