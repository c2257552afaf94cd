#include <verification/run/motion_observer.h>
#include <verification/run/run_measures.h>
#include <verification/run/run_observer.h>

namespace meltfront::verification
{
  std::unique_ptr<RunMeasures> measures_of(const cases::Case &c,
                                           const cases::Scene &simulated,
                                           const std::string &method,
                                           const cases::Capabilities &capabilities,
                                           cases::Observer *second, bool animated)
  {
    if(simulated.conducts_heat())
      return std::make_unique<RunObserver>(c, simulated, method, capabilities, second);
    return std::make_unique<MotionObserver>(c, simulated, method, second, animated);
  }
} // namespace meltfront::verification
