#include <verification/judge/answers.h>
#include <verification/report/chapters/chapters.h>
#include <verification/report/page/number_text.h>
#include <verification/report/tables/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    std::string with_unit(const Answer &answer)
    {
      return answer.unit.empty() ? answer.quantity
                                 : fmt::format("{} ({})", answer.quantity, answer.unit);
    }

    /** `0.23832 +- 0.00016`: as many digits of the value as its bar leaves. */
    std::string value_text(double value, double bar)
    {
      if(!std::isfinite(bar))
        return fmt::format("{:.6g}", value);
      const double size = std::max(std::abs(value), bar);
      const int digits
          = bar > 0 && size > 0 ? std::clamp(
                static_cast<int>(std::ceil(std::log10(size / bar))) + 1, 2, 12)
                                : 12;
      return fmt::format("{:.{}g} ± {:.2g}", value, digits, bar);
    }

    /** One sentence on a quantity: what is agreed, or that nothing is. */
    Markup verdict_on(const Answer &answer)
    {
      const Consensus &consensus = answer.consensus;
      std::string names;
      for(const MethodAnswer &one : answer.methods)
        if(one.distance_in_bars > 1)
          names += (names.empty() ? "" : ", ") + one.label;
      const Markup value
          = element("b", value_text(consensus.value, consensus.bar)
                             + (answer.unit.empty() ? "" : " " + answer.unit));
      if(consensus.taking_part == 0)
        return text(answer.quantity + ": ") + element("b", "no error bar")
               + text("; no method converges on these levels.");
      if(!consensus.agreed)
        return text(answer.quantity + ": ")
               + element("b", consensus.contradictory()
                                  ? "no consensus"
                                  : "one answer that converges, confirmed by no other")
               + text("; all answers lie in ") + value + text(".");
      Markup sentence = text(answer.quantity + ": ") + value
                        + text(fmt::format(", in which {} of {} methods agree",
                                           consensus.support, answer.methods.size()));
      if(!names.empty())
        sentence += text("; ") + element("b", "contradicted by " + names);
      return sentence + text(".");
    }

    bool one_of_many(const Answer &answer)
    {
      return answer.quantity.starts_with("temperature");
    }

    /** Temperatures in one sentence: how many places agree, and where not. */
    Markup verdict_on_temperatures(const std::vector<Answer> &answers)
    {
      int places = 0, agreed = 0;
      double widest = 0;
      std::string others;
      for(const Answer &answer : answers)
        if(one_of_many(answer))
        {
          ++places;
          agreed += answer.consensus.agreed ? 1 : 0;
          if(answer.consensus.agreed)
            widest = std::max(widest, answer.consensus.bar);
          else
            others += (others.empty() ? "" : ", ")
                      + answer.quantity.substr(std::string("temperature ").size());
        }
      if(places == 0)
        return {};
      return text(fmt::format(
          "temperature: agreed at {} of {} places, within {:.2g}{}{}.", agreed, places,
          widest, others.empty() ? "" : "; no consensus ", others));
    }

    Table answers_table(const std::vector<Answer> &answers)
    {
      Table table;
      table.group_heading = "quantity";
      table.columns = {{"method", "", false},
                       {"n", "", true},
                       {"dimension", "", true},
                       {"value", "", false},
                       {"from the consensus", "bars", true},
                       {"true error", "", true},
                       {"CPU", "s", true},
                       {"remark", "", false}};
      for(const Answer &answer : answers)
      {
        RowGroup group{with_unit(answer), {}, {}};
        for(const MethodAnswer &one : answer.methods)
          group.rows.push_back({{one.label},
                                {NumberText{grouped(one.n), {}}},
                                {NumberText{grouped(one.dimension), {}}},
                                {value_text(one.bar.value, one.bar.bar)},
                                {prose_number(one.distance_in_bars, 2)},
                                {prose_number(one.error, 2)},
                                {prose_number(one.cpu_seconds, 2)},
                                {one.bar.remark}});
        table.groups.push_back(std::move(group));
      }
      return table;
    }
  } // namespace

  Markup answers_chapter(const ReportContext &context)
  {
    if(context.result.cases.size() != 1)
      return {};
    const StoredCase &record = context.result.cases.front();
    const std::vector<Answer> answers = answers_of(context.result, record);
    if(answers.empty())
      return {};
    std::vector<Markup> verdicts;
    for(const Answer &answer : answers)
      if(!one_of_many(answer))
        verdicts.push_back(verdict_on(answer));
    if(Markup words = verdict_on_temperatures(answers); !words.empty())
      verdicts.push_back(std::move(words));
    Markup content = element("h2", "What the methods answer") + list("ul", verdicts);
    std::vector<Markup> remarks;
    for(const std::string &remark : context.result.remarks)
      remarks.push_back(text(remark + "."));
    if(!remarks.empty())
      content += element("h3", "Where levels end, and who is not there")
                 + list("ul", remarks);
    return content + element("h3", "All answers")
           + element("p",
                     "Values at the end of the finest run of each method, with error "
                     "bars from its levels; where the time step was not refined with "
                     "them, also from a run at half the step. A distance above 1 bar "
                     "contradicts the consensus; bars are made to hold in nine of ten "
                     "cases, so look at how many bars it is.")
           + table_markup(answers_table(answers));
  }
} // namespace meltfront::verification
