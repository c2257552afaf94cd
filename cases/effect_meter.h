#ifndef meltfront_cases_effect_meter_h
#define meltfront_cases_effect_meter_h

#include <cases/method.h>

#include <algorithm>
#include <chrono>

namespace meltfront::cases
{
  /**
   * Counts how often an effect's code is entered and estimates the time spent there.
   *
   * Reading a clock costs about as much as a pass over a hundred particles, so one call
   * in 16 is timed and stands for the others.
   */
  class EffectMeter
  {
  public:
    /** Run one pass of the effect. */
    template <typename Pass>
    auto measure(const Pass &pass)
    {
      if(++calls % interval != 0)
        return pass();
      const Timer timer(timed_seconds);
      ++timed_calls;
      return pass();
    }

    /** Run a part of the effect's set-up, which is always timed. */
    template <typename Pass>
    auto measure_setup(const Pass &pass)
    {
      const Timer timer(setup_seconds);
      return pass();
    }

    EffectCost cost(Effect effect, std::size_t bytes) const
    {
      const double share = timed_calls > 0 ? double(calls) / timed_calls : 0;
      const double seconds = std::max(0., timed_seconds - timed_calls * clock_seconds());
      return {effect, calls, static_cast<long>(bytes), setup_seconds + share * seconds};
    }

  private:
    static constexpr long interval = 16;

    /** What reading the clock adds to a timed pass. */
    static double clock_seconds()
    {
      static const double cost = []
      {
        constexpr int repeats = 1000;
        double nothing = 0;
        for(int i = 0; i < repeats; ++i)
          const Timer timer(nothing);
        return nothing / repeats;
      }();
      return cost;
    }

    class Timer
    {
    public:
      explicit Timer(double &seconds)
        : total(seconds)
        , start(std::chrono::steady_clock::now())
      {
      }

      ~Timer()
      {
        total += std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
                     .count();
      }

      Timer(const Timer &) = delete;
      Timer &operator=(const Timer &) = delete;

    private:
      double &total;
      std::chrono::steady_clock::time_point start;
    };

    long calls = 0;
    long timed_calls = 0;
    double timed_seconds = 0;
    double setup_seconds = 0;
  };
} // namespace meltfront::cases

#endif
