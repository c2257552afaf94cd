#ifndef meltfront_cases_options_h
#define meltfront_cases_options_h

#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace meltfront::cases
{
  using OptionValue = std::variant<bool, long, double, std::string>;

  /**
   * One option of a method, declared once and self-describing: matrix files, `--set
   * METHOD.KEY=VALUE` and `meltfront list methods` all come from the declaration.
   */
  struct OptionDeclaration
  {
    std::string key;
    std::string unit; ///< SI unit, `1` for a number, empty for a word or a switch
    OptionValue default_value;
    std::string description; ///< one sentence
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    std::vector<std::string> choices{}; ///< the words allowed, for a string
  };

  /** Values of a method's options: the declared defaults, overridden key by key. */
  class Options
  {
  public:
    Options() = default;

    explicit Options(std::vector<OptionDeclaration> declarations);

    /**
     * Set a value from text.
     * @throws InputError for an unknown key (names the nearest one), a value that cannot
     * be read as the option's type, outside its range or not among its choices.
     */
    void set(const std::string &key, const std::string &text);

    bool get_bool(const std::string &key) const;
    long get_integer(const std::string &key) const;
    double get_double(const std::string &key) const;
    const std::string &get_string(const std::string &key) const;

    /** All values as text, by key: what a run record stores. */
    std::map<std::string, std::string> values() const;

    const std::vector<OptionDeclaration> &declarations() const;

  private:
    const OptionDeclaration &declaration(const std::string &key) const;
    const OptionValue &value(const std::string &key) const;

    std::vector<OptionDeclaration> declared;
    std::map<std::string, OptionValue> overridden;
  };

  /** An option's value as text that Options::set reads back to the same value. */
  std::string to_text(const OptionValue &value);

  /** The candidate with the least edit distance to a word; empty when there is none. */
  std::string nearest_name(const std::string &word,
                           const std::vector<std::string> &candidates);
} // namespace meltfront::cases

#endif
