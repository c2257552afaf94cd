#ifndef meltfront_verification_matrix_run_claim_h
#define meltfront_verification_matrix_run_claim_h

#include <optional>
#include <string>

namespace meltfront::verification
{
  /** Who holds a claim: a process of a machine, since a time. */
  struct ClaimHolder
  {
    std::string host;
    long process = 0;
    /** What tells the process from a later one of its number: the boot of its machine and
     * the clock ticks from there to its start. */
    std::string start;

    /** This process. */
    static ClaimHolder self();

    /** Whether this is another machine, of whose processes nothing can be known here. */
    bool elsewhere() const;

    /** Whether the process is there still; asked on its own machine. */
    bool lives() const;
  };

  /**
   * A run's claim: the file that says which process makes it, on whatever machine, so
   * that several processes share the work of a matrix in one folder. The file appears
   * whole and at most once (a hard link, which a network's file system makes atomically
   * too) and goes with this object.
   *
   * A claim whose process has died without removing it is taken over: at once if it was
   * one of this machine; of another, where a process cannot be asked for, once the file
   * is older than `stale_after`; or when a user removes it.
   */
  class RunClaim
  {
  public:
    /**
     * @param path of the claim; its folder is there
     * @param stale_after s, longer than any process of another machine holds a claim
     * @return nothing if a process that lives holds it
     * @throws cases::OutputError if the file cannot be written
     */
    static std::optional<RunClaim> take(const std::string &path, double stale_after);

    /** Whether take() would be refused. */
    static bool held(const std::string &path, double stale_after);

    RunClaim(RunClaim &&other) noexcept;
    RunClaim &operator=(RunClaim &&other) noexcept;
    ~RunClaim();

  private:
    explicit RunClaim(std::string path);

    std::string path; ///< empty: of none
  };
} // namespace meltfront::verification

#endif
