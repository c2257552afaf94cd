#include <cases/error.h>
#include <verification/record/temporary_directory.h>

#include <cstdlib>

namespace meltfront::verification
{
  TemporaryDirectory::TemporaryDirectory()
  {
    const std::filesystem::path place = std::filesystem::temp_directory_path();
    // mkdtemp replaces the six letters at the end of its pattern.
    std::string pattern = (place / ("meltfront-" + std::string(6, 'X'))).string();
    if(!mkdtemp(pattern.data()))
      throw cases::OutputError("cannot make a temporary directory in " + place.string());
    directory = pattern;
  }

  TemporaryDirectory::~TemporaryDirectory()
  {
    std::error_code ignored;
    std::filesystem::remove_all(directory, ignored);
  }
} // namespace meltfront::verification
