#include <cases/option_binder.h>

namespace meltfront::cases
{
  Words<std::string> themselves(const std::vector<std::string> &names)
  {
    Words<std::string> words;
    for(const std::string &name : names)
      words.emplace_back(name, name);
    return words;
  }

  void OptionBinder::add(const std::string &key, bool &member,
                         const std::string &description)
  {
    declared.push_back({key, "", member, description});
    fillers.push_back([&member, key](const Options &options)
                      { member = options.get_bool(key); });
  }

  void OptionBinder::add(const std::string &key, std::string &member,
                         const std::string &description)
  {
    declared.push_back({key, "", member, description});
    fillers.push_back([&member, key](const Options &options)
                      { member = options.get_string(key); });
  }

  void OptionBinder::add(const std::string &key, int &member,
                         const std::string &description, double lower, double upper)
  {
    declared.push_back({key, "1", long{member}, description, lower, upper});
    fillers.push_back([&member, key](const Options &options)
                      { member = static_cast<int>(options.get_integer(key)); });
  }

  void OptionBinder::add(const std::string &key, long &member,
                         const std::string &description, double lower, double upper)
  {
    declared.push_back({key, "1", member, description, lower, upper});
    fillers.push_back([&member, key](const Options &options)
                      { member = options.get_integer(key); });
  }

  void OptionBinder::add(const std::string &key, double &member,
                         const std::string &description, double lower, double upper)
  {
    declared.push_back({key, "1", member, description, lower, upper});
    fillers.push_back([&member, key](const Options &options)
                      { member = options.get_double(key); });
  }
} // namespace meltfront::cases
