#ifndef meltfront_verification_record_temporary_directory_h
#define meltfront_verification_record_temporary_directory_h

#include <filesystem>
#include <string>

namespace meltfront::verification
{
  /** A directory of one's own among the system's temporary ones, removed with the object.
   */
  class TemporaryDirectory
  {
  public:
    /** @throws OutputError if it cannot be made. */
    TemporaryDirectory();
    ~TemporaryDirectory();
    TemporaryDirectory(const TemporaryDirectory &) = delete;
    TemporaryDirectory &operator=(const TemporaryDirectory &) = delete;

    /** Its path, or that of a file in it. */
    std::filesystem::path path(const std::string &name = "") const
    {
      return name.empty() ? directory : directory / name;
    }

  private:
    std::filesystem::path directory;
  };
} // namespace meltfront::verification

#endif
