#include <cases/case_file/case_file.h>
#include <cases/case_file/vary_case.h>
#include <cases/error.h>
#include <verification/app/case_settings.h>
#include <verification/record/json_values.h>
#include <verification/report/plots/plot_folder.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace meltfront::verification
{
  namespace
  {
    /** Of a setting, as a part of a file's name: the last two words of its key and its
     * value. */
    std::string name_of(const std::string &key, const std::string &value)
    {
      const std::size_t last = key.rfind('/');
      const std::size_t before
          = last == std::string::npos || last == 0 ? last : key.rfind('/', last - 1);
      std::string name = "-";
      for(const char c :
          (before == std::string::npos ? key : key.substr(before + 1)) + "-" + value)
        if(std::isalnum(static_cast<unsigned char>(c)) || c == '.')
          name += c;
        else if(name.back() != '-')
          name += '-';
      return name;
    }

    std::pair<std::string, std::string> split(const std::string &setting)
    {
      const std::size_t equals = setting.find('=');
      return {setting.substr(0, equals), setting.substr(equals + 1)};
    }
  } // namespace

  Settings sort_settings(const std::vector<std::string> &settings)
  {
    Settings sorted;
    for(const std::string &setting : settings)
    {
      const std::size_t equals = setting.find('=');
      if(equals == std::string::npos || equals == 0)
        throw cases::InputError(fmt::format(
            "--set needs METHOD.KEY=VALUE or, of the case, SUBSECTION/KEY=VALUE, not "
            "'{}'",
            setting));
      const bool option = setting.find('.') < equals;
      (option ? sorted.of_method : sorted.of_case).push_back(setting);
    }
    return sorted;
  }

  std::vector<std::string> settings_of_case(const std::vector<std::string> &settings)
  {
    Settings sorted = sort_settings(settings);
    if(!sorted.of_method.empty())
      throw cases::InputError(fmt::format(
          "--set {}: this command chooses the methods' options itself; keys of "
          "the case are set as SUBSECTION/KEY=VALUE",
          sorted.of_method.front()));
    return sorted.of_case;
  }

  std::string
  varied_case(const std::string &case_name, const std::vector<std::string> &settings,
              const std::function<std::string(const std::string &)> &directory_of)
  {
    if(settings.empty())
      return case_name;
    constexpr std::size_t longest_name = 120;
    const cases::Case base = cases::load_case(case_name);
    cases::CaseSettings values;
    std::string name = base.scene.name;
    for(const std::string &setting : settings)
    {
      values.push_back(split(setting));
      name += name_of(values.back().first, values.back().second);
    }
    name.resize(std::min(name.size(), longest_name));
    // Whatever is wrong with the settings is said before a file is written.
    const cases::Case varied = cases::vary_case(base, name, values);
    const std::string directory = directory_of(name);
    make_directory(directory);
    const std::string path = directory + "/" + name + ".prm";
    write_atomically(path, cases::text_without_figures(varied.text, path));
    return path;
  }
} // namespace meltfront::verification
