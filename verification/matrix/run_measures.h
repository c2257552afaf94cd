#ifndef meltfront_verification_matrix_run_measures_h
#define meltfront_verification_matrix_run_measures_h

#include <cases/capabilities.h>
#include <cases/case.h>
#include <cases/method.h>
#include <verification/matrix/run_record.h>

#include <memory>

namespace meltfront::verification
{
  /** Times at which a run that is measured at every step is drawn. */
  inline constexpr int samples_of_every_step = 200;

  /** Measures a run while it goes on. */
  class RunMeasures : public cases::Observer
  {
  public:
    /** @throws NumericalError if the method did not take the run to its end. */
    virtual void require_end() const = 0;

    /** Write what is known of a run however it ended. */
    virtual void keep_course(RunRecord &record) const = 0;

    /** Write what is known of a run that reached its end. */
    virtual void keep_results(RunRecord &record) const = 0;
  };

  /**
   * The measures that the case's kind of problem asks for.
   * @param c the case, which outlives them
   * @param simulated the case's scene as it is handed to the method, outlives them too
   * @param method its name, for messages
   * @param capabilities of the method's form that takes the scene
   * @param second receives what it wants of the same run, or null
   * @param animated whether frames are to be kept throughout the run too
   */
  std::unique_ptr<RunMeasures>
  measures_of(const cases::Case &c, const cases::Scene &simulated,
              const std::string &method, const cases::Capabilities &capabilities,
              cases::Observer *second, bool animated = false);
} // namespace meltfront::verification

#endif
