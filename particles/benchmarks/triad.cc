#include <cases/stopwatch.h>
#include <particles/benchmarks/triad.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meltfront::particles::benchmarks
{
  double triad_bandwidth(int threads)
  {
    constexpr std::size_t size = std::size_t(1) << 24; // 128 MiB for each array
    constexpr int repeats = 6;
    std::vector<double> a(size, 0.), b(size, 1.), c(size, 2.);
    double *result = a.data();
    const double *first = b.data(), *second = c.data();
    double best = 0;
    for(int repeat = 0; repeat < repeats; ++repeat)
    {
      const double factor = 3 + repeat;
      const cases::Stopwatch watch;
#pragma omp parallel for simd schedule(static) num_threads(threads)
      for(std::size_t i = 0; i < size; ++i)
        result[i] = first[i] + factor * second[i];
      const cases::Stopwatch::Seconds elapsed = watch.elapsed();
      best = std::max(best, 24. * size / (threads == 1 ? elapsed.cpu : elapsed.wall));
    }
    return best;
  }
} // namespace meltfront::particles::benchmarks
