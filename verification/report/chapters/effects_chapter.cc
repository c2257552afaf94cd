#include <verification/record/label.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::Effect;

    /** The decisions of a case: those of its first run that has any. */
    const std::vector<cases::EffectDecision> *decisions_of(const CaseRuns &runs)
    {
      for(const LabelRuns &label : runs.labels)
        for(const Level &level : label.levels)
          for(const RunRecord *run : level.runs)
            if(!run->effects.empty())
              return &run->effects;
      return nullptr;
    }

    const cases::EffectDecision *
    decision_on(const std::vector<cases::EffectDecision> &decisions, Effect effect)
    {
      const auto found = std::find_if(decisions.begin(), decisions.end(),
                                      [effect](const cases::EffectDecision &decision)
                                      { return decision.effect == effect; });
      return found == decisions.end() ? nullptr : &*found;
    }

    const cases::EffectCost *cost_of(const RunRecord &run, Effect effect)
    {
      for(const cases::EffectCost &cost : run.cost.effects)
        if(cost.effect == effect)
          return &cost;
      return nullptr;
    }

    /** Share of the run's wall time in per cent; NaN if it was not measured, as by a
     * method that assembles its effects in one pass and gives no time to any of them. */
    double share_of_time(const RunRecord &run, const cases::EffectCost &cost)
    {
      const double all = run.cost.setup_wall + run.cost.stepping_wall;
      const bool timed = std::any_of(run.cost.effects.begin(), run.cost.effects.end(),
                                     [](const cases::EffectCost &effect)
                                     { return effect.seconds > 0; });
      return timed && all > 0 ? 100 * cost.seconds / all : std::nan("");
    }

    std::string percent(double value)
    {
      if(!std::isfinite(value))
        return "not timed";
      if(value == 0)
        return "0 %";
      if(value > 0 && value < 0.1)
        return "< 0.1 %";
      return fmt::format("{:.{}f} %", value, value < 10 ? 1 : 0);
    }

    std::string effect_words(Effect effect)
    {
      std::string name = to_string(effect);
      std::replace(name.begin(), name.end(), '_', ' ');
      return name;
    }

    /** One label for each method: that without options, else the method's first. */
    bool stands_for_method(const CaseRuns &runs, const LabelRuns &label)
    {
      const std::string method = method_of(label.label);
      const LabelRuns *chosen = nullptr;
      for(const LabelRuns &candidate : runs.labels)
        if(method_of(candidate.label) == method && (!chosen || candidate.label == method))
          chosen = &candidate;
      return chosen == &label;
    }

    Markup effect_cell(const CaseRuns &runs, const cases::EffectDecision *decision)
    {
      if(!decision)
        return element("td", {{"class", "off"}}, text("–"));
      if(!decision->on)
        return element("td", {{"class", "off"}, {"title", decision->reason}},
                       text("off"));
      Markup content = badge("good", "on");
      for(const LabelRuns &label : runs.labels)
        if(const RunRecord *run = label.finest(); run && stands_for_method(runs, label))
          if(const cases::EffectCost *cost = cost_of(*run, decision->effect))
            content += element("div", {{"class", "share"}},
                               text(percent(share_of_time(*run, *cost)) + " ")
                                   + text(label.label));
      return element("td", {{"title", decision->reason}}, content);
    }

    std::string bytes_text(long bytes)
    {
      if(bytes < 10000)
        return fmt::format("{} B", bytes);
      return bytes < 10000000 ? fmt::format("{:.0f} kB", bytes / 1e3)
                              : fmt::format("{:.0f} MB", bytes / 1e6);
    }
  } // namespace

  namespace
  {
    /** Effects that some case of the page decides on: the others belong to other kinds
     * of problem. */
    std::vector<Effect> decided_effects(const ReportContext &context)
    {
      std::vector<Effect> effects;
      for(const Effect effect : cases::all_effects())
        if(std::any_of(context.runs.begin(), context.runs.end(),
                       [effect](const CaseRuns &runs)
                       {
                         const auto *decisions = decisions_of(runs);
                         return decisions && decision_on(*decisions, effect);
                       }))
          effects.push_back(effect);
      return effects;
    }
  } // namespace

  Markup effects_chapter(const ReportContext &context)
  {
    const std::vector<Effect> effects = decided_effects(context);
    Markup head = element("th", std::string("case"));
    for(const Effect effect : effects)
      head += element("th", {{"title", description(effect)}}, text(effect_words(effect)));
    Markup rows;
    for(const CaseRuns &runs : context.runs)
      if(const auto *decisions = decisions_of(runs); decisions && !decisions->empty())
      {
        Markup row = element("td", case_link(runs.record->name()));
        for(const Effect effect : effects)
          row += effect_cell(runs, decision_on(*decisions, effect));
        rows += element("tr", row) + Markup("\n");
      }
    Markup content = element("h2", "Active effects and their cost");
    if(rows.empty())
      content += element("p", "No run says which effects its scene called for.");
    else
      content
          += element("p", "A scene pays only for the effects that it calls for. The "
                          "share of the wall time is that of each method's finest run; "
                          "an effect that is off costs neither time nor memory. The "
                          "reasons stand in the section of each case.")
             + element("div", {{"class", "scroll"}},
                       element("table", element("thead", element("tr", head))
                                            + element("tbody", rows)));
    content += element(
        "p", text("Effects, domains, walls and fronts that each method "
                  "takes: ")
                 + element("a", {{"href", "capabilities.txt"}}, text("capabilities.txt"))
                 + text(". All else is refused."));
    return content;
  }

  Markup effects_of_case(const ReportContext &context, const CaseRuns &runs)
  {
    const auto *decisions = decisions_of(runs);
    if(!decisions || decisions->empty())
      return {};
    Markup head = element("th", std::string("effect")) + element("th", std::string())
                  + element("th", std::string("because"));
    std::vector<const RunRecord *> finest;
    for(const LabelRuns &label : runs.labels)
      if(const RunRecord *run = label.finest();
         run && !run->cost.effects.empty() && stands_for_method(runs, label))
      {
        finest.push_back(run);
        head += element("th", {{"class", "number"}}, context.styles.key(label.label));
      }
    Markup rows;
    for(const cases::EffectDecision &decision : *decisions)
    {
      Markup row
          = element("td", effect_words(decision.effect))
            + element("td", decision.on ? badge("good", "on") : badge("none", "off"))
            + element("td", decision.reason);
      for(const RunRecord *run : finest)
      {
        const cases::EffectCost *cost = cost_of(*run, decision.effect);
        row += element("td", {{"class", "number"}},
                       text(cost ? fmt::format(
                                "{}, {}, {} calls", percent(share_of_time(*run, *cost)),
                                bytes_text(cost->bytes), grouped(cost->calls))
                                 : "–"));
      }
      rows += element("tr", row) + Markup("\n");
    }
    return element(
        "div", {{"class", "scroll plain"}},
        element("table", element("thead", element("tr", head)) + element("tbody", rows)));
  }
} // namespace meltfront::verification
