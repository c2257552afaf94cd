#ifndef meltfront_particles_front_tracking_tests_tracked_run_h
#define meltfront_particles_front_tracking_tests_tracked_run_h

#include <cases/effects.h>
#include <cases/scene.h>
#include <particles/front_tracking/rkpm_tracked.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace meltfront::particles::front_tracking
{
  using cases::BoundaryKind;
  using cases::Side;
  using OptionTexts = std::vector<std::pair<std::string, std::string>>;

  /** Keeps what a run reports at each step. */
  struct Recorder : cases::Observer
  {
    bool wants(long, double) override
    {
      return true;
    }

    void observe(const cases::Snapshot &snapshot) override
    {
      times.push_back(snapshot.time);
      steps.push_back(snapshot.step);
      fronts.assign(snapshot.front[0].begin(), snapshot.front[0].end());
      solid = 0;
      for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
        solid += snapshot.weights[i] * snapshot.solid_fraction[i];
      volume = std::accumulate(snapshot.weights.begin(), snapshot.weights.end(), 0.);
      place.assign(snapshot.positions[0].begin(), snapshot.positions[0].end());
      temperature.assign(snapshot.temperature.begin(), snapshot.temperature.end());
      defect = std::max(defect, snapshot.heat.defect());
      heat = snapshot.heat;
    }

    void note(double, const std::string &event) override
    {
      notes.push_back(event);
    }

    std::vector<double> times, fronts, place, temperature;
    std::vector<long> steps;
    std::vector<std::string> notes;
    double solid = 0, volume = 0, defect = 0;
    cases::HeatBudget heat;
  };

  inline Recorder run(const cases::Scene &scene, int n, const OptionTexts &options = {})
  {
    const auto method = make_rkpm_tracked();
    cases::Resolution resolution;
    resolution.n = n;
    resolution.options = cases::Options(method->option_declarations());
    for(const auto &[key, value] : options)
      resolution.options.set(key, value);
    Recorder recorder;
    const cases::EffectSet effects = cases::effects_called_for(scene);
    method->solve(cases::simulated_scene(scene, effects), effects, resolution, recorder);
    return recorder;
  }

  inline cases::Boundary held(double value)
  {
    return {BoundaryKind::fixed_temperature, cases::Field::uniform(value)};
  }

  inline void set(cases::Scene &scene, Side side, const cases::Boundary &boundary)
  {
    scene.boundaries[static_cast<std::size_t>(side)] = boundary;
  }

  inline cases::Scene slab(const cases::Material &material, double start, double end)
  {
    cases::Scene scene;
    scene.name = "slab";
    scene.symmetry = cases::Symmetry::planar;
    scene.domain.upper[0] = 1;
    scene.material = material;
    scene.start_time = start;
    scene.end_time = end;
    return scene;
  }
} // namespace meltfront::particles::front_tracking

#endif
