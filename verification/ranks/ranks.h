#ifndef meltfront_verification_ranks_ranks_h
#define meltfront_verification_ranks_ranks_h

#include <functional>
#include <memory>
#include <string>

namespace meltfront::verification
{
  /** On how many ranks mpirun, or another launcher of MPI, has started this program, as
   * its environment tells (OMPI_COMM_WORLD_SIZE, PMI_SIZE); 1 where none has. */
  int started_ranks();

  /**
   * MPI on the ranks that this process was started on, from construction to the end; one
   * in a program. What ranks other than the first would print goes nowhere.
   */
  class RankSession
  {
  public:
    RankSession(int &argc, char **&argv);
    /** Of this process alone, which was not started as one of several. */
    RankSession();
    ~RankSession();

    /** Of this process; the first, 0, prints and writes. */
    int rank() const;
    int size() const;

    /** Do something on the first rank only. @return its result, on all ranks
     * @throws on all ranks what it throws: cases::InputError, cases::Refusal, else
     * cases::OutputError */
    std::string on_first(const std::function<std::string()> &what) const;

    /** Wait for the others at the end of the program. Where it ends with an error the
     * others may not know of it: they are ended after ten seconds.
     * @param sentence that was said of the error, or empty */
    void end_together(const std::string &sentence, int status) const;

    /**
     * Say one sentence, whatever rank this is, and end all ranks with a status: where the
     * others wait for this one and do not know that it has failed.
     */
    [[noreturn]] void abort(const std::string &sentence, int status) const;

  private:
    struct Started;
    std::unique_ptr<Started> started;
  };
} // namespace meltfront::verification

#endif
