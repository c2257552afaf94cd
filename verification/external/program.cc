#include <cases/error.h>
#include <verification/external/command.h>
#include <verification/external/program.h>

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace meltfront::verification::external
{
  namespace
  {
    /** What the watching process tells of the program. */
    struct Report
    {
      int failure = 0; ///< errno of what kept it from being started
      int status = 0;  ///< as wait() has it
      double wall = 0, cpu = 0;
    };

    constexpr int signals_to_outlive[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};

    /** The same file, by a number that no file of a program has at its start. */
    int beyond_standard_files(int descriptor)
    {
      constexpr int first = 10;
      return fcntl(descriptor, F_DUPFD_CLOEXEC, first);
    }

    /** Two ends, each closed once. */
    class Pipe
    {
    public:
      Pipe()
      {
        if(pipe2(ends.data(), O_CLOEXEC) != 0)
          throw cases::OutputError(
              fmt::format("no pipe can be made: {}", std::strerror(errno)));
      }

      ~Pipe()
      {
        close_end(0);
        close_end(1);
      }

      Pipe(const Pipe &) = delete;
      Pipe &operator=(const Pipe &) = delete;

      int reading() const
      {
        return ends[0];
      }

      int writing() const
      {
        return ends[1];
      }

      void close_end(int which)
      {
        if(ends[which] >= 0)
          close(ends[which]);
        ends[which] = -1;
      }

    private:
      std::array<int, 2> ends{};
    };

    /** What a forked process may do before it becomes another program: no memory is
     * allocated in any of the following. */
    struct Start
    {
      const char *program;
      char *const *arguments;
      std::array<int, 4> files; ///< become 0 to 3; -1: none
    };

    [[noreturn]] void become_program(const Start &start, pid_t watcher, int failure_pipe)
    {
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if(getppid() != watcher)
        _exit(1);
      for(const int number : signals_to_outlive)
        std::signal(number, SIG_DFL);
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      const rlimit no_core{0, 0};
      setrlimit(RLIMIT_CORE, &no_core);
      failure_pipe = beyond_standard_files(failure_pipe);
      for(int i = 0; i < static_cast<int>(start.files.size()); ++i)
        if(start.files[i] >= 0)
          dup2(start.files[i], i);
      execv(start.program, start.arguments);
      const int failure = errno;
      [[maybe_unused]] const auto told = write(failure_pipe, &failure, sizeof failure);
      _exit(127);
    }

    double seconds_of(const timeval &time)
    {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }

    double now()
    {
      timespec time{};
      clock_gettime(CLOCK_MONOTONIC, &time);
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    /** Wait until the program has ended or the other end of `life` is closed. */
    void watch(pid_t program, int life, const sigset_t &unblocked)
    {
      for(;;)
      {
        siginfo_t end{};
        if(waitid(P_PID, static_cast<id_t>(program), &end, WEXITED | WNOHANG | WNOWAIT)
               != 0
           || end.si_pid == program)
          return;
        pollfd of_parent{life, POLLIN, 0};
        // The end of a child interrupts it.
        if(ppoll(&of_parent, 1, nullptr, &unblocked) > 0)
          return;
      }
    }

    /** The process that watches over the program: starts it, waits, kills what is left of
     * its group and reports. */
    [[noreturn]] void watch_over(const Start &start, int life, int report_pipe)
    {
      for(const int number : signals_to_outlive)
        std::signal(number, SIG_IGN);
      std::signal(SIGCHLD, [](int) {});
      sigset_t of_children, before;
      sigemptyset(&of_children);
      sigaddset(&of_children, SIGCHLD);
      sigprocmask(SIG_BLOCK, &of_children, &before);
      sigdelset(&before, SIGCHLD);
      Report report;
      int failure_pipe[2];
      const pid_t self = getpid();
      const double begin = now();
      const pid_t program = pipe2(failure_pipe, O_CLOEXEC) == 0 ? fork() : -1;
      if(program == 0)
        become_program(start, self, failure_pipe[1]);
      if(program < 0)
        report.failure = errno;
      else
      {
        setpgid(program, program);
        close(failure_pipe[1]);
        if(read(failure_pipe[0], &report.failure, sizeof report.failure)
           != sizeof report.failure)
          report.failure = 0;
        watch(program, life, before);
        kill(program, SIGKILL);
        kill(-program, SIGKILL);
        rusage usage{};
        while(wait4(program, &report.status, 0, &usage) < 0 && errno == EINTR)
          ;
        report.wall = now() - begin;
        report.cpu = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
      }
      [[maybe_unused]] const auto told = write(report_pipe, &report, sizeof report);
      _exit(0);
    }

    /** Read the report; meanwhile, let go of a program that writes too much. */
    bool await(Report &report, Pipe &reports, Pipe &life, const UnnamedFile &answer,
               const UnnamedFile &messages, double most_bytes, bool &too_much)
    {
      constexpr int pause = 20; // ms
      for(pollfd of_report{reports.reading(), POLLIN, 0};
          poll(&of_report, 1, pause) <= 0;)
        if(answer.bytes() > most_bytes || messages.bytes() > most_bytes)
        {
          too_much = true;
          life.close_end(1);
        }
      return read(reports.reading(), &report, sizeof report) == sizeof report;
    }
  } // namespace

  UnnamedFile::UnnamedFile()
  {
    const std::filesystem::path place = std::filesystem::temp_directory_path();
    std::string pattern = (place / ("meltfront-" + std::string(6, 'X'))).string();
    const int low = mkostemp(pattern.data(), O_CLOEXEC);
    if(low < 0)
      throw cases::OutputError("cannot make a temporary file in " + place.string());
    unlink(pattern.c_str());
    file = beyond_standard_files(low);
    close(low);
  }

  UnnamedFile::~UnnamedFile()
  {
    close(file);
  }

  std::string UnnamedFile::path() const
  {
    return fmt::format("/proc/self/fd/{}", file);
  }

  double UnnamedFile::bytes() const
  {
    struct stat known
    {
    };
    return fstat(file, &known) == 0 ? static_cast<double>(known.st_size) : 0;
  }

  void UnnamedFile::write(const std::string &text)
  {
    for(std::size_t done = 0; done < text.size();)
    {
      const ssize_t size = ::write(file, text.data() + done, text.size() - done);
      if(size < 0 && errno != EINTR)
        throw cases::OutputError(
            fmt::format("a temporary file cannot be written: {}", std::strerror(errno)));
      done += size > 0 ? static_cast<std::size_t>(size) : 0;
    }
    lseek(file, 0, SEEK_SET);
  }

  std::string ProgramEnd::problem() const
  {
    if(signal == SIGKILL)
      return "was killed, perhaps because memory ran out";
    if(signal != 0)
      return fmt::format("crashed ({})", strsignal(signal));
    return exit_status == 0 ? "" : fmt::format("ended with status {}", exit_status);
  }

  ProgramEnd run_program(const std::vector<std::string> &words,
                         const UnnamedFile &request, const UnnamedFile &answer,
                         const UnnamedFile &messages, bool named_answer,
                         double most_bytes)
  {
    const std::string program = find_program(words.front());
    std::vector<char *> arguments;
    for(const std::string &word : words)
      arguments.push_back(const_cast<char *>(word.c_str()));
    arguments.push_back(nullptr);
    const int other = messages.descriptor();
    const Start start{
        program.c_str(), arguments.data(),
        named_answer ? std::array{request.descriptor(), other, other, answer.descriptor()}
                     : std::array{request.descriptor(), answer.descriptor(), other, -1}};
    std::fflush(nullptr);
    Pipe life, reports;
    const pid_t watcher = fork();
    if(watcher == 0)
    {
      life.close_end(1);
      watch_over(start, life.reading(), reports.writing());
    }
    if(watcher < 0)
      throw cases::OutputError(
          fmt::format("no process can be started: {}", std::strerror(errno)));
    life.close_end(0);
    reports.close_end(1);
    Report report;
    ProgramEnd end;
    const bool told
        = await(report, reports, life, answer, messages, most_bytes, end.too_much);
    while(waitpid(watcher, nullptr, 0) < 0 && errno == EINTR)
      ;
    if(told && report.failure != 0)
      throw cases::Refusal(fmt::format("'{}' cannot be started: {}", words.front(),
                                       std::strerror(report.failure)));
    end.exit_status = WIFEXITED(report.status) ? WEXITSTATUS(report.status) : 0;
    end.signal = !told                        ? SIGKILL
                 : WIFSIGNALED(report.status) ? WTERMSIG(report.status)
                                              : 0;
    end.wall = report.wall;
    end.cpu = report.cpu;
    end.too_much
        = end.too_much || answer.bytes() > most_bytes || messages.bytes() > most_bytes;
    return end;
  }
} // namespace meltfront::verification::external
