#ifndef meltfront_cases_option_binder_h
#define meltfront_cases_option_binder_h

#include <cases/options.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::cases
{
  /** The words for the values of an enumeration. */
  template <typename Value>
  using Words = std::vector<std::pair<std::string, Value>>;

  /** Words for an enumeration's values in their order. */
  template <typename Value>
  Words<Value> in_order(const std::vector<std::string> &names)
  {
    Words<Value> words;
    for(std::size_t i = 0; i < names.size(); ++i)
      words.emplace_back(names[i], static_cast<Value>(i));
    return words;
  }

  /** Words that stand for themselves. */
  Words<std::string> themselves(const std::vector<std::string> &names);

  /**
   * Declares options bound to the members that they fill, as deal.II's
   * ParameterHandler::add_parameter does: the calls that declare an option read it too,
   * and the member's value is its default. See options_of() and read_options().
   */
  class OptionBinder
  {
  public:
    void add(const std::string &key, bool &member, const std::string &description);
    void add(const std::string &key, std::string &member, const std::string &description);

    // Numbers within [lower, upper]:
    void add(const std::string &key, int &member, const std::string &description,
             double lower, double upper);
    void add(const std::string &key, long &member, const std::string &description,
             double lower, double upper);
    void add(const std::string &key, double &member, const std::string &description,
             double lower, double upper);

    /** One of several words, each of which stands for a value. */
    template <typename Value>
    void add(const std::string &key, Value &member, const std::string &description,
             const Words<Value> &words)
    {
      std::vector<std::string> choices;
      std::string chosen;
      for(const auto &[word, value] : words)
      {
        choices.push_back(word);
        if(value == member)
          chosen = word;
      }
      declared.push_back({key, "", chosen, description, 0, 0, choices});
      fillers.push_back(
          [&member, key, words](const Options &options)
          {
            const std::string &given = options.get_string(key);
            for(const auto &[word, value] : words)
              if(word == given)
                member = value;
          });
    }

    const std::vector<OptionDeclaration> &declarations() const
    {
      return declared;
    }

    /** Fill all members. */
    void read(const Options &options) const
    {
      for(const auto &fill : fillers)
        fill(options);
    }

  private:
    std::vector<OptionDeclaration> declared;
    std::vector<std::function<void(const Options &)>> fillers;
  };

  /** Options that a structure's bind(OptionBinder &) adds, with its members' values as
   * defaults. */
  template <typename Structure>
  std::vector<OptionDeclaration> options_of(Structure defaults)
  {
    OptionBinder binder;
    defaults.bind(binder);
    return binder.declarations();
  }

  /** A structure with its bound members filled from options. */
  template <typename Structure>
  Structure read_options(Structure structure, const Options &options)
  {
    OptionBinder binder;
    structure.bind(binder);
    binder.read(options);
    return structure;
  }
} // namespace meltfront::cases

#endif
