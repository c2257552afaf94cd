#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/table.h>
#include <particles/level_set/advection.h>
#include <particles/level_set/reinitialisation.h>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    using level_set::Grid;
    using level_set::LevelSet;

    /** A round front in the middle of the unit square or cube that turns about it. */
    struct RoundFront
    {
      RoundFront(int cells, int dimension)
        : grid(dimension, {}, 1. / cells, {cells, cells, cells})
        , front(grid,
                [dimension](const cases::Position &p)
                {
                  const double z = dimension == 3 ? p[2] - 0.5 : 0;
                  return 0.25 - std::hypot(p[0] - 0.5, p[1] - 0.5, z);
                })
        , turning({}, 1, {0.5, 0.5, 0})
        , velocity(level_set::velocity_function(turning))
      {
      }

      void step()
      {
        ++steps;
        advection.step(front, velocity, {steps, 0, 0.5 * grid.spacing() / 0.35});
        if(steps % 10 == 0)
          reinitialise(front);
      }

      Grid grid;
      LevelSet front;
      cases::RigidMotion turning;
      level_set::VelocityFunction velocity;
      level_set::Advection advection;
      level_set::Reinitialisation reinitialise;
      long steps = 0;
    };

    /** Ten steps with the reinitialisation that belongs to them. */
    void advance(benchmark::State &state, int cells, int dimension)
    {
      RoundFront round(cells, dimension);
      for(auto _ : state)
        for(int step = 0; step < 10; ++step)
          round.step();
      PassSize pass;
      pass.particles = double(round.front.band().size());
      pass.items = 10 * pass.particles;
      set_size(state, pass, "node of band");
    }

    void add(const char *name, int cells, int dimension)
    {
      benchmark::RegisterBenchmark(name, advance, cells, dimension);
    }
  } // namespace

  void register_level_set_benchmarks()
  {
    add("level set, small, n = 40", 40, 2);
    add("level set, n = 80", 80, 2);
    add("level set, n = 160", 160, 2);
    add("level set, n = 320", 320, 2);
    add("level set, n = 640", 640, 2);
    add("level set, 3D, n = 32", 32, 3);
    add("level set, 3D, n = 64", 64, 3);
    add("level set, 3D, n = 128", 128, 3);
  }
} // namespace meltfront::particles::benchmarks
