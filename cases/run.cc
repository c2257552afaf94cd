#include <cases/run.h>
#include <cases/scene.h>

#include <utility>

namespace meltfront::cases
{
  Cost Run::carry_out(const Scene &scene, const Stopwatch &since_setup, Observer &of_run)
  {
    observer = &of_run;
    start_time = scene.start_time;
    end_time = scene.end_time;
    setup = since_setup.elapsed();
    watch = since_setup;
    take_steps();
    const Stopwatch::Seconds total = watch.elapsed();
    Cost result = cost();
    result.setup_wall = setup.wall;
    result.setup_cpu = setup.cpu;
    result.stepping_wall = total.wall - setup.wall + elsewhere.wall;
    result.stepping_cpu = total.cpu - setup.cpu + elsewhere.cpu;
    return result;
  }

  void Run::reached(long step, double time)
  {
    const bool first = !std::exchange(begun, true), last = time == end_time;
    if(first && !last)
      setup = watch.elapsed();
    watch.without(
        [&]
        {
          if(first)
            observer->begin(describe());
          const bool wanted = observer->wants(step, time);
          if(wanted || first || last)
            observer->observe(snapshot(step, time));
        });
  }

  std::vector<double> Run::wanted_times() const
  {
    const std::vector<double> told = observer->wanted_times();
    return told.empty() ? std::vector{start_time, end_time} : told;
  }

  void Run::work_elsewhere(const std::function<Stopwatch::Seconds()> &work)
  {
    const Stopwatch::Seconds spent = watch.without(work);
    elsewhere.wall += spent.wall;
    elsewhere.cpu += spent.cpu;
  }

  void Run::note(double time, const std::string &event)
  {
    watch.without([&] { observer->note(time, event); });
  }

  void Run::report(const std::string &name, double value)
  {
    watch.without([&] { observer->report(name, value); });
  }
} // namespace meltfront::cases
