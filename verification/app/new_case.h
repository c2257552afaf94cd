#ifndef meltfront_verification_app_new_case_h
#define meltfront_verification_app_new_case_h

#include <string>

namespace meltfront::verification
{
  struct NewCaseArguments
  {
    std::string name; ///< of the case, or the file's path; the ending is added
    std::string like; ///< case to begin with; empty: a slab that explains its keys
  };

  /** Write a case file to begin with: that of another case without its acceptance
   * criteria, or a commented slab. It needs no other file.
   * @throws cases::InputError if the file is there already
   * @throws cases::OutputError if it cannot be written */
  int new_case(const NewCaseArguments &arguments);
} // namespace meltfront::verification

#endif
