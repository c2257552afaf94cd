#include <verification/matrix/progress.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::chrono::milliseconds pause{250};
    constexpr std::size_t widest = 78;
    constexpr const char *clear_line = "\r\033[K";
  } // namespace

  std::string time_left_text(double seconds)
  {
    const long s = std::lround(seconds);
    if(s < 60)
      return fmt::format("{} s", s);
    if(s < 3600)
      return fmt::format("{} min {} s", s / 60, s % 60);
    return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
  }

  Progress::Progress(std::FILE *out, std::vector<RunKind> runs,
                     std::size_t finished_before, int jobs)
    : out(out)
    , terminal(out && isatty(fileno(out)))
    , jobs(jobs)
    , waiting(std::move(runs))
    , last_ended(std::chrono::steady_clock::now())
  {
    if(!out)
      return;
    if(finished_before > 0)
      fmt::print(out, "{} runs were finished before and are kept\n", finished_before);
    std::fflush(out);
  }

  Progress::~Progress()
  {
    if(!out)
      return;
    if(terminal)
      fmt::print(out, "{}", clear_line);
    for(const auto &[reason, refused] : refusals)
      fmt::print(out, "Refused: {} ({} run{} of {})\n", reason, refused.runs,
                 refused.runs == 1 ? "" : "s", fmt::join(refused.cases, ", "));
    std::fflush(out);
  }

  void Progress::expect(const RunKind &run, double seconds)
  {
    estimate.expect(run, seconds);
  }

  double Progress::seconds_left() const
  {
    double sum = 0, longest = 0;
    for(const RunKind &run : waiting)
    {
      const double seconds = estimate.seconds(run);
      sum += seconds;
      longest = std::fmax(longest, seconds);
    }
    return std::isnan(sum) ? sum : std::max(sum / std::max(jobs, 1), longest);
  }

  std::string Progress::time_left() const
  {
    const double seconds = seconds_left();
    if(waiting.empty() || std::isnan(seconds))
      return "";
    // Since the last run ended, those that go on have come nearer to their ends.
    const std::chrono::duration<double> since
        = std::chrono::steady_clock::now() - last_ended;
    return fmt::format(", about {} left",
                       time_left_text(std::max(seconds - since.count(), 0.)));
  }

  void Progress::run_ended(const RunKind &run, double seconds, const std::string &what,
                           const std::string &how, bool well)
  {
    estimate.add(run, seconds);
    count(run);
    if(!out)
      return;
    const std::size_t runs = ended + waiting.size();
    if(!terminal)
      fmt::print(out, "[{}/{}] {}: {}{}\n", ended, runs, what, how, time_left());
    else if(!well)
      fmt::print(out, "{}{}: {}\n", clear_line, what, how);
    std::fflush(out);
  }

  void Progress::count(const RunKind &run)
  {
    ++ended;
    const auto done = std::ranges::find_if(waiting,
                                           [&run](const RunKind &other)
                                           {
                                             return other.case_name == run.case_name
                                                    && other.label == run.label
                                                    && other.n == run.n;
                                           });
    if(done != waiting.end())
      waiting.erase(done);
    last_ended = std::chrono::steady_clock::now();
  }

  void Progress::run_refused(const RunKind &run, const std::string &reason)
  {
    count(run);
    Refusals &refused = refusals[reason];
    ++refused.runs;
    if(std::ranges::find(refused.cases, run.case_name) == refused.cases.end())
      refused.cases.push_back(run.case_name);
  }

  void Progress::show_running(const std::string &what)
  {
    const auto now = std::chrono::steady_clock::now();
    if(!out || !terminal || now - last_shown < pause)
      return;
    last_shown = now;
    const std::string line
        = fmt::format("[{}/{}{}] {}", ended, ended + waiting.size(), time_left(), what)
              .substr(0, widest);
    fmt::print(out, "{}{}", clear_line, line);
    std::fflush(out);
  }
} // namespace meltfront::verification
