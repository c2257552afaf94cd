#include <verification/record/provenance.h>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <sys/utsname.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    std::string processor()
    {
      std::ifstream in("/proc/cpuinfo");
      for(std::string line; std::getline(in, line);)
        if(line.starts_with("model name"))
          return fmt::format("{}, {} threads", line.substr(line.find(':') + 2),
                             std::thread::hardware_concurrency());
      return "unknown";
    }

    std::string operating_system()
    {
      utsname name;
      if(uname(&name) != 0)
        return "unknown";
      return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
    }
  } // namespace

  std::map<std::string, std::string> build_provenance()
  {
    return {{"compiler", MELTFRONT_COMPILER},
            {"flags", MELTFRONT_FLAGS},
            {"packages", MELTFRONT_PACKAGES},
            {"cpu", processor()},
            {"system", operating_system()}};
  }

  std::string current_date()
  {
    const auto now
        = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(now));
  }
} // namespace meltfront::verification
