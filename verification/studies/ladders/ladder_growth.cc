#include <cases/domain_measure.h>
#include <cases/numbers.h>
#include <verification/judge/ladder.h>
#include <verification/run/run_one.h>
#include <verification/studies/ladders/ladder_growth.h>
#include <verification/studies/ladders/method_priors.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <thread>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    constexpr int coarsest_level = 20, coarsest_in_space = 10;
    constexpr std::size_t most_levels = 8;
    constexpr double refinement_of_line = 2, refinement_of_plane = 1.5;
    /** Predictions of the growth are within 2 in 9 of 10. */
    constexpr double safety = 1.5;
    constexpr double shortest_limit = 1; // s
    constexpr double share_of_first_level = 0.25;
    /** Times as many cells as were asked for that are taken so that squares fill a box;
     * else methods stretch them, or refuse by name. */
    constexpr double most_to_fit = 1.5;
    constexpr double cost_of_half_step = 2; ///< over the run at the whole step

    double seconds_of(const RunRecord &run)
    {
      return run.cost.setup_wall + run.cost.stepping_wall;
    }

    std::string steps_option_of(const cases::Method &method)
    {
      return steps_option(cases::Options(method.option_declarations()));
    }

    int next_resolution(const RunRecord &finished, int n)
    {
      const double ratio = finished.description.dimension == 1 ? refinement_of_line
                                                               : refinement_of_plane;
      // Even numbers, so that symmetric scenes have cells on either side.
      return 2 * static_cast<int>(std::lround(n * ratio / 2));
    }
  } // namespace

  LadderGrowth::LadderGrowth(const std::string &case_name, const cases::Domain &domain,
                             const std::string &title,
                             const std::vector<const cases::Method *> &methods,
                             const RunnerOptions &options, CaseLoader load_case,
                             MethodLookup lookup, double within,
                             MethodSettings of_methods)
    : case_name(case_name)
    , coarsest(domain.mesh             ? 1
               : domain.dimension == 3 ? coarsest_in_space
                                       : coarsest_level)
    , halves_cells(domain.mesh != nullptr)
    , whole_cells(cases::fewest_whole_cells(domain))
    , title(title)
    , options(options)
    , load_case(std::move(load_case))
    , lookup(std::move(lookup))
    , within(within)
    , settings(std::move(of_methods))
    , start(std::chrono::steady_clock::now())
  {
    for(const cases::Method *method : methods)
      growing.push_back(
          {method, run_label(method->name(), settings[method->name()], 1), {}});
  }

  int LadderGrowth::fitting(const cases::Method &method, int n) const
  {
    if(halves_cells)
      return static_cast<int>(std::bit_ceil(static_cast<unsigned int>(n)));
    if(whole_cells == 1)
      return n;
    const auto values = cases::Options(method.option_declarations()).values();
    const auto layout = values.find("layout");
    // Points on both walls have one cell less between them than there are points.
    const bool on_walls = layout != values.end() && layout->second == "edge";
    const int step = on_walls ? whole_cells : std::lcm(whole_cells, 2);
    const int cells = n - (on_walls ? 1 : 0);
    const int fitting = (cells + step - 1) / step * step;
    return (fitting <= most_to_fit * cells ? fitting : cells) + (on_walls ? 1 : 0);
  }

  double LadderGrowth::seconds_left() const
  {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return within - spent.count();
  }

  const MatrixResult &LadderGrowth::result() const
  {
    return made;
  }

  const std::vector<GrowingLadder> &LadderGrowth::ladders() const
  {
    return growing;
  }

  Matrix LadderGrowth::matrix() const
  {
    Matrix matrix;
    matrix.name = title;
    matrix.title = title;
    matrix.remarks = remarks;
    // Who takes longer than that at first has no time for a second level, and would leave
    // the others none.
    const double share = made.runs.empty() ? share_of_first_level : 1;
    matrix.time_limit = std::max(share * seconds_left(), shortest_limit);
    for(const GrowingLadder &ladder : growing)
      if(!ladder.resolutions.empty())
      {
        MatrixBlock block;
        block.cases = {case_name};
        block.methods = {ladder.method->name()};
        block.resolutions = ladder.resolutions;
        for(const auto &[key, value] : settings.at(ladder.method->name()))
          block.options.push_back({ladder.method->name(), key, {value}});
        matrix.blocks.push_back(block);
        if(ladder.checked == 0)
          continue;
        block.resolutions = {ladder.checked};
        block.options.push_back({ladder.method->name(),
                                 steps_option_of(*ladder.method),
                                 {std::to_string(ladder.checked_steps)}});
        matrix.blocks.push_back(std::move(block));
      }
    return matrix;
  }

  void LadderGrowth::run(const std::function<void(MatrixResult &)> &what)
  {
    RunnerOptions now = options;
    now.deadline = start
                   + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                       std::chrono::duration<double>(within));
    now.conclude = what;
    made = run_matrix(matrix(), now, load_case, lookup);
  }

  const RunRecord *LadderGrowth::finest(const cases::Method &method) const
  {
    const RunRecord *best = nullptr;
    for(const RunRecord &run : made.runs)
      if(run.method == method.name() && run.status == RunStatus::finished
         && (!best || run.n > best->n))
        best = &run;
    return best;
  }

  double LadderGrowth::predicted_seconds(const cases::Method &method, int n) const
  {
    const RunRecord *known = finest(method);
    if(!known)
      return cases::nan;
    const double growth
        = method_prior(method.name(), known->description.dimension).growth;
    return seconds_of(*known) * std::pow(static_cast<double>(n) / known->n, growth);
  }

  std::filesystem::path LadderGrowth::folder_of(const RunRecord &run) const
  {
    const PlannedRun planned{
        short_case_name(case_name), run.method, run.label, {run.n, {}}};
    return std::filesystem::path(options.directory + "/" + planned.file()).parent_path();
  }

  const RunRecord *LadderGrowth::last_run(const GrowingLadder &ladder) const
  {
    const auto run = std::ranges::find_if(made.runs,
                                          [&](const RunRecord &one) {
                                            return one.method == ladder.method->name()
                                                   && one.n == ladder.resolutions.back();
                                          });
    return run == made.runs.end() ? nullptr : &*run;
  }

  /** A level that the time did not suffice for ends its ladder and leaves no trace. */
  void LadderGrowth::drop_out_of_time(GrowingLadder &ladder)
  {
    const RunRecord *run = last_run(ladder);
    if(!run || run->status == RunStatus::finished)
      return;
    const auto ended = run->provenance.find("ended");
    if(ended == run->provenance.end() || ended->second != "killed"
       || run->message.find("time limit") == std::string::npos)
      return;
    ladder.stopped = fmt::format("n = {} was ended when the time was up, after {:.0f} s",
                                 run->n, within);
    std::filesystem::remove_all(folder_of(*run));
    ladder.resolutions.pop_back();
  }

  /** A level that did not finish ends its ladder; one that is refused is passed over, for
   * what has to be resolved may come to lie better in finer cells, but not two in a row.
   */
  void LadderGrowth::drop_ended(GrowingLadder &ladder)
  {
    const RunRecord *run = last_run(ladder);
    drop_out_of_time(ladder);
    // The first level may be too coarse for it.
    const bool passed_over = run && run->status == RunStatus::refused
                             && !std::exchange(ladder.passed_over, true);
    if(!run || run->status == RunStatus::finished)
      ladder.passed_over = false;
    if(run && ladder.stopped.empty() && run->status != RunStatus::finished && !passed_over
       && (ladder.resolutions.size() > 1 || run->n > fitting(*ladder.method, coarsest)))
      ladder.stopped
          = fmt::format("{} at n = {}: {}", to_string(run->status), run->n, run->message);
  }

  bool LadderGrowth::grow(double share)
  {
    struct Candidate
    {
      GrowingLadder *ladder;
      int n;
      double seconds; ///< predicted, 0 if unknown
    };
    const double left = share * seconds_left();
    std::vector<Candidate> candidates;
    for(GrowingLadder &ladder : growing)
    {
      if(!ladder.stopped.empty() || ladder.resolutions.size() >= most_levels)
        continue;
      const RunRecord *known = finest(*ladder.method);
      if(!known)
        candidates.push_back(
            {&ladder,
             fitting(*ladder.method, ladder.resolutions.empty()
                                         ? coarsest
                                         : 2 * ladder.resolutions.back()),
             0});
      else if(known->n == ladder.resolutions.back() || ladder.passed_over)
      {
        const int n
            = fitting(*ladder.method, next_resolution(*known, ladder.resolutions.back()));
        candidates.push_back({&ladder, n, safety * predicted_seconds(*ladder.method, n)});
      }
    }
    std::ranges::sort(candidates, {}, &Candidate::seconds);
    const int jobs
        = options.jobs > 0
              ? options.jobs
              : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    double sum = 0;
    bool any = false;
    for(const Candidate &one : candidates)
    {
      sum += one.seconds;
      if(one.seconds > left || sum > jobs * left)
      {
        one.ladder->stopped = left > 0
                                  ? fmt::format("n = {} would take about {:.2g} s", one.n,
                                                one.seconds / safety)
                                  : fmt::format("the time was up before n = {}", one.n);
        continue;
      }
      one.ladder->resolutions.push_back(one.n);
      any = true;
    }
    if(!any)
      return false;
    run({});
    for(const Candidate &one : candidates)
      if(one.ladder->stopped.empty())
        drop_ended(*one.ladder);
    return true;
  }

  void LadderGrowth::check_steps()
  {
    const double jobs = options.jobs > 0
                            ? options.jobs
                            : std::max(1u, std::thread::hardware_concurrency());
    double left = jobs * seconds_left();
    for(const Ladder &known : ladders_of(made))
      for(GrowingLadder &ladder : growing)
      {
        const std::string steps = steps_option_of(*ladder.method);
        if(ladder.label != known.label || !hides_time_error(known) || steps.empty()
           || settings.at(ladder.method->name()).contains(steps))
          continue;
        for(std::size_t back = 1; back <= 2 && ladder.checked == 0; ++back)
        {
          const RunRecord &level = *known.levels[known.levels.size() - back];
          const double seconds = safety * cost_of_half_step * seconds_of(level);
          if(seconds > std::min(left, seconds_left()))
            continue;
          left -= seconds;
          ladder.checked = level.n;
          ladder.checked_steps = 2 * level.cost.steps;
        }
      }
    if(std::ranges::none_of(growing,
                            [](const GrowingLadder &one) { return one.checked > 0; }))
      return;
    run({});
    drop_checks_that_ended();
  }

  /** A check that did not finish says nothing. */
  void LadderGrowth::drop_checks_that_ended()
  {
    for(GrowingLadder &ladder : growing)
      for(const RunRecord &run : made.runs)
        if(run.method == ladder.method->name() && run.n == ladder.checked
           && run.label != ladder.label && run.status != RunStatus::finished)
        {
          std::filesystem::remove_all(folder_of(run));
          ladder.checked = 0;
          break;
        }
  }

  void LadderGrowth::make(const cases::Method &method, int n)
  {
    for(GrowingLadder &ladder : growing)
      if(ladder.method == &method
         && std::ranges::find(ladder.resolutions, n) == ladder.resolutions.end())
        ladder.resolutions.push_back(n);
    run({});
  }

  void LadderGrowth::make_all(const std::vector<int> &resolutions)
  {
    std::vector<int> coarsest_first = resolutions;
    std::ranges::sort(coarsest_first);
    for(const int n : coarsest_first)
    {
      const bool in_time = n == coarsest_first.front() || seconds_left() > 0;
      for(GrowingLadder &ladder : growing)
        if(!in_time && ladder.stopped.empty())
          ladder.stopped = fmt::format("the time was up before n = {}", n);
        else if(ladder.stopped.empty())
          ladder.resolutions.push_back(n);
      if(in_time)
        run({});
      for(GrowingLadder &ladder : growing)
        if(in_time && ladder.stopped.empty())
          drop_out_of_time(ladder);
    }
  }

  std::vector<std::string> LadderGrowth::stops() const
  {
    std::vector<std::string> sentences;
    for(const GrowingLadder &ladder : growing)
      if(!ladder.stopped.empty())
        sentences.push_back(fmt::format("{}: {}", ladder.method->name(), ladder.stopped));
    return sentences;
  }

  void LadderGrowth::conclude(const std::vector<std::string> &words,
                              const std::function<void(MatrixResult &)> &what)
  {
    remarks = words;
    run(what);
  }
} // namespace meltfront::verification
