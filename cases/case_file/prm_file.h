#ifndef meltfront_cases_case_file_prm_file_h
#define meltfront_cases_case_file_prm_file_h

#include <cases/case_file/prm_constants.h>
#include <cases/case_file/prm_scan.h>
#include <cases/error.h>

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace meltfront::cases
{
  /** What a key of a parameter file holds. */
  enum class PrmKind
  {
    number,
    integer,
    boolean, ///< true or false
    word,    ///< one of PrmEntry::choices
    numbers, ///< one to most_values numbers, separated by commas
    text,
    file ///< the name of a text file, which becomes part of the parameter file's text
  };

  /** A key of a parameter file, declared once and self-describing. */
  struct PrmEntry
  {
    std::string key;
    PrmKind kind = PrmKind::text;
    std::string default_value; ///< empty for a number: there is none, the key must be set
    /** SI unit, or two: `W or W/m`; empty for a pure number and a word. A text that has
     * one is an expression, or such in a list. */
    std::string unit;
    std::string description; ///< one sentence
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    std::vector<std::string> choices{};
    unsigned int most_values = 3; ///< of PrmKind::numbers: 2 to 8
    /** Of an expression in whose place a table may stand: the unit of what the table is
     * over, `s` or that of temperatures; empty for others. */
    std::string table_over{};
    bool formula = false; ///< of a text without unit: an expression all the same
  };

  /** A key as it is declared, for pages that explain it. */
  struct PrmKey
  {
    std::string subsection, key;
    std::string needs; ///< in words: `a number greater than 0 (m)`
    std::string default_value, description;
    int count = 0; ///< of a numbered key, 0 otherwise
  };

  /** Lower bound of a number that must be greater than zero. */
  inline constexpr double above_zero = std::numeric_limits<double>::min();

  /** The subsection of constants, PrmFile::allow_constants(). */
  inline const std::string constant_keys = "Constants";

  /**
   * A parameter file (deal.II's format): keys are declared, the file is read, values are
   * asked for. Subsections are named by their path from the top, `Scene/Material`; the
   * empty path is the top level.
   *
   * Everything that can be wrong with a file gives one sentence
   * `FILE:LINE: key 'X' in subsection 'Y' ...` that names the nearest valid key or value.
   */
  class PrmFile
  {
  public:
    /** @param library is the folder in which included files are searched that do not
     * stand beside the file that includes them. */
    explicit PrmFile(std::string library = {});
    ~PrmFile();
    PrmFile(PrmFile &&) noexcept;
    PrmFile &operator=(PrmFile &&) noexcept;

    /** Declare a key. */
    void declare(const std::string &subsection, const PrmEntry &entry);

    /** Declare the keys `KEY 1` ... `KEY count`. */
    void declare_numbered(const std::string &subsection, const PrmEntry &entry,
                          int count);

    /** Declare the keys `KEY 1` ... `KEY count` of every subsection of one, whatever its
     * name, or with count 0 the key itself; `shown_name` stands for the name in the
     * reference. */
    void declare_in_each(const std::string &subsection, const std::string &shown_name,
                         const PrmEntry &entry, int count);

    /**
     * Read a file.
     * @throws OutputError if it cannot be read, InputError if something in it is wrong.
     */
    void read(const std::string &path);

    /** Read a text; `file` is its name in messages. @throws InputError */
    void read_text(const std::string &text, const std::string &file);

    /** The file's text by itself: what it includes and the files that its keys name stand
     * in it, and what is set anew later is a comment. */
    const std::string &text() const;

    /** Whether the file sets the key. */
    bool given(const std::string &subsection, const std::string &key) const;

    /** A key whose value has a unit in the file, as messages name it, with that unit;
     * empty if none has. Values are in SI units whatever the file has. */
    std::string key_with_unit() const;

    /** Whether the file opens the subsection. */
    bool opened(const std::string &subsection) const;

    /** Names of the subsections of one that the file opens, sorted. */
    std::vector<std::string> subsections_of(const std::string &subsection) const;

    /** @throws InputError if the key has no default and the file does not set it. */
    double get_number(const std::string &subsection, const std::string &key) const;
    long get_integer(const std::string &subsection, const std::string &key) const;
    bool get_boolean(const std::string &subsection, const std::string &key) const;
    std::string get_text(const std::string &subsection, const std::string &key) const;
    std::vector<double> get_numbers(const std::string &subsection,
                                    const std::string &key) const;

    /** The text of the file that a key of PrmKind::file names: as it stands in this
     * file's text if it does, else that beside the file in which the key is set, or in
     * the library. */
    const std::string &attached(const std::string &subsection,
                                const std::string &key) const;

    /** Numbers of the keys `KEY 1`, `KEY 2`, ... that the file sets, ascending. */
    std::vector<int> given_numbers(const std::string &subsection,
                                   const std::string &key) const;

    /** @throws InputError unless the file sets the key: `... is missing: REASON`. */
    void require(const std::string &subsection, const std::string &key,
                 const std::string &reason) const;

    /** @throws InputError if the file sets the key: `... has no meaning here: REASON`. */
    void forbid(const std::string &subsection, const std::string &key,
                const std::string &reason) const;

    /** The sentence `FILE:LINE: key 'X' in subsection 'Y' PROBLEM`. */
    InputError error(const std::string &subsection, const std::string &key,
                     const std::string &problem) const;

    /** The sentence `FILE:LINE: subsection 'Y' PROBLEM`. */
    InputError subsection_error(const std::string &subsection,
                                const std::string &problem) const;

    /** Let files name numbers in subsection `Constants` (PrmConstants), for the values of
     * keys that hold numbers or expressions. */
    void allow_constants();

    /** All declared keys, in their order. */
    std::vector<PrmKey> declarations() const;

    /** All declared keys with unit, default and sentence, as a commented file. */
    std::string reference() const;

  private:
    struct Declared
    {
      std::string subsection;
      PrmEntry entry;
      int count = 0; ///< of a numbered key, 0 otherwise
    };

    /** Keys of every subsection of one. */
    struct InEach
    {
      std::string subsection;
      std::string shown_name;
      PrmEntry entry;
      int count;
    };

    /** The number that a value, or one of a list, is.
     * @throws InputError for those too small to be computed with */
    double number_in(const std::string &text, const std::string &subsection,
                     const std::string &key) const;

    void declare_opened();
    void read_constants();
    void put_constants_in(const PrmEntry &entry, PrmAssignment &assignment);
    void put_table_in(const PrmEntry &entry, PrmAssignment &assignment);
    void note_unit(const std::string &unit, const PrmAssignment &assignment);
    void check_constants() const;
    void comment_out_overridden();
    void attach(const PrmAssignment &assignment);
    const PrmEntry &declaration(const std::string &subsection,
                                const std::string &key) const;
    const PrmAssignment *assignment(const std::string &subsection,
                                    const std::string &key) const;
    void check_subsections() const;
    const PrmEntry &entry_of(const PrmAssignment &assignment) const;
    void take_units_off(const PrmEntry &entry, PrmAssignment &assignment);
    void check_assignment(const PrmEntry &entry, const PrmAssignment &assignment) const;
    [[noreturn]] void fail_unknown_key(const PrmAssignment &assignment) const;
    std::string value(const std::string &subsection, const std::string &key) const;

    std::unique_ptr<dealii::ParameterHandler> handler;
    std::vector<Declared> declared; ///< numbered keys once
    std::vector<Declared> keys;     ///< numbered keys one by one
    std::vector<InEach> in_each;
    std::string library;
    bool with_constants = false;
    PrmConstants constants;
    PrmText source;
    PrmScan scan;
    std::map<std::string, std::string> attachments; ///< texts by name
    std::string with_unit;                          ///< see key_with_unit()
    std::string temperature_scale; ///< that a temperature has behind it; empty: none
  };
} // namespace meltfront::cases

#endif
