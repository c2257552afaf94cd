#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/crowd.h>
#include <particles/benchmarks/table.h>
#include <particles/rkpm/moment_engine.h>
#include <particles/rkpm/supports.h>

#include <string>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    /** What a row is made of, and what it may cost. */
    struct MomentCase
    {
      const char *name;
      rkpm::Variant variant;
      int dimension;
      int per_side;
      int order;
      double most_nanoseconds; ///< per particle; 0: no target
    };

    constexpr MomentCase moment_cases[]
        = {{"2D small, order 2", rkpm::Variant::derivative_free, 2, 100, 2, 5000},
           {"2D, order 2, kernel differentiated", rkpm::Variant::point_collocation, 2,
            100, 2, 0},
           {"2D, order 4", rkpm::Variant::derivative_free, 2, 100, 4, 0},
           {"3D, order 2", rkpm::Variant::derivative_free, 3, 20, 2, 0},
           {"3D, order 4", rkpm::Variant::derivative_free, 3, 20, 4, 0}};

    /** Weights of all derivatives up to the second at each particle, supports given. */
    void weigh(benchmark::State &state, const MomentCase &chosen)
    {
      const Crowd crowd({chosen.name, chosen.dimension, chosen.per_side, 2});
      const ParticleStorage &particles = crowd.particles;
      rkpm::MomentEngine engine(
          {chosen.variant, KernelShape::wendland_c4, chosen.dimension, chosen.order});
      const std::vector<int> never(particles.size(), 0);
      const rkpm::Supports supports
          = rkpm::find_supports(particles, particles, {}, engine.basis().size(), never);
      for(auto _ : state)
        for(std::size_t a = 0; a < particles.size(); ++a)
          benchmark::DoNotOptimize(engine.evaluate(particles.point(a), particles,
                                                   supports[a], supports.dilation[a]));
      PassSize pass;
      pass.particles = static_cast<double>(particles.size());
      pass.items = pass.particles;
      pass.most_nanoseconds = chosen.most_nanoseconds;
      set_size(state, pass, "particle");
    }
  } // namespace

  void register_moment_benchmarks()
  {
    for(const MomentCase &chosen : moment_cases)
      benchmark::RegisterBenchmark(
          (std::string("reproducing weights, ") + chosen.name).c_str(),
          [chosen](benchmark::State &state) { weigh(state, chosen); });
  }
} // namespace meltfront::particles::benchmarks
