#include <verification/record/hash.h>
#include <verification/record/provenance.h>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <link.h>
#include <sys/utsname.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

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

    std::map<std::string, std::string> &plugin_hashes()
    {
      static std::map<std::string, std::string> hashes;
      return hashes;
    }

    /** Called with each object that the process has loaded. */
    int add_own_library(dl_phdr_info *object, std::size_t, void *files)
    {
      const std::filesystem::path path = object->dlpi_name;
      if(path.filename().string().starts_with("libmeltfront_"))
        static_cast<std::vector<std::string> *>(files)->push_back(path);
      return 0;
    }

    std::vector<std::string> own_libraries()
    {
      std::vector<std::string> files;
      dl_iterate_phdr(add_own_library, &files);
      std::ranges::sort(files);
      return files;
    }

    /** The level that the particle methods were compiled for, where the loader chose
     * among several: `x86-64-v3` of `.../glibc-hwcaps/x86-64-v3/...`. */
    std::string kernels()
    {
      const std::string folder = "/glibc-hwcaps/";
      for(const std::string &file : own_libraries())
        if(const auto found = file.find(folder); found != std::string::npos)
        {
          const auto begin = found + folder.size();
          return file.substr(begin, file.find('/', begin) - begin);
        }
      return "as the flags say";
    }
  } // namespace

  std::string program_hash()
  {
    std::string hashes = sha256_of_file("/proc/self/exe");
    for(const std::string &file : own_libraries())
      hashes += sha256_of_file(file);
    return sha256(hashes);
  }

  void note_plugin(const std::string &method, const std::string &hash)
  {
    plugin_hashes()[method] = hash;
  }

  std::map<std::string, std::string> method_provenance(const cases::Method &method,
                                                       const cases::Options &options)
  {
    std::map<std::string, std::string> result = method.further_provenance(options);
    const auto plugin = plugin_hashes().find(method.name());
    if(plugin != plugin_hashes().end())
      result["plugin_hash"] = plugin->second;
    return result;
  }

  std::map<std::string, std::string> build_provenance()
  {
    return {{"compiler", MELTFRONT_COMPILER},
            {"flags", MELTFRONT_FLAGS},
            {"kernels", kernels()},
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
