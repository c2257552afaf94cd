#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/crowd.h>
#include <particles/benchmarks/table.h>
#include <particles/sph/front_exchange.h>

#include <fmt/format.h>

#include <memory>
#include <numeric>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    constexpr CrowdSize in_cache[] = {{"2D small", 2, 40, 2}, {"2D", 2, 160, 2}};
    constexpr CrowdSize beyond_cache[] = {{"2D", 2, 1200, 2}, {"3D", 3, 80, 2}};

    /** A crowd is made when its first benchmark runs, and kept for the next. */
    Crowd &crowd_of(const CrowdSize &size)
    {
      static std::unique_ptr<Crowd> crowd;
      static const CrowdSize *made = nullptr;
      if(made != &size)
      {
        crowd.reset();
        crowd = std::make_unique<Crowd>(size);
        made = &size;
      }
      return *crowd;
    }

    /** Size of a sweep over some fields: the operator, and each field read and written
     * once. */
    PassSize sweep_size(const Crowd &crowd, int fields, int threads)
    {
      PassSize size;
      size.particles = static_cast<double>(crowd.particles.size());
      size.items = static_cast<double>(crowd.rows.interactions());
      size.bytes = static_cast<double>(crowd.rows.bytes()
                                       + fields * 2 * 8 * crowd.rows.padded_rows());
      size.threads = threads;
      return size;
    }

    void matrix_product(benchmark::State &state, const CrowdSize &size, int threads)
    {
      Crowd &crowd = crowd_of(size);
      for(auto _ : state)
      {
        crowd.rows.apply(crowd.u, crowd.result, threads);
        benchmark::ClobberMemory();
      }
      PassSize pass = sweep_size(crowd, 1, threads);
      if(&size >= std::begin(beyond_cache) && &size < std::end(beyond_cache))
        pass.least_share = 0.6;
      else
        pass.most_nanoseconds = 0.6;
      set_size(state, pass, "interaction");
    }

    std::vector<std::uint32_t> all_slices(const ParticleOperator &rows)
    {
      std::vector<std::uint32_t> slices(rows.slices());
      std::iota(slices.begin(), slices.end(), 0);
      return slices;
    }

    /** A sweep in which every row takes the exchange at fronts. */
    template <typename Pair>
    void exchange(benchmark::State &state, const CrowdSize &size, double most_nanoseconds,
                  const Pair &pair)
    {
      Crowd &crowd = crowd_of(size);
      const auto chosen = all_slices(crowd.rows);
      const FrontState front{crowd.u.data(), crowd.enthalpy.data()};
      for(auto _ : state)
      {
        crowd.rows.apply_to_slices(chosen, pair(front), crowd.result);
        benchmark::ClobberMemory();
      }
      PassSize pass = sweep_size(crowd, 1, 1);
      pass.most_nanoseconds = most_nanoseconds;
      set_size(state, pass, "interaction");
    }

    /** Heat and a solute in one sweep: the solute diffuses in the liquid of both partners
     * only. */
    void heat_and_solute(benchmark::State &state, const CrowdSize &size, int threads)
    {
      Crowd &crowd = crowd_of(size);
      const double *u = crowd.u.data(), *solute = crowd.solute.data();
      const auto heat = [u](std::size_t a, std::size_t b) { return u[b] - u[a]; };
      const auto diffusion = [u, solute](std::size_t a, std::size_t b)
      {
        const double difference = solute[b] - solute[a];
        return (u[a] > 0) & (u[b] > 0) ? difference : 0.;
      };
      for(auto _ : state)
      {
        crowd.rows.apply_pairs(heat, diffusion, crowd.result, crowd.result_2, threads);
        benchmark::ClobberMemory();
      }
      set_size(state, sweep_size(crowd, 2, threads), "interaction");
    }

    HarmonicPair harmonic(FrontState state)
    {
      return {state, 2. / 3, 4. / 3, false};
    }

    SubParticlePair sub_particle(FrontState state)
    {
      return {state, latent_heat};
    }

    template <typename Body>
    void add(const std::string &what, const CrowdSize &size, const Body &body)
    {
      benchmark::RegisterBenchmark(fmt::format("{}, {}", what, size.name).c_str(), body)
          ->UseRealTime();
    }
  } // namespace

  void register_operator_benchmarks()
  {
    for(const CrowdSize &size : in_cache)
    {
      add("matrix product in cache", size,
          [&size](benchmark::State &state) { matrix_product(state, size, 1); });
      add("harmonic mean in cache", size,
          [&size](benchmark::State &state) { exchange(state, size, 1.3, harmonic); });
      add("front within the particle in cache", size,
          [&size](benchmark::State &state) { exchange(state, size, 0, sub_particle); });
    }
    for(const CrowdSize &size : in_cache)
      add("heat and solute together in cache", size,
          [&size](benchmark::State &state) { heat_and_solute(state, size, 1); });
    for(const CrowdSize &size : beyond_cache)
    {
      for(const int threads : {1, 2})
      {
        add("matrix product beyond cache", size,
            [&size, threads](benchmark::State &state)
            { matrix_product(state, size, threads); });
        add("heat and solute together beyond cache", size,
            [&size, threads](benchmark::State &state)
            { heat_and_solute(state, size, threads); });
      }
      add("harmonic mean beyond cache", size,
          [&size](benchmark::State &state) { exchange(state, size, 1.3, harmonic); });
    }
  }
} // namespace meltfront::particles::benchmarks
