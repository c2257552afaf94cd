#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/crowd.h>
#include <particles/benchmarks/table.h>

#include <string>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    constexpr double most_nanoseconds = 50;

    constexpr CrowdSize sizes[] = {{"2D small", 2, 160, 2},
                                   {"2D", 2, 500, 2},
                                   {"2D, h = 1.3 dp", 2, 500, 2.6},
                                   {"3D", 3, 80, 2}};

    void build(benchmark::State &state, const CrowdSize &size)
    {
      const Crowd crowd(size);
      for(auto _ : state)
      {
        const NeighbourList list(crowd.particles, crowd.radius);
        benchmark::DoNotOptimize(list.size());
      }
      PassSize pass;
      pass.particles = static_cast<double>(crowd.particles.size());
      pass.items = static_cast<double>(crowd.neighbours.size());
      pass.most_nanoseconds = most_nanoseconds;
      set_size(state, pass, "stored pair");
    }
  } // namespace

  void register_neighbour_benchmarks()
  {
    for(const CrowdSize &size : sizes)
      benchmark::RegisterBenchmark((std::string("neighbour list, ") + size.name).c_str(),
                                   [size](benchmark::State &state)
                                   { build(state, size); });
  }
} // namespace meltfront::particles::benchmarks
