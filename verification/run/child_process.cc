#include <cases/error.h>
#include <verification/run/child_process.h>

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    void redirect(const char *path, int flags, int descriptor)
    {
      const int file = open(path, flags, 0644);
      if(file < 0)
        return;
      dup2(file, descriptor);
      close(file);
    }

    [[noreturn]] void run_in_child(const std::function<void()> &function,
                                   const std::string &log, pid_t parent)
    {
      // The parent may have died between fork and prctl.
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if(getppid() != parent)
        _exit(1);
      const rlimit no_core{0, 0};
      setrlimit(RLIMIT_CORE, &no_core);
      redirect("/dev/null", O_RDONLY, STDIN_FILENO);
      redirect(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
      dup2(STDOUT_FILENO, STDERR_FILENO);
      int status = 0;
      try
      {
        function();
      }
      catch(const std::exception &error)
      {
        std::fputs(error.what(), stderr);
        status = 1;
      }
      std::cout.flush();
      std::fflush(nullptr);
      // Not exit(): what the parent registered to do at its end is the parent's.
      std::quick_exit(status);
    }
  } // namespace

  std::string ChildEnd::problem() const
  {
    if(signal == SIGKILL)
      return "was killed, perhaps because memory ran out";
    if(signal != 0)
      return fmt::format("crashed ({})", strsignal(signal));
    return exit_status == 0 ? "" : fmt::format("ended with status {}", exit_status);
  }

  ChildProcess::ChildProcess(const std::function<void()> &function,
                             const std::string &log)
    : log(log)
  {
    std::cout.flush();
    std::fflush(nullptr);
    const pid_t parent = getpid();
    process = fork();
    if(process == 0)
      run_in_child(function, log, parent);
    if(process < 0)
      throw cases::OutputError(
          fmt::format("no process can be started: {}", std::strerror(errno)));
  }

  ChildProcess::ChildProcess(ChildProcess &&other) noexcept
    : process(std::exchange(other.process, -1))
    , log(std::move(other.log))
    , how(other.how)
  {
  }

  ChildProcess &ChildProcess::operator=(ChildProcess &&other) noexcept
  {
    std::swap(process, other.process);
    std::swap(log, other.log);
    std::swap(how, other.how);
    return *this;
  }

  ChildProcess::~ChildProcess()
  {
    kill();
  }

  bool ChildProcess::ended()
  {
    if(process < 0)
      return true;
    int status = 0;
    rusage usage;
    if(wait4(process, &status, WNOHANG, &usage) != process)
      return false;
    take_end(status, usage.ru_maxrss);
    return true;
  }

  const ChildEnd &ChildProcess::end() const
  {
    return how;
  }

  void ChildProcess::kill()
  {
    if(process < 0)
      return;
    ::kill(process, SIGKILL);
    int status = 0;
    rusage usage;
    while(wait4(process, &status, 0, &usage) < 0 && errno == EINTR)
    {
    }
    take_end(status, usage.ru_maxrss);
  }

  void ChildProcess::take_end(int status, long peak_kilobytes)
  {
    process = -1;
    how.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    how.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    how.peak_memory_mb = static_cast<double>(peak_kilobytes) / 1024;
    std::error_code ignored;
    if(std::filesystem::file_size(log, ignored) == 0)
      std::filesystem::remove(log, ignored);
  }
} // namespace meltfront::verification
