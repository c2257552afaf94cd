#include <cases/scene.h>
#include <particles/benchmarks/benchmarks.h>
#include <particles/benchmarks/table.h>
#include <particles/sph/sph.h>

#include <fmt/format.h>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    /** Looks at nothing but the last state. */
    class Nobody : public cases::Observer
    {
    public:
      bool wants(long, double) override
      {
        return false;
      }

      void observe(const cases::Snapshot &) override
      {
      }
    };

    /** Water in an insulated square that freezes around a line sink of 148 W/m. */
    cases::Scene freezing_square(double end_time)
    {
      cases::Scene scene;
      scene.domain.shape = cases::DomainShape::box;
      scene.domain.dimension = 2;
      for(int d = 0; d < 2; ++d)
      {
        scene.domain.lower[d] = -0.5;
        scene.domain.upper[d] = 0.5;
        scene.boundaries[2 * d] = scene.boundaries[2 * d + 1] = cases::Boundary{};
      }
      scene.material.solid = {2.2, 2090, 1000};
      scene.material.liquid = {0.591, 4190, 1000};
      scene.material.latent_heat = 333500;
      scene.initial.temperature = cases::Field::uniform(10);
      cases::PointSource sink;
      sink.power = [](double) { return -148.; };
      sink.energy = [](double time) { return -148. * time; };
      scene.sources.push_back(sink);
      scene.end_time = end_time;
      return scene;
    }

    void run(benchmark::State &state, int n, double end_time, const char *scheme)
    {
      const auto method = make_sph();
      const cases::Scene given = freezing_square(end_time);
      const cases::EffectSet effects = cases::effects_called_for(given);
      const cases::Scene scene = cases::simulated_scene(given, effects);
      cases::Resolution resolution;
      resolution.n = n;
      resolution.options = cases::Options(method->option_declarations());
      resolution.options.set("time_scheme", scheme);
      Nobody nobody;
      cases::Cost cost;
      for(auto _ : state)
      {
        cost = method->solve(scene, effects, resolution, nobody);
        state.SetIterationTime(cost.stepping_cpu);
      }
      PassSize pass;
      pass.particles = static_cast<double>(cost.unknowns);
      pass.items = static_cast<double>(cost.unknowns * cost.steps);
      pass.timed = true;
      set_size(state, pass, "particle step");
    }

    void add(const std::string &name, int n, double end_time, const char *scheme)
    {
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State &state)
                                   { run(state, n, end_time, scheme); })
          ->UseManualTime()
          ->Iterations(1);
    }
  } // namespace

  void register_run_benchmarks()
  {
    add("whole run, Euler, small", 40, 475000, "euler");
    add("whole run, Euler", 160, 20000, "euler");
    add("whole run, RKL2 with 8 stages", 160, 475000, "rkl2");
  }
} // namespace meltfront::particles::benchmarks
