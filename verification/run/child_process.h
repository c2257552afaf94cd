#ifndef meltfront_verification_run_child_process_h
#define meltfront_verification_run_child_process_h

#include <sys/types.h>

#include <functional>
#include <string>

namespace meltfront::verification
{
  /** How a child process ended. */
  struct ChildEnd
  {
    int exit_status = 0; ///< of one that left by itself
    int signal = 0;      ///< that killed it, 0 for none
    double peak_memory_mb = 0;

    /** `crashed (Segmentation fault)`, `ended with status 3`; empty for status 0. */
    std::string problem() const;
  };

  /**
   * A function that runs in a forked process of its own: its crash is not the caller's,
   * its memory can be measured, its time limited. It dies with its parent, also when that
   * is killed. The calling process must not have started threads.
   */
  class ChildProcess
  {
  public:
    /**
     * Fork and run the function; an exception that it throws ends the child with
     * status 1. What it prints goes to `log`, a file that is removed if it stays empty.
     * @throws cases::OutputError if no process can be started.
     */
    ChildProcess(const std::function<void()> &function, const std::string &log);

    ChildProcess(ChildProcess &&other) noexcept;
    ChildProcess &operator=(ChildProcess &&other) noexcept;

    /** Kills the child if it is still there. */
    ~ChildProcess();

    /** True once the child has ended; does not wait. */
    bool ended();

    /** How it ended, once ended() is true. */
    const ChildEnd &end() const;

    /** Kill the child and wait for its end. */
    void kill();

  private:
    void take_end(int status, long peak_kilobytes);

    pid_t process = -1; ///< -1 once it has ended
    std::string log;
    ChildEnd how;
  };
} // namespace meltfront::verification

#endif
