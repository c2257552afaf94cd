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
    /** @throws cases::OutputError if another process holds it or it cannot be written to.
     */
    explicit DirectoryLock(const std::string &directory);
    ~DirectoryLock();

    DirectoryLock(const DirectoryLock &) = delete;
    DirectoryLock &operator=(const DirectoryLock &) = delete;

  private:
    int file;
  };
} // namespace meltfront::verification

#endif
