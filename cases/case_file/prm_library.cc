#include <cases/case_file/prm_library.h>
#include <cases/case_file/prm_scan.h>
#include <cases/error.h>
#include <cases/options.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace meltfront::cases
{
  std::vector<std::string> PrmLibrary::names() const
  {
    std::vector<std::string> names;
    std::error_code failure;
    for(const auto &entry : std::filesystem::directory_iterator(folder, failure))
      if(entry.path().extension() == ".prm")
        names.push_back(entry.path().stem().string());
    if(failure)
      throw OutputError(
          fmt::format("{}: the library of {} files cannot be read", folder, what));
    std::ranges::sort(names);
    return names;
  }

  std::string PrmLibrary::path(const std::string &name) const
  {
    return fmt::format("{}/{}.prm", folder, name);
  }

  std::string PrmLibrary::find(const std::string &name_or_path) const
  {
    if(name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".prm"))
      return name_or_path;
    const std::vector<std::string> known = names();
    if(std::ranges::find(known, name_or_path) == known.end())
      throw InputError(fmt::format("there is no {} '{}'; the nearest is '{}'", what,
                                   quotable(name_or_path),
                                   nearest_name(name_or_path.substr(0, 200), known)));
    return path(name_or_path);
  }
} // namespace meltfront::cases
