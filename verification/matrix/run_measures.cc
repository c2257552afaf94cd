#include <verification/matrix/motion_observer.h>
#include <verification/matrix/run_measures.h>
#include <verification/matrix/run_observer.h>

namespace meltfront::verification
{
  std::unique_ptr<RunMeasures> measures_of(const cases::Case &c,
                                           const cases::Scene &simulated,
                                           const std::string &method,
                                           cases::Observer *second)
  {
    if(simulated.conducts_heat())
      return std::make_unique<RunObserver>(c, simulated, method, second);
    return std::make_unique<MotionObserver>(c, simulated, method, second);
  }
} // namespace meltfront::verification
