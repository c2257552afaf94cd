#include <cases/data_folder.h>
#include <cases/error.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <filesystem>

namespace meltfront::cases
{
  namespace
  {
    std::string found_data_folder()
    {
      namespace fs = std::filesystem;
      static const char in_this_library = 0;
      Dl_info library{};
      dladdr(&in_this_library, &library);
      const fs::path folder
          = fs::absolute(library.dli_fname).parent_path() / "../../share/meltfront";
      std::error_code failure;
      const fs::path resolved = fs::canonical(folder, failure);
      if(failure)
        throw OutputError(fmt::format("{}: cannot be read ({}); the files that meltfront "
                                      "reads are to stand there, beside its libraries",
                                      folder.lexically_normal().string(),
                                      failure.message()));
      return resolved.string();
    }
  } // namespace

  const std::string &data_folder()
  {
    static const std::string folder = found_data_folder();
    return folder;
  }

  std::string data_path(const std::string &path)
  {
    return data_folder() + "/" + path;
  }

  std::string program_call()
  {
    return std::filesystem::exists(data_path("meltfront")) ? "./meltfront" : "meltfront";
  }
} // namespace meltfront::cases
