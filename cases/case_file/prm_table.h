#ifndef meltfront_cases_case_file_prm_table_h
#define meltfront_cases_case_file_prm_table_h

#include <cases/case_file/prm_file.h>

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** A table of a CSV file as a key's value. */
  struct PrmTable
  {
    std::string points;             ///< `a: b, c: d`, in SI units
    std::vector<std::string> units; ///< that the header names
    std::string origin;             ///< a few words on where it is from
  };

  /**
   * Read the table that a value `table FILE`, or `table FILE column NAME`, names.
   *
   * The first line of the file names the columns, each with its unit, `time (h)`, and
   * `(1)` for a pure number or in normalised scenes; the first column is what the table
   * is over and ascends. Columns are separated by commas, semicolons or tabs; empty lines
   * and those that begin with `#` are left out. Without NAME there are two columns.
   *
   * @param words behind `table`
   * @param beside the file that names it: FILE is searched beside that, in the directory
   * in which the program was started, then in the library
   * @param entry of the key, which tells the units of both columns
   * @throws InputError, a clause that follows the key's name, with the line of what is
   * wrong in FILE
   */
  PrmTable read_table(const std::string &words, const std::string &beside,
                      const std::string &library, const PrmEntry &entry);
} // namespace meltfront::cases

#endif
