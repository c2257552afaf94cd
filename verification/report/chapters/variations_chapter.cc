#include <verification/report/chapters/chapters.h>
#include <verification/report/chapters/variation_group.h>
#include <verification/report/tables/convergence_table.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    /** The errors that the table of a group holds. */
    constexpr const char *errors[] = {"front_rms", "front_end", "temperature_l2"};

    std::set<int> resolutions(const VariationGroup &group, const std::string &label)
    {
      std::set<int> all;
      for(const Variation &variation : group.variations)
        if(const LabelRuns *runs = variation.runs->find(label))
          for(const Level &level : runs->levels)
            all.insert(level.n);
      return all;
    }

    const Level *level_at(const LabelRuns &runs, int n)
    {
      const auto found = std::ranges::find(runs.levels, n, &Level::n);
      return found == runs.levels.end() ? nullptr : &*found;
    }

    /** What the runs of a table noted, numbered; the notes stand below it. */
    class Notes
    {
    public:
      int number(const std::string &words)
      {
        const auto found = std::ranges::find(list, words);
        if(found != list.end())
          return static_cast<int>(found - list.begin()) + 1;
        list.push_back(words);
        return static_cast<int>(list.size());
      }

      Markup below() const
      {
        if(list.empty())
          return {};
        std::vector<Markup> items;
        for(const std::string &words : list)
          items.push_back(text(words));
        return element("p", {{"class", "nothing"}}, text("The runs noted, at these n:"))
               + verification::list("ol", items);
      }

    private:
      std::vector<std::string> list;
    };

    /** With blanks at which no line breaks, but behind a semicolon. */
    std::string kept_together(const std::string &words)
    {
      std::string result;
      for(const char letter : words)
        if(letter == ' ' && !result.ends_with(';'))
          result += "\u00a0";
        else
          result += letter;
      return result;
    }

    std::string notes_of(const LabelRuns &runs, Notes &notes)
    {
      std::string words;
      const auto add = [&words](const std::string &more)
      { words.append(words.empty() ? "" : "; ").append(more); };
      for(const RunWarning &warning : warnings_of(runs))
        add(fmt::format("({}) n = {}", notes.number(warning.words), warning.resolutions));
      for(const Level &level : runs.levels)
        if(level.status() != "finished")
          add(fmt::format("n = {} {}", level.n, level.status()));
      return kept_together(words);
    }

    std::vector<Cell> row_of(const VariationGroup &group, const Variation &variation,
                             const LabelRuns &runs, const std::set<int> &all_n,
                             Notes &notes)
    {
      const StoredCase &record = *variation.runs->record;
      std::vector<Cell> row;
      for(std::size_t i = 0; i < group.axes.size(); ++i)
        row.push_back({group.axes[i].values[variation.place[i]]});
      const RunRecord *finest = runs.finest();
      row.push_back(
          {number_text(finest ? front_peclet_number(record, *finest) : std::nan(""), 2,
                       Notation::scientific)});
      row.push_back({notes_of(runs, notes)});
      for(const char *error : errors)
      {
        for(const int n : all_n)
        {
          const Level *level = level_at(runs, n);
          row.push_back({number_text(level ? level->value(error) : std::nan(""), 2,
                                     Notation::scientific)});
        }
        row.push_back(
            {order_cell(order_of(record, runs, error), runs.refinement.symbol())});
      }
      return row;
    }

    /** All cases of a group by one label: what was varied, V h/alpha and what the runs
     * noted, errors at each n with their order. */
    Table table_of(const VariationGroup &group, const std::string &label, Notes &notes)
    {
      const std::set<int> all_n = resolutions(group, label);
      const StoredCase &first = *group.variations.front().runs->record;
      Table table;
      table.group_heading = "method";
      for(const VariationAxis &axis : group.axes)
        table.columns.push_back({axis.heading, "", false});
      table.columns.push_back({fmt::format("V h/α, n = {}", *all_n.rbegin()), "", true});
      table.columns.push_back({"notes", "", false});
      for(const char *error : errors)
      {
        const bool relative = std::string(error).starts_with("temperature");
        for(const int n : all_n)
          table.columns.push_back({fmt::format("{}, n = {}", quantity_heading(error), n),
                                   relative ? "" : unit_of(first, "m"), true});
        table.columns.push_back({"order", "", true});
      }
      RowGroup &rows = table.groups.emplace_back();
      rows.label = label;
      for(const Variation &variation : group.variations)
        if(const LabelRuns *runs = variation.runs->find(label))
          rows.rows.push_back(row_of(group, variation, *runs, all_n, notes));
      return table;
    }

    std::string csv_of(const VariationGroup &group)
    {
      std::string csv = "case";
      for(const VariationAxis &axis : group.axes)
        csv.append(",").append(csv_field(axis.heading));
      csv += ",method,n,h,dt";
      for(const char *error : errors)
        csv += fmt::format(",{}", error);
      csv += ",V h/alpha,cpu_seconds,status,warnings\n";
      for(const Variation &variation : group.variations)
        for(const LabelRuns &runs : variation.runs->labels)
          for(const Level &level : runs.levels)
          {
            csv += csv_field(variation.runs->record->name());
            for(std::size_t i = 0; i < group.axes.size(); ++i)
              csv.append(",").append(csv_field(group.axes[i].values[variation.place[i]]));
            csv += fmt::format(",{},{},{:.12g},{:.12g}", csv_field(runs.label), level.n,
                               level.value("h"), level.value("dt"));
            for(const char *error : errors)
              csv += fmt::format(",{:.12g}", level.value(error));
            std::string notes;
            if(level.finished)
              for(const RunEvent &event : level.finished->events)
                notes += (notes.empty() ? "" : "; ") + event.what;
            csv += fmt::format(
                ",{:.6g},{:.6g},{},{}\n",
                level.finished
                    ? front_peclet_number(*variation.runs->record, *level.finished)
                    : std::nan(""),
                level.value("cpu_seconds"), csv_field(level.status()), csv_field(notes));
          }
      return csv;
    }
  } // namespace

  Markup variations_chapter(const ReportContext &context)
  {
    Markup content;
    for(const VariationGroup &group : variation_groups(context.variations))
    {
      content += element("h3", group.title())
                 + element("p", group.variations.front().runs->record->description);
      std::string markdown, tex;
      for(const std::string &label : group.labels)
      {
        Notes notes;
        const Table table = table_of(group, label, notes);
        content += table_markup(table, [&context](const std::string &words)
                                { return context.styles.key(words); })
                   + notes.below();
        markdown.append(markdown.empty() ? "" : "\n").append(table_markdown(table));
        tex.append(tex.empty() ? "" : "\n").append(table_tex(table));
      }
      content += linked_csv(context, group.file_name(), csv_of(group));
      write_file(context.directory + "/tables/" + group.file_name() + ".md", markdown);
      write_file(context.directory + "/tables/" + group.file_name() + ".tex", tex);
    }
    if(content.empty())
      return content;
    return element("h2", "Cases varied")
           + element("p",
                     "One row for each combination of values. Errors at each n, orders "
                     "fitted over all of them; V h/α: the front's speed times the "
                     "spacing over the smaller thermal diffusivity, greatest over the "
                     "run. Above 1 the thermal layer at the front is thinner than the "
                     "spacing, and what stands in the row is not the error of a scheme "
                     "that converges.")
           + content;
  }
} // namespace meltfront::verification
