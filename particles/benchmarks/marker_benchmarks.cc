#include <cases/shape.h>
#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/table.h>
#include <particles/level_set/markers/marker_scheme.h>
#include <particles/level_set/reinitialisation.h>

#include <fmt/format.h>

#include <optional>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    using namespace level_set;

    /** A front in a turning plane, with or without markers, step by step. */
    class Turning
    {
    public:
      Turning(int cells, const std::optional<MarkerParameters> &markers)
        : grid(2, {}, 1. / cells, {cells, cells, 1})
        , front(grid, [&](const cases::Position &p) { return disk.signed_distance(p); })
        , velocity(velocity_function(turning))
      {
        if(!markers)
          return;
        scheme.emplace(grid, *markers, "benchmark");
        scheme->seed([&](const cases::Position &p) { return disk.signed_distance(p); });
      }

      void step()
      {
        const TimeStep step{++steps, 0, grid.spacing()};
        advection.step(front, velocity, step);
        if(scheme)
        {
          scheme->move(turning, step);
          if(scheme->corrects_at(steps))
            scheme->correct(front);
        }
        if(steps % 10 == 0)
        {
          reinitialise(front);
          if(scheme)
            scheme->refresh(front);
        }
      }

      double items() const
      {
        return scheme ? static_cast<double>(scheme->markers().size())
                      : static_cast<double>(front.band().size());
      }

    private:
      const cases::SlottedDisk disk{{0.5, 0.75, 0}, 0.15, 0.05, 0.25};
      const Grid grid;
      LevelSet front;
      const cases::RigidMotion turning{{}, 1, {0.5, 0.5, 0}};
      const VelocityFunction velocity;
      Advection advection;
      Reinitialisation reinitialise;
      std::optional<MarkerScheme> scheme;
      long steps = 0;
    };

    /** Ten steps of Zalesak's disk, with the reinitialisation that belongs to them. */
    void advance(benchmark::State &state, int cells,
                 const std::optional<MarkerParameters> &markers)
    {
      Turning turning(cells, markers);
      for(auto _ : state)
        for(int step = 0; step < 10; ++step)
          turning.step();
      PassSize pass;
      pass.particles = turning.items();
      pass.items = 10 * pass.particles;
      set_size(state, pass, markers ? "marker step" : "node of band");
    }

    void add(const char *scheme, int cells,
             const std::optional<MarkerParameters> &markers)
    {
      benchmark::RegisterBenchmark(
          fmt::format("Zalesak's disk, {}, n = {}", scheme, cells).c_str(),
          [=](benchmark::State &state) { advance(state, cells, markers); });
    }
  } // namespace

  void register_marker_benchmarks()
  {
    for(const int cells : {80, 320})
    {
      add("grid alone", cells, std::nullopt);
      add("original (64)", cells, MarkerParameters::original());
      add("corrected (64)", cells, MarkerParameters::corrected());
      add("fits (12)", cells, MarkerParameters::interpolating(2, false));
      MarkerParameters seldom = MarkerParameters::interpolating(2, false);
      seldom.correct_every = 10;
      add("fits (12) every 10 steps", cells, seldom);
      add("fits of clusters (12)", cells, MarkerParameters::interpolating(2));
    }
    add("small, fits (12)", 40, MarkerParameters::interpolating(2, false));
  }
} // namespace meltfront::particles::benchmarks
