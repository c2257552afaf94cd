#ifndef meltfront_verification_matrix_directory_lock_h
#define meltfront_verification_matrix_directory_lock_h

#include <string>

namespace meltfront::verification
{
  /** Holds a directory for this process, not for its children, as long as it lives; the
   * kernel gives it free when the process dies. */
  class DirectoryLock
  {
  public:
    /** What is to be done if another process holds it. */
    enum class IfHeld
    {
      fail,
      wait
    };

    /** @throws cases::OutputError if it cannot be written to, or if another process holds
     * it and that is to `fail`. */
    explicit DirectoryLock(const std::string &directory, IfHeld if_held = IfHeld::fail);
    ~DirectoryLock();

    DirectoryLock(const DirectoryLock &) = delete;
    DirectoryLock &operator=(const DirectoryLock &) = delete;

  private:
    int file;
  };
} // namespace meltfront::verification

#endif
