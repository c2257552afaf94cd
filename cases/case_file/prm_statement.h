#ifndef meltfront_cases_case_file_prm_statement_h
#define meltfront_cases_case_file_prm_statement_h

#include <optional>
#include <string>
#include <vector>

namespace meltfront::cases
{
  /** A statement of a parameter file without comment, its continuation lines joined. */
  struct PrmStatement
  {
    std::string text;
    int line = 0; ///< on which it begins
    int last_line = 0;
  };

  /** The statements of a text, empty ones too. @throws InputError for bytes that are not
   * UTF-8 text. */
  std::vector<PrmStatement> prm_statements(const std::string &text,
                                           const std::string &file);

  /** What follows a word and a blank at the start of a statement. */
  std::optional<std::string> after_word(const std::string &statement,
                                        const std::string &word);

  /** Bytes of the UTF-8 character at a position; 0 where there is none. */
  std::size_t character_size(const std::string &text, std::size_t at);
} // namespace meltfront::cases

#endif
