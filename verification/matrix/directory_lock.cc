#include <cases/error.h>
#include <verification/matrix/directory_lock.h>

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace meltfront::verification
{
  DirectoryLock::DirectoryLock(const std::string &directory, IfHeld if_held)
  {
    std::error_code failure;
    std::filesystem::create_directories(directory, failure);
    const std::string path = directory + "/.lock";
    file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if(file < 0)
      throw cases::OutputError(
          fmt::format("cannot write to {}: {}", directory, std::strerror(errno)));
    // A record lock belongs to the process that takes it: unlike flock(), forked runs
    // that outlive it by a moment do not hold it.
    struct flock lock
    {
    };
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    if(if_held == IfHeld::fail)
    {
      if(fcntl(file, F_SETLK, &lock) == 0)
        return;
      close(file);
      throw cases::OutputError(
          fmt::format("another process is at work in {}", directory));
    }
    int result = 0;
    do
      result = fcntl(file, F_SETLKW, &lock);
    while(result != 0 && errno == EINTR);
    if(result == 0)
      return;
    const int problem = errno;
    close(file);
    throw cases::OutputError(
        fmt::format("cannot lock {}: {}", directory, std::strerror(problem)));
  }

  DirectoryLock::~DirectoryLock()
  {
    close(file);
  }
} // namespace meltfront::verification
