#include <verification/app/tests/claims/trial.h>

#include <cmath>
#include <numeric>

namespace meltfront::verification::claims
{
  namespace
  {
    std::vector<double> copy(std::span<const double> values)
    {
      return {values.begin(), values.end()};
    }

    /** Keeps the first and the last snapshot. */
    class Ends : public cases::Observer
    {
    public:
      explicit Ends(const cases::Scene &scene)
        : scene(scene)
      {
      }

      void begin(const cases::RunDescription &description) override
      {
        dimension = description.dimension;
      }

      bool wants(long, double) override
      {
        return false;
      }

      void observe(const cases::Snapshot &snapshot) override
      {
        EndState state;
        state.time = snapshot.time;
        for(int d = 0; d < 3; ++d)
        {
          state.positions[d] = copy(snapshot.positions[d]);
          state.velocity[d] = copy(snapshot.velocity[d]);
        }
        state.weights = copy(snapshot.weights);
        state.temperature = copy(snapshot.temperature);
        state.solid_fraction = copy(snapshot.solid_fraction);
        if(snapshot.level_set)
          for(const cases::Position &point : lattice(scene.domain))
            state.inside.push_back(snapshot.level_set(point) > 0);
        if(snapshot.step == 0)
          start = state;
        end = std::move(state);
      }

      const cases::Scene &scene;
      EndState start, end;
      int dimension = 0;
    };
  } // namespace

  std::vector<cases::Position> lattice(const cases::Domain &domain)
  {
    constexpr int across = 40;
    std::vector<cases::Position> points;
    const int layers = domain.dimension == 3 ? across : 1;
    const auto place = [&](int d, int i) {
      return domain.lower[d] + (domain.upper[d] - domain.lower[d]) * (i + 0.5) / across;
    };
    for(int k = 0; k < layers; ++k)
      for(int j = 0; j < across; ++j)
        for(int i = 0; i < across; ++i)
          points.push_back(
              {place(0, i), place(1, j), domain.dimension == 3 ? place(2, k) : 0});
    return points;
  }

  Judge temperature_judge(TemperatureAt temperature, double solid_share, double from)
  {
    return [temperature = std::move(temperature), solid_share, from](const EndState &end)
    {
      double squares = 0, counted = 0, all = 0, solid = 0;
      for(std::size_t i = 0; i < end.weights.size(); ++i)
      {
        const cases::Position p = end.position(i);
        all += end.weights[i];
        solid += end.weights[i] * end.solid_fraction[i];
        if(end.weights[i] == 0 || std::hypot(p[0], p[1], p[2]) < from)
          continue;
        const double difference = end.temperature[i] - temperature(p);
        squares += end.weights[i] * difference * difference;
        counted += end.weights[i];
      }
      return Differences{std::sqrt(squares / counted),
                         solid_share < 0 ? 0 : std::abs(solid / all - solid_share)};
    };
  }

  Judge solution_judge(const cases::Scene &scene,
                       const std::shared_ptr<const cases::ExactSolution> &solution,
                       double from)
  {
    const double time = scene.end_time;
    const auto temperature = [solution, time](const cases::Position &p)
    { return solution->temperature(p, time); };
    if(!solution->has_front())
      return temperature_judge(temperature, -1, from);
    const cases::Domain &domain = scene.domain;
    constexpr double outer = 1; // of every domain of the claims
    const double share
        = solution->solid_volume(domain.inner_radius, outer, time)
          / cases::volume_between(solution->symmetry(), domain.inner_radius, outer);
    return temperature_judge(temperature, share, from);
  }

  Outcome run(const cases::Method &method, const Trial &trial)
  {
    cases::EffectSet effects = cases::effects_called_for(trial.scene);
    const cases::Scene scene = cases::simulated_scene(trial.scene, effects);
    cases::Resolution resolution;
    resolution.n = trial.n;
    resolution.options = cases::Options(method.option_declarations());
    for(const auto &[key, value] : trial.options)
      resolution.options.set(key, value);
    Ends ends(scene);
    cases::Cost cost = method.solve(scene, effects, resolution, ends);
    return {std::move(ends.start), std::move(ends.end), std::move(cost),
            std::move(effects), ends.dimension};
  }
} // namespace meltfront::verification::claims
