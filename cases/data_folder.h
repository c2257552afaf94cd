#ifndef meltfront_cases_data_folder_h
#define meltfront_cases_data_folder_h

#include <string>

namespace meltfront::cases
{
  /**
   * Where the files stand that are read at run time: the library of cases, printed
   * tables, matrices, pages of the manual, figures of committed runs. Below it are the
   * folders of the source tree. It is found from where the shared library of the cases
   * is, `../../share/meltfront`, so that an installed meltfront may be moved as a whole.
   * @throws OutputError if there is no such folder
   */
  const std::string &data_folder();

  /** A file or folder in data_folder(). @param path `cases/library` */
  std::string data_path(const std::string &path);

  /** How a user calls the program: `./meltfront` in a clone, whose script stands in the
   * data folder; `meltfront` where it is installed. */
  std::string program_call();
} // namespace meltfront::cases

#endif
