#ifndef meltfront_cases_case_file_vary_case_h
#define meltfront_cases_case_file_vary_case_h

#include <cases/case.h>

#include <string>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  /** Keys of a case file with their subsections, `Scene/Material/latent heat`, and the
   * values that they get. */
  using CaseSettings = std::vector<std::pair<std::string, std::string>>;

  /**
   * The text of a case file in which some keys have other values: in place where the text
   * sets them, so that lines keep their numbers, and at the end where it does not.
   *
   * @param file is the text's name in messages
   * @throws InputError as scan_prm() does
   */
  std::string varied_text(const std::string &text, const std::string &file,
                          const CaseSettings &settings);

  /** The text of a case file without its acceptance criteria and printed values, of which
   * the first lines are left as comments: those are figures of the case as it is written.
   */
  std::string text_without_figures(const std::string &text, const std::string &file);

  /**
   * Read a case from a text that varied_text() gave, under a name of its own. Acceptance
   * criteria and printed values are those of the case as it is written, and are left out.
   *
   * @throws InputError, with the line in the varied text, for a key that there is not and
   * for a value that does not suit it or makes no sense in the case.
   */
  Case read_varied_text(const std::string &text, const std::string &name);

  /** The same from the case and the other values of some keys. */
  Case vary_case(const Case &base, const std::string &name, const CaseSettings &settings);
} // namespace meltfront::cases

#endif
