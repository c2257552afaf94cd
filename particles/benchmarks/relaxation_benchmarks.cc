#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/table.h>
#include <particles/relaxation/lennard_jones.h>

#include <random>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    /** Random particles in the unit square, others on its walls as a lattice has them. */
    struct Square
    {
      explicit Square(int side)
      {
        const int intervals = side + 1;
        relaxation.potential.length = 1. / intervals;
        std::mt19937_64 generator(1);
        const auto uniform
            = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
        for(int i = 0; i < side * side; ++i)
        {
          const double x = uniform(), y = uniform();
          moving.add({x, y, 0});
        }
        for(int i = 0; i < intervals; ++i)
        {
          const double s = i / double(intervals);
          fixed.add({s, 0, 0});
          fixed.add({1, s, 0});
          fixed.add({1 - s, 1, 0});
          fixed.add({0, 1 - s, 0});
        }
      }

      Descent relax()
      {
        return relax_by_lennard_jones(moving, fixed, {2, {0, 0, 0}, {1, 1, 1}},
                                      relaxation);
      }

      ParticleStorage moving{2, {}}, fixed{2, {}};
      LennardJonesRelaxation relaxation;
    };

    /** One energy with its gradient, particles sorted and a little relaxed. */
    void evaluate(benchmark::State &state, int side)
    {
      Square square(side);
      square.relaxation.most_iterations = 100;
      square.relax();
      const LennardJones &potential = square.relaxation.potential;
      reorder(square.moving,
              order_along_curve(square.moving, potential.cutoff * potential.length));
      LennardJonesEnergy energy(2, square.fixed, potential, 1);
      Coordinates gradient = square.moving.position;
      for(auto _ : state)
        benchmark::DoNotOptimize(energy(square.moving.position, gradient));
      PassSize pass;
      pass.particles = pass.items = static_cast<double>(square.moving.size());
      set_size(state, pass, "particle");
    }

    /** From random places to where a relaxation stops by itself. */
    void relax(benchmark::State &state, int side)
    {
      const Square start(side);
      for(auto _ : state)
      {
        Square square = start;
        benchmark::DoNotOptimize(square.relax().energy);
      }
      PassSize pass;
      pass.particles = pass.items = static_cast<double>(start.moving.size());
      // A hundred thousand particles in three minutes.
      pass.most_nanoseconds = 1.8e6;
      set_size(state, pass, "particle");
    }

    void add(const char *name, void (*run)(benchmark::State &, int), int side)
    {
      benchmark::RegisterBenchmark(name, run, side);
    }
  } // namespace

  void register_relaxation_benchmarks()
  {
    add("Lennard-Jones energy, small", evaluate, 40);
    add("Lennard-Jones energy", evaluate, 316);
    add("whole relaxation, small", relax, 20);
    add("whole relaxation", relax, 100);
  }
} // namespace meltfront::particles::benchmarks
