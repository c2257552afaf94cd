#include <verification/matrix/progress.h>

#include <fmt/format.h>

#include <unistd.h>

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

  Progress::Progress(std::FILE *out, std::size_t runs, double work,
                     std::size_t finished_before)
    : out(out)
    , terminal(out && isatty(fileno(out)))
    , runs(runs)
    , work(work)
    , start(std::chrono::steady_clock::now())
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
    std::fflush(out);
  }

  std::string Progress::time_left() const
  {
    if(work_done <= 0 || ended == runs)
      return "";
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return fmt::format(", about {} left",
                       time_left_text(spent.count() * (work - work_done) / work_done));
  }

  void Progress::run_ended(const std::string &what, const std::string &how, bool well,
                           double work_of_run)
  {
    ++ended;
    work_done += work_of_run;
    if(!out)
      return;
    if(!terminal)
      fmt::print(out, "[{}/{}] {}: {}{}\n", ended, runs, what, how, time_left());
    else if(!well)
      fmt::print(out, "{}{}: {}\n", clear_line, what, how);
    std::fflush(out);
  }

  void Progress::show_running(const std::string &what)
  {
    const auto now = std::chrono::steady_clock::now();
    if(!out || !terminal || now - last_shown < pause)
      return;
    last_shown = now;
    const std::string line
        = fmt::format("[{}/{}{}] {}", ended, runs, time_left(), what).substr(0, widest);
    fmt::print(out, "{}{}", clear_line, line);
    std::fflush(out);
  }
} // namespace meltfront::verification
