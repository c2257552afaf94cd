#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/table.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/motion.h>

#include <fmt/format.h>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    constexpr double most_nanoseconds = 30;

    /** A free crystal that equipartitions to half the temperature it is made with. */
    greenspan::Motion crystal(int per_side, int threads)
    {
      using namespace greenspan;
      MotionParameters parameters;
      parameters.force = PairForce::triangle();
      parameters.gravity = 0;
      parameters.threads = threads;
      ParticleState state = HexagonalLattice::rectangle(
          per_side, per_side, parameters.force.equilibrium_distance());
      set_temperature(state, 2.626, 1);
      return {parameters, state};
    }

    void step(benchmark::State &state, int per_side, int threads)
    {
      greenspan::Motion motion = crystal(per_side, threads);
      motion.advance(1);
      const long steps = std::max(1L, 200000L / static_cast<long>(motion.size()));
      for(auto _ : state)
        motion.advance(steps);
      PassSize pass;
      pass.particles = static_cast<double>(motion.size());
      pass.items = static_cast<double>(motion.size()) * static_cast<double>(steps);
      pass.threads = threads;
      pass.most_nanoseconds = threads == 1 ? most_nanoseconds : 0;
      set_size(state, pass, "particle step");
    }
  } // namespace

  void register_solid_benchmarks()
  {
    for(const auto &[per_side, threads, name] : {std::tuple{32, 1, "small"},
                                                 {100, 1, "1e4"},
                                                 {316, 1, "1e5"},
                                                 {1000, 1, "1e6"},
                                                 {1000, 2, "1e6"}})
      benchmark::RegisterBenchmark(
          fmt::format("particle solid, leapfrog, {}", name).c_str(),
          [per_side = per_side, threads = threads](benchmark::State &state)
          { step(state, per_side, threads); })
          ->UseRealTime();
  }
} // namespace meltfront::particles::benchmarks
