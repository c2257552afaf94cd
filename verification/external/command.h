#ifndef meltfront_verification_external_command_h
#define meltfront_verification_external_command_h

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace meltfront::verification::external
{
  /**
   * A command's words: what blanks divide. Single or double quotes keep blanks together
   * and vanish; no other character means anything. There is no shell: nothing expands,
   * redirects or starts a second program.
   * @throws cases::InputError for a quote without an end, and for no word at all
   */
  std::vector<std::string> words_of(const std::string &command);

  /** Whether a word of the command takes the answer's file by name, {answer}. */
  bool names_answer(const std::vector<std::string> &words);

  /** Words with {folder} replaced by the folder of the manifest. */
  std::vector<std::string> with_folder(std::vector<std::string> words,
                                       const std::string &folder);

  /**
   * Words with {request} and {answer} replaced by the names of the files under which the
   * program finds them, and {/scene/start_time/value}, a pointer into the request, by
   * what it points to, an array with commas: for programs that read no JSON. A pointer
   * to what need not be there tells what stands for it, {/a/b?none}. Other braces stay.
   * @throws cases::InputError for a pointer to nothing, or to what is no value
   */
  std::vector<std::string> filled_in(std::vector<std::string> words,
                                     const nlohmann::json &request);

  /** Path of a program that is given by path or found through PATH.
   * @throws cases::Refusal if there is none */
  std::string find_program(const std::string &word);
} // namespace meltfront::verification::external

#endif
