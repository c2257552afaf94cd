#include <cases/case_file/prm_attachment.h>
#include <cases/case_file/prm_entry.h>
#include <cases/case_file/prm_file.h>
#include <cases/case_file/prm_lines.h>
#include <cases/case_file/prm_statement.h>
#include <cases/case_file/prm_table.h>
#include <cases/case_file/value_units.h>
#include <cases/options.h>

#include <deal.II/base/parameter_handler.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace meltfront::cases
{
  namespace
  {
    /** Go down to a subsection of the handler and back up at the end of the scope. */
    class InSubsection
    {
    public:
      InSubsection(dealii::ParameterHandler &handler, const std::string &path)
        : handler(handler)
      {
        if(!path.empty())
          for(const std::string &name : split_list(path, '/'))
          {
            handler.enter_subsection(name);
            ++depth;
          }
      }

      ~InSubsection()
      {
        for(; depth > 0; --depth)
          handler.leave_subsection();
      }

      InSubsection(const InSubsection &) = delete;
      InSubsection &operator=(const InSubsection &) = delete;

    private:
      dealii::ParameterHandler &handler;
      int depth = 0;
    };
  } // namespace

  PrmFile::PrmFile(std::string library)
    : handler(std::make_unique<dealii::ParameterHandler>())
    , library(std::move(library))
  {
  }
  PrmFile::~PrmFile() = default;
  PrmFile::PrmFile(PrmFile &&) noexcept = default;
  PrmFile &PrmFile::operator=(PrmFile &&) noexcept = default;

  void PrmFile::declare(const std::string &subsection, const PrmEntry &entry)
  {
    const InSubsection here(*handler, subsection);
    handler->declare_entry(entry.key, acceptable_text(entry), *pattern(entry),
                           entry.description);
    declared.push_back({subsection, entry});
    keys.push_back({subsection, entry});
  }

  void PrmFile::declare_numbered(const std::string &subsection, const PrmEntry &entry,
                                 int count)
  {
    const InSubsection here(*handler, subsection);
    for(int i = 1; i <= count; ++i)
    {
      PrmEntry numbered = entry;
      numbered.key = fmt::format("{} {}", entry.key, i);
      handler->declare_entry(numbered.key, acceptable_text(entry), *pattern(entry),
                             entry.description);
      keys.push_back({subsection, numbered});
    }
    declared.push_back({subsection, entry, count});
  }

  void PrmFile::declare_in_each(const std::string &subsection,
                                const std::string &shown_name, const PrmEntry &entry,
                                int count)
  {
    in_each.push_back({subsection, shown_name, entry, count});
  }

  void PrmFile::declare_opened()
  {
    for(const InEach &each : in_each)
      for(const std::string &name : subsections_of(each.subsection))
        if(each.count > 0)
          declare_numbered(each.subsection + "/" + name, each.entry, each.count);
        else
          declare(each.subsection + "/" + name, each.entry);
  }

  void PrmFile::read(const std::string &path)
  {
    read_text(read_prm_text(path), path);
  }

  void PrmFile::read_text(const std::string &text, const std::string &name)
  {
    source = expand_includes(text, name, library);
    scan = scan_prm(source);
    comment_out_overridden();
    declare_opened();
    check_subsections();
    read_constants();
    for(PrmAssignment &assignment : scan.assignments)
    {
      if(with_constants && assignment.subsection == constant_keys)
        continue;
      const PrmEntry &entry = entry_of(assignment);
      put_table_in(entry, assignment);
      put_constants_in(entry, assignment);
      take_units_off(entry, assignment);
      check_assignment(entry, assignment);
      if(entry.kind == PrmKind::file)
        attach(assignment);
      const InSubsection here(*handler, assignment.subsection);
      handler->set(assignment.key, assignment.value);
    }
    check_constants();
  }

  void PrmFile::allow_constants()
  {
    with_constants = true;
  }

  void PrmFile::read_constants()
  {
    for(const PrmAssignment &assignment : scan.assignments)
      if(with_constants && assignment.subsection == constant_keys)
        try
        {
          constants.set(assignment.key, assignment.value);
          if(const std::string unit = without_units(assignment.value).unit; !unit.empty())
            with_unit = fmt::format(
                "{} ({})", name_of_key(assignment.subsection, assignment.key), unit);
        }
        catch(const InputError &problem)
        {
          throw error(assignment.subsection, assignment.key, problem.what());
        }
  }

  void PrmFile::put_constants_in(const PrmEntry &entry, PrmAssignment &assignment)
  {
    const bool numbers = entry.kind == PrmKind::number || entry.kind == PrmKind::numbers
                         || entry.kind == PrmKind::integer;
    const bool expression
        = entry.kind == PrmKind::text && (entry.formula || !entry.unit.empty());
    if(!scan.subsections.contains(constant_keys) || !(numbers || expression))
      return;
    PlainFormula plain;
    try
    {
      plain = numbers ? constants.in_numbers(assignment.value)
                      : constants.in_expressions(assignment.value);
    }
    catch(const InputError &problem)
    {
      throw error(assignment.subsection, assignment.key, problem.what());
    }
    assignment.value = plain.text;
    for(const std::string &unit : plain.units)
      note_unit(unit, assignment);
  }

  void PrmFile::check_constants() const
  {
    // A name that was mistyped where it is set would change nothing, and say nothing.
    for(const std::string &name : constants.unused())
      throw error(constant_keys, name, "is a constant that nothing names");
  }

  void PrmFile::put_table_in(const PrmEntry &entry, PrmAssignment &assignment)
  {
    const auto words = after_word(assignment.value, "table");
    if(!words || entry.table_over.empty())
      return;
    PrmTable table;
    try
    {
      table = read_table(*words, source.path(assignment.line), library, entry);
    }
    catch(const InputError &problem)
    {
      throw error(assignment.subsection, assignment.key, problem.what());
    }
    for(const std::string &unit : table.units)
      note_unit(unit, assignment);
    assignment.value = table.points;
    std::vector<std::string> lines = lines_of(source.text);
    replace_statement(
        lines, static_cast<std::size_t>(assignment.line - 1),
        fmt::format("set {} = {} # {}", assignment.key, table.points, table.origin));
    source.text = joined(lines);
  }

  void PrmFile::note_unit(const std::string &unit, const PrmAssignment &assignment)
  {
    with_unit = fmt::format("{} ({})", name_of_key(assignment.subsection, assignment.key),
                            unit);
    if(!is_temperature_scale(unit))
      return;
    if(temperature_scale.empty())
      temperature_scale = unit;
    if(temperature_scale != unit)
      throw error(
          assignment.subsection, assignment.key,
          fmt::format("is in {}, and another temperature of this file is in {}: a "
                      "scene has one scale",
                      unit, temperature_scale));
  }

  void PrmFile::attach(const PrmAssignment &assignment)
  {
    namespace fs = std::filesystem;
    const std::string &name = assignment.value;
    if(attachments.contains(name))
      return;
    if(const auto found = attachment_in(source.text, name))
    {
      attachments[name] = *found;
      return;
    }
    const fs::path beside
        = fs::path(
              source.files[static_cast<std::size_t>(source.reading(assignment.line))])
              .parent_path();
    for(const fs::path &path : {beside / name, fs::path(library) / name})
      if(std::error_code failure; fs::is_regular_file(path, failure))
      {
        attachments[name] = read_attachment(path.string());
        source.text += attachment(name, attachments[name]);
        return;
      }
    throw error(
        assignment.subsection, assignment.key,
        fmt::format("names the file '{}', which is neither beside this file nor in "
                    "the library",
                    quotable(name)));
  }

  const std::string &PrmFile::attached(const std::string &subsection,
                                       const std::string &key) const
  {
    return attachments.at(get_text(subsection, key));
  }

  void PrmFile::comment_out_overridden()
  {
    if(scan.overridden.empty())
      return;
    std::string text;
    std::size_t begin = 0;
    for(int line = 1; begin < source.text.size(); ++line)
    {
      const std::size_t end = std::min(source.text.find('\n', begin), source.text.size());
      const bool counts
          = std::ranges::none_of(scan.overridden, [line](const auto &lines)
                                 { return line >= lines.first && line <= lines.second; });
      text += (counts ? "" : "# ") + source.text.substr(begin, end - begin) + "\n";
      begin = end + 1;
    }
    source.text = text;
  }

  const std::string &PrmFile::text() const
  {
    return source.text;
  }

  const PrmEntry &PrmFile::entry_of(const PrmAssignment &assignment) const
  {
    const auto found = std::find_if(keys.begin(), keys.end(),
                                    [&assignment](const Declared &key) {
                                      return key.subsection == assignment.subsection
                                             && key.entry.key == assignment.key;
                                    });
    if(found == keys.end())
      fail_unknown_key(assignment);
    return found->entry;
  }

  void PrmFile::take_units_off(const PrmEntry &entry, PrmAssignment &assignment)
  {
    const bool numbers = entry.kind == PrmKind::number || entry.kind == PrmKind::numbers
                         || (entry.kind == PrmKind::text && !entry.unit.empty());
    if(!numbers)
      return;
    const auto fail = [&](const std::string &problem)
    { return error(assignment.subsection, assignment.key, problem); };
    PlainValue plain;
    try
    {
      plain = in_units_of(assignment.value, entry.unit);
    }
    catch(const InputError &problem)
    {
      throw fail(problem.what());
    }
    if(plain.unit.empty())
      return;
    assignment.value = plain.text;
    note_unit(plain.unit, assignment);
  }

  std::string PrmFile::key_with_unit() const
  {
    return with_unit;
  }

  const PrmEntry &PrmFile::declaration(const std::string &subsection,
                                       const std::string &key) const
  {
    for(const Declared &candidate : keys)
      if(candidate.subsection == subsection && candidate.entry.key == key)
        return candidate.entry;
    throw std::logic_error(
        fmt::format("{} is not declared", name_of_key(subsection, key)));
  }

  const PrmAssignment *PrmFile::assignment(const std::string &subsection,
                                           const std::string &key) const
  {
    for(const PrmAssignment &candidate : scan.assignments)
      if(candidate.subsection == subsection && candidate.key == key)
        return &candidate;
    return nullptr;
  }

  bool PrmFile::given(const std::string &subsection, const std::string &key) const
  {
    return assignment(subsection, key) != nullptr;
  }

  bool PrmFile::opened(const std::string &subsection) const
  {
    return scan.subsections.contains(subsection);
  }

  std::vector<std::string> PrmFile::subsections_of(const std::string &subsection) const
  {
    std::vector<std::string> names;
    for(const auto &[path, line] : scan.subsections)
      if(path.rfind('/') != std::string::npos && parent_subsection(path) == subsection)
        names.push_back(path.substr(subsection.size() + 1));
    return names;
  }

  std::string PrmFile::value(const std::string &subsection, const std::string &key) const
  {
    const PrmEntry &entry = declaration(subsection, key);
    if(entry.default_value.empty() && entry.kind != PrmKind::text)
      require(subsection, key, fmt::format("it needs {}", expectation(entry)));
    const InSubsection here(*handler, subsection);
    return handler->get(key);
  }

  std::vector<PrmKey> PrmFile::declarations() const
  {
    std::vector<Declared> all = declared;
    for(const InEach &each : in_each)
      all.push_back({each.subsection + "/" + each.shown_name, each.entry, each.count});
    std::vector<PrmKey> result;
    for(const Declared &key : all)
      result.push_back({key.subsection, key.entry.key, expectation(key.entry),
                        key.entry.default_value, key.entry.description, key.count});
    return result;
  }

  std::string PrmFile::reference() const
  {
    std::string text = "# include FILE: the lines of FILE stand here; it is searched "
                       "beside this file, then in the library.\n";
    if(with_constants)
      text += fmt::format("\nsubsection {}\n  # Any name: a number, also with a unit, or "
                          "a formula of the names before it. Values of keys name it.\n  "
                          "set NAME = NUMBER\n",
                          constant_keys);
    std::string current;
    for(const PrmKey &key : declarations())
    {
      if(key.subsection != current)
        text += fmt::format("\nsubsection {}\n", key.subsection);
      current = key.subsection;
      text += fmt::format("  # {} It needs {}.\n", key.description, key.needs);
      text += fmt::format("  set {}{} = {}\n", key.key,
                          key.count == 0 ? std::string()
                                         : fmt::format(" 1 .. {}", key.count),
                          key.default_value);
    }
    return text;
  }
} // namespace meltfront::cases
