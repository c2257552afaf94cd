#include <cases/case_file/prm_entry.h>
#include <cases/case_file/prm_file.h>
#include <cases/options.h>

#include <deal.II/base/patterns.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::cases
{
  void PrmFile::check_subsections() const
  {
    std::map<std::string, std::vector<std::string>> children;
    for(const Declared &key : keys)
      for(std::string path = key.subsection; !path.empty();
          path = parent_subsection(path))
        children[parent_subsection(path)].push_back(path);
    for(const InEach &each : in_each)
      children[parent_subsection(each.subsection)].push_back(each.subsection);
    if(with_constants)
      children[""].push_back(constant_keys);
    // A parent is ordered before its children, so that the outermost mistake is named.
    for(const auto &[path, line] : scan.subsections)
    {
      const auto &valid = children[parent_subsection(path)];
      if(std::find(valid.begin(), valid.end(), path) != valid.end())
        continue;
      const std::string where
          = parent_subsection(path).empty()
                ? std::string("at the top level")
                : fmt::format("in subsection '{}'", quotable(parent_subsection(path)));
      const std::string advice
          = valid.empty() ? std::string("there is none to be opened there")
                          : fmt::format("the nearest valid subsection is '{}'",
                                        nearest_name(path.substr(0, 200), valid));
      throw InputError(fmt::format("{}: subsection '{}' is unknown {}; {}",
                                   source.place(line), quotable(path), where, advice));
    }
  }

  void PrmFile::fail_unknown_key(const PrmAssignment &assignment) const
  {
    std::vector<std::string> here;
    std::vector<std::string> elsewhere;
    for(const Declared &key : keys)
    {
      if(key.subsection == assignment.subsection)
        here.push_back(key.entry.key);
      else if(key.entry.key == assignment.key)
        elsewhere.push_back(key.subsection);
    }
    std::string advice;
    if(!elsewhere.empty())
      advice = elsewhere.front().empty()
                   ? "it belongs to the top level"
                   : fmt::format("it belongs to subsection '{}'",
                                 nearest_name(assignment.subsection, elsewhere));
    else if(!here.empty())
      advice = fmt::format("the nearest valid key is '{}'",
                           nearest_name(assignment.key.substr(0, 200), here));
    else
      advice = "this subsection holds no keys, only subsections";
    throw error(assignment.subsection, assignment.key, "is unknown; " + advice);
  }

  void PrmFile::check_assignment(const PrmEntry &entry,
                                 const PrmAssignment &assignment) const
  {
    if(pattern(entry)->match(assignment.value))
      return;
    const std::string advice
        = entry.kind == PrmKind::word
              ? fmt::format("; the nearest is '{}'",
                            nearest_name(assignment.value.substr(0, 200), entry.choices))
              : std::string();
    throw error(assignment.subsection, assignment.key,
                fmt::format("needs {}, not '{}'{}", expectation(entry),
                            quotable(assignment.value), advice));
  }

  void PrmFile::require(const std::string &subsection, const std::string &key,
                        const std::string &reason) const
  {
    if(!given(subsection, key))
      throw error(subsection, key, "is missing: " + reason);
  }

  void PrmFile::forbid(const std::string &subsection, const std::string &key,
                       const std::string &reason) const
  {
    if(given(subsection, key))
      throw error(subsection, key, "has no meaning here: " + reason);
  }

  InputError PrmFile::error(const std::string &subsection, const std::string &key,
                            const std::string &problem) const
  {
    int line = 1;
    if(const PrmAssignment *found = assignment(subsection, key))
      line = found->line;
    else
      for(std::string path = subsection; !path.empty(); path = parent_subsection(path))
        if(const auto opening = scan.subsections.find(path);
           opening != scan.subsections.end())
        {
          line = opening->second;
          break;
        }
    return InputError(fmt::format("{}: {} {}", source.place(line),
                                  name_of_key(subsection, key), problem));
  }

  InputError PrmFile::subsection_error(const std::string &subsection,
                                       const std::string &problem) const
  {
    const auto opening = scan.subsections.find(subsection);
    const int line = opening == scan.subsections.end() ? 1 : opening->second;
    return InputError(fmt::format("{}: subsection '{}' {}", source.place(line),
                                  quotable(subsection), problem));
  }
} // namespace meltfront::cases
