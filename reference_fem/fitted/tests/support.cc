#include <reference_fem/fitted/tests/support.h>

#include <reference_fem/fitted/fitted.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::fitted::tests
{
  using namespace cases;

  namespace
  {
    class Recorder : public Observer
    {
    public:
      Recorder(const Scene &scene, const ExactSolution *exact, double temperature_from,
               Record &record)
        : scene(scene)
        , exact(exact)
        , temperature_from(temperature_from)
        , record(record)
      {
      }

      void begin(const RunDescription &description) override
      {
        record.description = description;
      }

      bool wants(long, double) override
      {
        return true;
      }

      void observe(const Snapshot &snapshot) override
      {
        double solid = 0, liquid = 0;
        for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
        {
          solid += snapshot.weights[i] * snapshot.solid_fraction[i];
          liquid += snapshot.weights[i] * (1 - snapshot.solid_fraction[i]);
        }
        record.time.push_back(snapshot.time);
        record.solid_volume.push_back(solid);
        const bool inside = !exact || exact->solid_at_origin();
        record.front.push_back(
            enclosing_coordinate(scene.symmetry, inside ? solid : liquid));
        record.front_exact.push_back(exact ? exact->front(snapshot.time) : 0);
        record.budget_defect.push_back(snapshot.heat.defect());
        record.heat = snapshot.heat;
        if(snapshot.time == scene.end_time)
          keep_end(snapshot);
      }

    private:
      void keep_end(const Snapshot &snapshot)
      {
        record.temperature.assign(snapshot.temperature.begin(),
                                  snapshot.temperature.end());
        for(int d = 0; d < snapshot.dimension; ++d)
        {
          record.positions[d].assign(snapshot.positions[d].begin(),
                                     snapshot.positions[d].end());
          record.front_points[d].assign(snapshot.front[d].begin(),
                                        snapshot.front[d].end());
        }
        if(!exact)
          return;
        double error = 0, norm = 0;
        for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
        {
          Position p{};
          for(int d = 0; d < snapshot.dimension; ++d)
            p[d] = snapshot.positions[d][i];
          if(snapshot.weights[i] == 0
             || coordinate(exact->symmetry(), p) < temperature_from)
            continue;
          const double value = exact->temperature(p, snapshot.time);
          error += snapshot.weights[i] * std::pow(snapshot.temperature[i] - value, 2);
          norm += snapshot.weights[i]
                  * std::pow(value - scene.material.melting_temperature, 2);
        }
        record.temperature_error = std::sqrt(error / norm);
      }

      const Scene &scene;
      const ExactSolution *exact;
      double temperature_from;
      Record &record;
    };
  } // namespace

  double Record::worst_budget_defect() const
  {
    return *std::max_element(budget_defect.begin(), budget_defect.end());
  }

  double Record::worst_front_error() const
  {
    double worst = 0;
    for(std::size_t i = 0; i < time.size(); ++i)
      worst = std::max(worst, std::abs(front[i] - front_exact[i]));
    return worst / front_exact.back();
  }

  double Record::final_front_error() const
  {
    return std::abs(front.back() / front_exact.back() - 1);
  }

  Record run(const Scene &scene, int n, const Texts &options, const ExactSolution *exact,
             double temperature_from)
  {
    Record record;
    const auto method = make_fem_fitted();
    const EffectSet effects = effects_called_for(scene);
    const Scene simulated = simulated_scene(scene, effects);
    Resolution resolution;
    resolution.n = n;
    resolution.options = Options(method->option_declarations());
    for(const auto &[key, text] : options)
      resolution.options.set(key, text);
    Recorder recorder(scene, exact, temperature_from, record);
    record.cost = method->solve(simulated, effects, resolution, recorder);
    return record;
  }
} // namespace meltfront::reference_fem::fitted::tests
