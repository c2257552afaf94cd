#ifndef meltfront_particles_sph_stopwatch_h
#define meltfront_particles_sph_stopwatch_h

#include <chrono>
#include <ctime>

namespace meltfront::particles
{
  /** Wall time and CPU time of all threads, leaving out what is paused. */
  class Stopwatch
  {
  public:
    Stopwatch()
    {
      resume();
    }

    void pause()
    {
      wall_seconds
          += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start)
                 .count();
      cpu_seconds += process_seconds() - cpu_start;
    }

    void resume()
    {
      wall_start = std::chrono::steady_clock::now();
      cpu_start = process_seconds();
    }

    /** Seconds until the last pause. */
    double wall() const
    {
      return wall_seconds;
    }

    double cpu() const
    {
      return cpu_seconds;
    }

  private:
    static double process_seconds()
    {
      timespec now{};
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
      return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }

    std::chrono::steady_clock::time_point wall_start;
    double cpu_start = 0;
    double wall_seconds = 0;
    double cpu_seconds = 0;
  };
} // namespace meltfront::particles

#endif
