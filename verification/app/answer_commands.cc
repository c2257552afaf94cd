#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/app/answer_commands.h>
#include <verification/app/case_settings.h>
#include <verification/app/commands.h>
#include <verification/app/methods.h>
#include <verification/judge/answers.h>
#include <verification/matrix/matrix_files.h>
#include <verification/record/json_values.h>
#include <verification/studies/ladders/advice.h>
#include <verification/studies/ladders/capable_methods.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** A comparison looks at many runs: each is repeated little. */
    constexpr RepeatPolicy few_repeats{3, 0.2, 0.5};

    /** Of the time left that a stage of levels may take: the rest is for runs at half the
     * step. */
    constexpr double share_of_levels = 0.75;

    CapableMethods methods_for(const cases::Case &c, const MethodSettings &settings)
    {
      std::vector<const cases::Method *> all;
      for(const auto &method : methods())
        all.push_back(method.get());
      CapableMethods found = capable_methods(c, all, settings);
      if(found.capable.empty())
        throw cases::InputError(fmt::format("no method takes the case {}: {}",
                                            c.scene.name,
                                            fmt::join(found.left_out, "; ")));
      return found;
    }

    LadderGrowth growth_of(const std::string &case_name, const cases::Case &c,
                           const std::string &title, const CapableMethods &found,
                           const std::string &directory, int jobs, double memory,
                           double within, const MethodSettings &settings)
    {
      RunnerOptions options = runner_options(directory, jobs, memory);
      options.repeats = few_repeats;
      return LadderGrowth(
          case_name, c.scene.domain, title, found.capable, options,
          [&c](const std::string &) { return c; }, method_named, within, settings);
    }

    /** What a reader must know of the levels: where they end and who is not there. */
    std::vector<std::string> remarks_on(const LadderGrowth &growth,
                                        const CapableMethods &found)
    {
      std::vector<std::string> remarks;
      for(const std::string &stop : growth.stops())
        remarks.push_back("Ended early: " + stop);
      for(const std::string &reason : found.left_out)
        remarks.push_back("Left out: " + reason);
      return remarks;
    }

    std::string interval_text(double value, double bar)
    {
      return std::isfinite(bar) ? fmt::format("{:.8g} +- {:.2g}", value, bar)
                                : fmt::format("{:.8g}, no error bar", value);
    }

    std::string verdict_text(const Answer &answer)
    {
      const Consensus &consensus = answer.consensus;
      const std::string value = interval_text(consensus.value, consensus.bar);
      if(consensus.agreed)
        return fmt::format("{}, {} of {} methods agree", value, consensus.support,
                           answer.methods.size());
      if(consensus.contradictory())
        return value + ", NO CONSENSUS: the methods contradict each other";
      if(consensus.taking_part == 0)
        return "NO ERROR BAR: no method converges on levels so few and coarse; give more "
               "time (--within) or finer levels (--n)";
      return value
             + (answer.methods.size() < 2
                    ? ", confirmed by no other method"
                    : ", confirmed by no other method that converges");
    }

    void print_answer(const Answer &answer)
    {
      fmt::print("\n{}{}: {}\n", answer.quantity,
                 answer.unit.empty() ? "" : " (" + answer.unit + ")",
                 verdict_text(answer));
      for(const MethodAnswer &one : answer.methods)
        fmt::print("  {:24} n = {:<5} {}D  {:32} {:>9}  {:8.2g} s{}{}\n", one.label,
                   one.n, one.dimension, interval_text(one.bar.value, one.bar.bar),
                   std::isnan(one.distance_in_bars)
                       ? "-"
                       : fmt::format("{:.2g} bars", one.distance_in_bars),
                   one.cpu_seconds, one.bar.remark.empty() ? "" : "  " + one.bar.remark,
                   one.distance_in_bars > 1 ? "  CONTRADICTS" : "");
    }

    void print_temperatures(const std::vector<Answer> &answers)
    {
      std::string without;
      int places = 0;
      for(const Answer &answer : answers)
        if(answer.quantity.starts_with("temperature"))
        {
          ++places;
          if(!answer.consensus.agreed)
            without += "\n  no consensus on the " + answer.quantity;
          else
            fmt::print("{}{}: {}", places == 1 ? "\n" : "", answer.quantity,
                       interval_text(answer.consensus.value, answer.consensus.bar)
                           + "\n");
        }
      if(!without.empty())
        fmt::print("{}\n", without.substr(1));
    }

    void print_cheapest(const std::vector<LevelError> &levels)
    {
      if(levels.empty())
        return;
      fmt::print("\nThe cheapest for a relative error of the {}:\n",
                 levels.front().quantity);
      for(const double wanted : errors_of_interest)
        if(const LevelError *best = cheapest_level(levels, wanted))
          fmt::print("  {:.0e}  {} n = {} in {}D, {:.2g} s\n", wanted, best->label,
                     best->n, best->dimension, best->cpu_seconds);
        else
          fmt::print("  {:.0e}  not reached\n", wanted);
    }

    /** Answers of what a growth has made, to the console and to `answers.json`. */
    std::vector<Answer> tell_answers(const MatrixResult &result,
                                     const std::string &directory)
    {
      const StoredCase &record = result.cases.front();
      const std::vector<Answer> answers = answers_of(result, record);
      write_json(directory + "/answers.json", answers_json(answers));
      for(const Answer &answer : answers)
        if(!answer.quantity.starts_with("temperature"))
          print_answer(answer);
      print_temperatures(answers);
      print_cheapest(level_errors(result, record));
      return answers;
    }

    /** @throws cases::InputError for a method or an option that there is not, or a value
     * that it does not take */
    MethodSettings settings_of(const std::vector<std::string> &texts)
    {
      MethodSettings settings;
      for(const std::string &text : texts)
      {
        const Setting one = parse_setting(text);
        settings[one.method][one.key] = one.value;
        options_with(settings, method_named(one.method));
      }
      return settings;
    }

    /** Whether to some question there is no value with a bar that stands. */
    bool unanswered(const std::vector<Answer> &answers)
    {
      return std::ranges::any_of(answers,
                                 [](const Answer &answer)
                                 {
                                   return answer.consensus.contradictory()
                                          || (answer.consensus.taking_part == 0
                                              && answer.methods.size() > 1);
                                 });
    }

    /** A case that is asked for answers: where they go, who can give them, and the runs.
     */
    class Inquiry
    {
    public:
      /** @param arguments CompareArguments or AdviseArguments */
      template <typename Arguments>
      Inquiry(const Arguments &arguments, const std::string &command,
              const Settings &settings)
        : case_name(
            varied_case(arguments.case_name, settings.of_case,
                        [&](const std::string &name)
                        { return directory_of(arguments.output, command + "-" + name); }))
        , asked(load_checked_case(case_name))
        , title(command + "-" + asked.scene.name)
        , of_methods(settings_of(settings.of_method))
        , found(methods_for(asked, of_methods))
        , directory(directory_of(arguments.output, title))
        , growth(growth_of(case_name, asked, title, found, directory, arguments.jobs,
                           arguments.memory, arguments.within, of_methods))
      {
      }

      std::vector<std::string> remarks() const
      {
        return remarks_on(growth, found);
      }

    private:
      static std::string directory_of(const std::string &output, const std::string &title)
      {
        return output.empty() ? default_directory(title) : output;
      }

      std::string case_name;
      cases::Case asked;
      std::string title;
      MethodSettings of_methods;
      CapableMethods found;

    public:
      std::string directory;
      LadderGrowth growth;
    };

    std::string outcome_of(const Advice &advice)
    {
      return std::isnan(advice.error)
                 ? "no error bar"
                 : fmt::format("{} {:.2g}", advice.error_is_true ? "error" : "error bar",
                               advice.error);
    }
  } // namespace

  int compare(const CompareArguments &asked)
  {
    constexpr double of_compare = 60, as_long_as_it_takes = 1e8; // s
    CompareArguments arguments = asked;
    if(arguments.within == 0)
      arguments.within = arguments.resolutions.empty() ? of_compare : as_long_as_it_takes;
    Inquiry inquiry(arguments, "compare", sort_settings(arguments.settings));
    if(arguments.resolutions.empty())
      while(inquiry.growth.grow(share_of_levels))
        ;
    else
      inquiry.growth.make_all(arguments.resolutions);
    inquiry.growth.check_steps();
    inquiry.growth.conclude(inquiry.remarks(), [&](MatrixResult &result)
                            { write_results(result, inquiry.directory); });
    const std::vector<Answer> answers
        = tell_answers(inquiry.growth.result(), inquiry.directory);
    fmt::print("\n");
    for(const std::string &remark : inquiry.remarks())
      fmt::print("{}\n", remark);
    print_place_of_report(inquiry.directory);
    return answers.empty()       ? run_failed
           : unanswered(answers) ? criterion_failed
                                 : all_well;
  }

  int advise(const AdviseArguments &arguments)
  {
    Inquiry inquiry(arguments, "advise", {{}, settings_of_case(arguments.settings)});
    const Advice advice
        = advise(inquiry.growth, {arguments.front_error, arguments.temperature_error});
    inquiry.growth.conclude(inquiry.remarks(), [&](MatrixResult &result)
                            { write_results(result, inquiry.directory); });
    tell_answers(inquiry.growth.result(), inquiry.directory);
    write_json(inquiry.directory + "/advice.json", advice);
    fmt::print("\n");
    for(const MethodForecast &one : advice.forecasts)
      fmt::print("  {:24} n = {:<7} error {:.1e}, {:.2g} s of CPU{}\n",
                 one.method->name(), one.n, one.error, one.seconds,
                 one.doubt.empty() ? "" : "; " + one.doubt);
    if(!advice.method.empty())
      fmt::print("Advice: {} at n = {}: predicted error {:.2g} in {:.2g} s of CPU; came "
                 "out: {} in {:.2g} s{}\n",
                 advice.method, advice.n, advice.predicted_error,
                 advice.predicted_seconds, outcome_of(advice), advice.seconds,
                 advice.reachable ? "" : "; the wanted error is NOT REACHED");
    if(!advice.explanation.empty())
      fmt::print("{}\n", advice.explanation);
    print_place_of_report(inquiry.directory);
    return advice.reachable ? all_well : criterion_failed;
  }
} // namespace meltfront::verification
