#include <cases/run.h>
#include <cases/scene.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <algorithm>
#include <array>
#include <istream>
#include <stdexcept>
#include <utility>

namespace meltfront::cases
{
  Cost Run::carry_out(const Scene &scene, const Stopwatch &since_setup, Observer &of_run)
  {
    observer = &of_run;
    start_time = scene.start_time;
    end_time = scene.end_time;
    keeper = observer->state_keeper();
    setup = since_setup.elapsed();
    watch = since_setup;
    if(keeper)
    {
      const std::unique_ptr<std::istream> state
          = watch.without([this] { return keeper->state_to_resume(); });
      if(state)
        resume(*state);
    }
    take_steps();
    const Stopwatch::Seconds total = watch.elapsed();
    Cost result = cost();
    result.setup_wall = setup.wall + setup_before.wall;
    result.setup_cpu = setup.cpu + setup_before.cpu;
    result.stepping_wall
        = total.wall - setup.wall + elsewhere.wall + stepping_before.wall;
    result.stepping_cpu = total.cpu - setup.cpu + elsewhere.cpu + stepping_before.cpu;
    return result;
  }

  void Run::save(boost::archive::binary_oarchive &) const
  {
    throw std::logic_error("this run cannot be resumed");
  }

  void Run::restore(boost::archive::binary_iarchive &)
  {
    throw std::logic_error("this run cannot be resumed");
  }

  void Run::resume(std::istream &state)
  {
    do
    {
      boost::archive::binary_iarchive archive(state);
      std::array<Stopwatch::Seconds, 2> spent;
      for(Stopwatch::Seconds &part : spent)
        archive >> part.wall >> part.cpu;
      restore(archive);
      if(!takes_over_times())
        continue;
      for(const auto &[before, part] :
          {std::pair(&setup_before, spent[0]), std::pair(&stepping_before, spent[1])})
      {
        before->wall = std::max(before->wall, part.wall);
        before->cpu += part.cpu;
      }
    } while(state.peek() != std::istream::traits_type::eof());
    setup = watch.elapsed();
    begun = resumed = true;
  }

  void Run::write_state(std::ostream &state, const Stopwatch::Seconds &so_far) const
  {
    boost::archive::binary_oarchive archive(state);
    const double setup_wall = setup.wall + setup_before.wall,
                 setup_cpu = setup.cpu + setup_before.cpu;
    const double stepping_wall = so_far.wall - setup.wall + stepping_before.wall,
                 stepping_cpu = so_far.cpu - setup.cpu + stepping_before.cpu;
    archive << setup_wall << setup_cpu << stepping_wall << stepping_cpu;
    save(archive);
  }

  void Run::reached(long step, double time)
  {
    const bool first = !std::exchange(begun, true), last = time == end_time;
    if(first && !last)
      setup = watch.elapsed();
    const Stopwatch::Seconds so_far = keeper ? watch.elapsed() : Stopwatch::Seconds();
    watch.without(
        [&]
        {
          if(first)
            observer->begin(describe());
          const bool wanted = observer->wants(step, time);
          if(wanted || first || last)
            observer->observe(snapshot(step, time));
          if(keeper && !last)
            keeper->offer(step, time,
                          [&](std::ostream &state) { write_state(state, so_far); });
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
