#include <cases/error.h>
#include <verification/ranks/agreement.h>
#include <verification/ranks/gathering_observer.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  GatheringObserver::GatheringObserver(const MethodOnRanks &method, MPI_Comm communicator,
                                       cases::Observer *whole, cases::Observer *part,
                                       TimeLimit &limit, cases::StateKeeper *keeper)
    : method(method)
    , communicator(communicator)
    , whole(whole)
    , part(part)
    , limit(limit)
    , keeper(keeper)
    , gatherer(communicator)
  {
  }

  void GatheringObserver::begin(const cases::RunDescription &description)
  {
    together(communicator,
             [&]
             {
               for(cases::Observer *observer : {whole, part})
                 if(observer)
                   observer->begin(description);
             });
  }

  bool GatheringObserver::wants(long step, double time)
  {
    bool wanted = false;
    together(
        communicator,
        [&]
        {
          if(whole)
          {
            wanted = whole->wants(step, time);
            limit.exceeded = limit.seconds > 0 && watch.elapsed().wall > limit.seconds;
            if(limit.exceeded)
              throw cases::NumericalError(
                  method.name(), step, time, "the run",
                  fmt::format("took longer than its time limit of {} s", limit.seconds));
          }
          part_wanted = part && part->wants(step, time);
        });
    whole_wanted = dealii::Utilities::MPI::max(wanted ? 1 : 0, communicator) > 0;
    return whole_wanted || part_wanted;
  }

  void GatheringObserver::observe(const cases::Snapshot &snapshot)
  {
    if(part)
      together(communicator, [&] { part->observe(snapshot); });
    // The first and the last state come without having been wanted.
    if(part_wanted && !whole_wanted)
      return;
    const cases::Snapshot gathered = gatherer.gather(snapshot, method.part());
    together(communicator,
             [&]
             {
               if(whole)
                 whole->observe(gathered);
             });
  }

  void GatheringObserver::note(double time, const std::string &event)
  {
    together(communicator,
             [&]
             {
               if(whole)
                 whole->note(time, event);
             });
  }

  void GatheringObserver::report(const std::string &name, double value)
  {
    together(communicator,
             [&]
             {
               if(whole)
                 whole->report(name, value);
             });
  }
} // namespace meltfront::verification
