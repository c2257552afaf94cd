#ifndef meltfront_verification_ranks_part_observer_h
#define meltfront_verification_ranks_part_observer_h

#include <cases/method.h>

#include <string>

namespace meltfront::verification
{
  /** Observes a rank's part of a run, and can take the place of one that observed the
   * same run until it was left, on whatever ranks. */
  class PartObserver : public cases::Observer
  {
  public:
    /** What one has to know that goes on: the same on all ranks. */
    virtual std::string state() const = 0;

    /** Go on from a state(), in place of begin(). */
    virtual void go_on_from(const std::string &state) = 0;
  };
} // namespace meltfront::verification

#endif
