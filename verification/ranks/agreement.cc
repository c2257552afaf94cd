#include <verification/ranks/agreement.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <exception>
#include <thread>

namespace meltfront::verification
{
  void together(MPI_Comm communicator, const std::function<void()> &what)
  {
    std::exception_ptr error;
    try
    {
      what();
    }
    catch(...)
    {
      error = std::current_exception();
    }
    const bool any = dealii::Utilities::MPI::max(error ? 1 : 0, communicator) > 0;
    if(error)
      std::rethrow_exception(error);
    if(any)
      throw OtherRankFailed();
  }

  bool meet(MPI_Comm communicator, double seconds)
  {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds polling_pause{1};
    MPI_Request all_here;
    MPI_Ibarrier(communicator, &all_here);
    const Clock::time_point start = Clock::now();
    for(int here = 0;;)
    {
      MPI_Test(&all_here, &here, MPI_STATUS_IGNORE);
      if(here)
        return true;
      const std::chrono::duration<double> waited = Clock::now() - start;
      if(waited.count() > seconds)
        return false;
      std::this_thread::sleep_for(polling_pause);
    }
  }
} // namespace meltfront::verification
