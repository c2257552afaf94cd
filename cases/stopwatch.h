#ifndef meltfront_cases_stopwatch_h
#define meltfront_cases_stopwatch_h

#include <chrono>
#include <ctime>

namespace meltfront::cases
{
  /** Adds the wall time of a scope to a sum of seconds. */
  class ScopedTimer
  {
  public:
    explicit ScopedTimer(double &seconds)
      : seconds(seconds)
      , start(std::chrono::steady_clock::now())
    {
    }

    ScopedTimer(const ScopedTimer &) = delete;
    ScopedTimer &operator=(const ScopedTimer &) = delete;

    ~ScopedTimer()
    {
      const std::chrono::duration<double> elapsed
          = std::chrono::steady_clock::now() - start;
      seconds += elapsed.count();
    }

  private:
    double &seconds;
    std::chrono::steady_clock::time_point start;
  };

  /** Wall and processor time of the process, with pauses taken out. */
  class Stopwatch
  {
  public:
    struct Seconds
    {
      double wall = 0, cpu = 0;
    };

    Stopwatch()
      : started(now())
    {
    }

    /** Time since construction or the last restart, pauses excluded. */
    Seconds elapsed() const
    {
      const Seconds time = now();
      return {time.wall - started.wall - paused.wall,
              time.cpu - started.cpu - paused.cpu};
    }

    void restart()
    {
      started = now();
      paused = {};
    }

    /** Run a function whose time does not count. */
    template <typename Function>
    auto without(const Function &function)
    {
      const Pause pause(*this);
      return function();
    }

  private:
    /** Ends also where the function throws. */
    struct Pause
    {
      explicit Pause(Stopwatch &watch)
        : watch(watch)
        , begin(now())
      {
      }
      ~Pause()
      {
        const Seconds end = now();
        watch.paused.wall += end.wall - begin.wall;
        watch.paused.cpu += end.cpu - begin.cpu;
      }
      Stopwatch &watch;
      Seconds begin;
    };

    static Seconds now()
    {
      const std::chrono::duration<double> wall
          = std::chrono::steady_clock::now().time_since_epoch();
      std::timespec cpu{};
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
      return {wall.count(), static_cast<double>(cpu.tv_sec) + 1e-9 * cpu.tv_nsec};
    }

    Seconds started, paused;
  };
} // namespace meltfront::cases

#endif
