#include <verification/record/json_values.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    Cell cell(const json &value, const char *format)
    {
      return {value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>())
                                : std::string("-")};
    }

    constexpr std::pair<const char *, const char *> quantities[]
        = {{"front", "front at the end (m)"},
           {"front_over_time", "front, RMS over time (m)"},
           {"solid_volume", "solid volume at the end"},
           {"temperature", "temperature at the end, RMS (K)"}};

    RowGroup group_of(const json &row)
    {
      RowGroup group;
      group.label = row.at("effect").get<std::string>();
      if(row.contains("refused"))
      {
        group.rows.push_back({{"refused: " + row.at("refused").get<std::string>()},
                              {""},
                              {""},
                              {""},
                              {""}});
        return group;
      }
      for(const auto &[name, words] : quantities)
        if(const json &change = row.at("changes").at(name);
           change.at("change").is_number())
          group.rows.push_back({{words},
                                cell(change.at("change"), "{:.3g}"),
                                cell(change.at("bar"), "{:.1g}"),
                                cell(change.at("in_bars"), "{:.3g}"),
                                cell(change.at("bound"), "{:.2g}")});
      group.summary.push_back({{fmt::format("saves {:.2g} s and {:.0f} bytes",
                                            row.at("seconds_saved").get<double>(),
                                            row.at("bytes_saved").get<double>())},
                               {""},
                               {""},
                               {""},
                               {""}});
      return group;
    }
  } // namespace

  Markup ablation_chapter(const ReportContext &context)
  {
    const std::string file = context.directory + "/ablate.json";
    if(!std::filesystem::exists(file))
      return {};
    const json ablation = read_json(file);
    Table table;
    table.caption = fmt::format("{} by {} at n = {}: what changes without each effect.",
                                ablation.at("case").get<std::string>(),
                                ablation.at("method").get<std::string>(),
                                ablation.at("n").back().get<int>());
    table.group_heading = "without";
    table.columns = {{"quantity", "", false},
                     {"change", "", false},
                     {"error of the change", "", false},
                     {"in error bars", "", false},
                     {"bound known before", "", false}};
    for(const json &row : ablation.at("effects"))
      table.groups.push_back(group_of(row));
    return element("h2", "Without each effect")
           + element("p",
                     "Each effect that is on, taken out alone. A change of less than "
                     "one error bar cannot be told from the numerical error at this "
                     "resolution; the bound was derived from the scene's data "
                     "before anything ran.")
           + table_markup(table);
  }
} // namespace meltfront::verification
