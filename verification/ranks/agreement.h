#ifndef meltfront_verification_ranks_agreement_h
#define meltfront_verification_ranks_agreement_h

#include <mpi.h>

#include <functional>
#include <stdexcept>

namespace meltfront::verification
{
  /** Another rank has failed, which says why. */
  class OtherRankFailed : public std::runtime_error
  {
  public:
    OtherRankFailed()
      : std::runtime_error("another rank has failed")
    {
    }
  };

  /**
   * Do something on every rank that others may fail at: what it throws on one rank ends
   * it on all. On that rank the exception goes on, on the others it is OtherRankFailed.
   */
  void together(MPI_Comm communicator, const std::function<void()> &what);

  /** Wait for all ranks to come here, so many seconds at most. @return whether they have
   */
  bool meet(MPI_Comm communicator, double seconds);
} // namespace meltfront::verification

#endif
