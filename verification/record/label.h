#ifndef meltfront_verification_record_label_h
#define meltfront_verification_record_label_h

#include <cases/method.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /** Finds a method by name. @throws InputError */
  using MethodLookup = std::function<const cases::Method &(const std::string &name)>;

  /** The method of a label: what stands before the first `[`, without blanks around it.
   */
  std::string method_of(const std::string &label);

  /** The options in the brackets of a label, by key and value, as written. */
  std::vector<std::pair<std::string, std::string>> options_of(const std::string &label);

  /**
   * The same label as run_label() writes it, options sorted by their keys and without
   * blanks: `fem-fitted[degree=2,time_scheme=bdf3]` for `fem-fitted [ scheme = bdf3,
   * degree=2
   * ]`. Labels mean the same runs if these are equal.
   */
  std::string canonical_label(const std::string &label);

  /** The value of an option in a label that stands for any value. */
  inline constexpr const char *any_value = "*";

  /** Whether a label is one that a pattern means: the same method and options, each with
   * the same value, with any_value in the pattern, or with one of several, `a|b`. */
  bool label_matches(const std::string &pattern, const std::string &label);

  /** Whether the name of a case stands for a family: it has a `*`. */
  bool is_family(const std::string &name);

  /** Whether a case belongs to a family, in whose name each `*` stands for any text,
   * none too: `line-sink-lambda-*`. */
  bool in_family(const std::string &family, const std::string &name);

  /**
   * Hold a label or a pattern that a user wrote against what there is.
   * @throws InputError for an unknown method, option or value, and brackets that do not
   * hold KEY=VALUE with commas.
   */
  void check_label(const std::string &label, const MethodLookup &methods);
} // namespace meltfront::verification

#endif
