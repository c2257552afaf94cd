#include <verification/run/timed_repeat.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Wants nothing: for runs that are repeated for their time. */
    class IdleObserver : public cases::Observer
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

    double cpu_of(const cases::Cost &cost)
    {
      return cost.setup_cpu + cost.stepping_cpu;
    }

    /** Every time of a cost, changed by that of another: `change(time, other)`. */
    template <typename Change>
    void change_times(cases::Cost &cost, const cases::Cost &other, const Change &change)
    {
      change(cost.setup_wall, other.setup_wall);
      change(cost.setup_cpu, other.setup_cpu);
      change(cost.stepping_wall, other.stepping_wall);
      change(cost.stepping_cpu, other.stepping_cpu);
      for(std::size_t i = 0; i < std::min(cost.effects.size(), other.effects.size()); ++i)
        change(cost.effects[i].seconds, other.effects[i].seconds);
    }
  } // namespace

  void add_repeat(RunRecord &record, const cases::Cost &cost)
  {
    change_times(record.cost, cost,
                 [](double &time, double other) { time = std::min(time, other); });
    record.times.cpu.push_back(cpu_of(cost));
    record.times.wall.push_back(cost.setup_wall + cost.stepping_wall);
    record.repeats = static_cast<int>(record.times.cpu.size());
  }

  cases::Cost timed_solution(const cases::Case &c, const cases::Method &method,
                             const cases::Resolution &resolution)
  {
    const cases::EffectSet effects = cases::effects_called_for(c.scene);
    const cases::Scene scene = cases::simulated_scene(c.scene, effects);
    IdleObserver observer;
    return method.solve(scene, effects, resolution, observer);
  }

  void repeat_carefully(const cases::Case &c, const cases::Method &method,
                        const cases::Resolution &resolution, RunRecord &record)
  {
    constexpr double short_run = 1e-3, in_the_clock = 20e-3, warmed_up = 0.2; // s
    cases::Cost sum = timed_solution(c, method, resolution);
    if(cpu_of(sum) < warmed_up)
      sum = timed_solution(c, method, resolution);
    int solutions = 1;
    if(cpu_of(sum) < short_run)
      for(; sum.setup_wall + sum.stepping_wall < in_the_clock; ++solutions)
        change_times(sum, timed_solution(c, method, resolution),
                     [](double &time, double other) { time += other; });
    change_times(sum, sum, [solutions](double &time, double) { time /= solutions; });
    if(!record.times.careful)
    {
      record.times = {true, {}, {}};
      change_times(record.cost, sum, [](double &time, double other) { time = other; });
    }
    add_repeat(record, sum);
  }
} // namespace meltfront::verification
