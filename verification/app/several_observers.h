#ifndef meltfront_verification_app_several_observers_h
#define meltfront_verification_app_several_observers_h

#include <cases/method.h>

#include <vector>

namespace meltfront::verification
{
  /** Observers in place of one; each tells by itself which snapshots it wants, and looks
   * at no others. */
  class SeveralObservers : public cases::Observer
  {
  public:
    explicit SeveralObservers(std::vector<cases::Observer *> all)
      : all(std::move(all))
    {
    }

    void begin(const cases::RunDescription &description) override
    {
      for(cases::Observer *one : all)
        one->begin(description);
    }

    bool wants(long step, double time) override
    {
      bool wanted = false;
      for(cases::Observer *one : all)
        wanted = one->wants(step, time) || wanted;
      return wanted;
    }

    void observe(const cases::Snapshot &snapshot) override
    {
      for(cases::Observer *one : all)
        if(one->wants(snapshot.step, snapshot.time))
          one->observe(snapshot);
    }

  private:
    std::vector<cases::Observer *> all;
  };
} // namespace meltfront::verification

#endif
