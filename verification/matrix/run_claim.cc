#include <cases/error.h>
#include <verification/matrix/directory_lock.h>
#include <verification/matrix/run_claim.h>

#include <fmt/format.h>

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    std::string this_host()
    {
      char name[256] = "";
      gethostname(name, sizeof(name) - 1);
      return name;
    }

    std::string boot()
    {
      std::string word;
      std::ifstream("/proc/sys/kernel/random/boot_id") >> word;
      return word;
    }

    /** State and start (clock ticks since the boot) of a process; empty if there is none.
     */
    std::pair<std::string, std::string> state_and_start(long process)
    {
      std::ifstream in(fmt::format("/proc/{}/stat", process));
      std::string text;
      std::getline(in, text);
      // After the program's name, which may hold anything, comes field 3.
      std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
      constexpr int state_at = 3, start_at = 22;
      std::string state, word;
      for(int i = state_at; i <= start_at && fields >> word; ++i)
        if(i == state_at)
          state = word;
      return {state, word};
    }

    std::optional<ClaimHolder> read_holder(const std::string &path)
    {
      ClaimHolder holder;
      std::ifstream in(path);
      if(in >> holder.host >> holder.process >> holder.start)
        return holder;
      return std::nullopt;
    }

    double age(const std::string &path)
    {
      std::error_code failure;
      const auto written = std::filesystem::last_write_time(path, failure);
      if(failure)
        return 0;
      return std::chrono::duration<double>(std::filesystem::file_time_type::clock::now()
                                           - written)
          .count();
    }

    /** Make the claim if there is none. */
    bool link_claim(const std::string &path)
    {
      const ClaimHolder self = ClaimHolder::self();
      const std::string own = fmt::format("{}.{}.{}", path, self.host, self.process);
      {
        std::ofstream out(own);
        out << self.host << ' ' << self.process << ' ' << self.start << '\n';
        if(!out.flush())
          throw cases::OutputError(fmt::format("cannot write {}", own));
      }
      const bool made = link(own.c_str(), path.c_str()) == 0;
      const int problem = errno;
      unlink(own.c_str());
      if(!made && problem != EEXIST)
        throw cases::OutputError(
            fmt::format("cannot make the claim {}: {}", path, std::strerror(problem)));
      return made;
    }
  } // namespace

  ClaimHolder ClaimHolder::self()
  {
    return {this_host(), getpid(),
            fmt::format("{}:{}", boot(), state_and_start(getpid()).second)};
  }

  bool ClaimHolder::elsewhere() const
  {
    return host != this_host();
  }

  bool ClaimHolder::lives() const
  {
    const auto [state, since] = state_and_start(process);
    return !state.empty() && state != "Z" && state != "X"
           && start == fmt::format("{}:{}", boot(), since);
  }

  bool RunClaim::held(const std::string &path, double stale_after)
  {
    const auto holder = read_holder(path);
    if(!holder)
      return false;
    return holder->elsewhere() ? age(path) <= stale_after : holder->lives();
  }

  std::optional<RunClaim> RunClaim::take(const std::string &path, double stale_after)
  {
    if(link_claim(path))
      return RunClaim(path);
    if(held(path, stale_after))
      return std::nullopt;
    // Of those who find it stale one at a time removes it, and none a claim made since.
    const DirectoryLock lock(std::filesystem::path(path).parent_path(),
                             DirectoryLock::IfHeld::wait);
    if(held(path, stale_after))
      return std::nullopt;
    unlink(path.c_str());
    return link_claim(path) ? std::optional(RunClaim(path)) : std::nullopt;
  }

  RunClaim::RunClaim(std::string path)
    : path(std::move(path))
  {
  }

  RunClaim::RunClaim(RunClaim &&other) noexcept
    : path(std::exchange(other.path, {}))
  {
  }

  RunClaim &RunClaim::operator=(RunClaim &&other) noexcept
  {
    std::swap(path, other.path);
    return *this;
  }

  RunClaim::~RunClaim()
  {
    if(!path.empty())
      unlink(path.c_str());
  }
} // namespace meltfront::verification
