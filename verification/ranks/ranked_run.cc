#include <cases/effect_bounds.h>
#include <cases/error.h>
#include <verification/ranks/agreement.h>
#include <verification/ranks/gathering_keeper.h>
#include <verification/ranks/gathering_observer.h>
#include <verification/ranks/ranked_run.h>
#include <verification/record/json_values.h>
#include <verification/run/checkpoint/checkpoint_keeper.h>
#include <verification/run/run_one.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <sys/resource.h>

#include <new>
#include <tuple>

namespace meltfront::verification
{
  namespace
  {
    /** How a run ended on one rank. */
    struct RankEnd
    {
      RunRecord record;
      bool by_another = false; ///< it ended because another rank failed
      bool unwritten = false;  ///< it could not write

      bool failed() const
      {
        return !by_another && (unwritten || record.status != RunStatus::finished);
      }

      /** The exit status of a run that ended so (`meltfront --help`). */
      int exit_status() const
      {
        return unwritten ? 4 : record.status == RunStatus::refused ? 2 : 3;
      }
    };

    double peak_memory_mb()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return static_cast<double>(usage.ru_maxrss) / 1024;
    }

    /** Where this rank has failed before the run began. */
    void let_others_end(MPI_Comm communicator)
    {
      try
      {
        together(communicator, [] { throw OtherRankFailed(); });
      }
      catch(const OtherRankFailed &)
      {
      }
    }

    /** What stands between the observers of a rank and a run with checkpoints; none of it
     * without. */
    struct RankKeepers
    {
      /** @param whole null on all ranks but the first
       * @param evidence of the checkpoints, on the first rank */
      RankKeepers(MPI_Comm communicator, cases::Observer *whole, PartObserver &part,
                  const std::optional<KeptRun> &kept,
                  std::map<std::string, double> &evidence)
      {
        if(!kept)
          return;
        if(whole)
          of_whole.emplace(kept->folder, kept->interval, *whole, evidence);
        of_all.emplace(communicator, of_whole ? of_whole->state_keeper() : nullptr, part);
      }

      std::optional<CheckpointKeeper> of_whole;
      std::optional<GatheringKeeper> of_all;
    };

    class RankObserver : private RankKeepers, public GatheringObserver
    {
    public:
      RankObserver(MPI_Comm communicator, const MethodOnRanks &method,
                   cases::Observer *whole, PartObserver &part, TimeLimit &limit,
                   const std::optional<KeptRun> &kept,
                   std::map<std::string, double> &evidence)
        : RankKeepers(communicator, whole, part, kept, evidence)
        , GatheringObserver(method, communicator, of_whole ? &*of_whole : whole, &part,
                            limit, of_all ? &*of_all : nullptr)
      {
      }
    };

    /** What the first rank does: run_one(), the observer being that of all. */
    RankEnd lead(MPI_Comm communicator, const cases::Case &c, const MethodOnRanks &method,
                 const cases::Resolution &resolution, const std::string &label,
                 const std::map<std::string, std::string> &provenance, PartObserver &part,
                 TimeLimit &limit, const std::optional<KeptRun> &kept)
    {
      RepeatPolicy once;
      once.most = 1;
      RankEnd end;
      std::map<std::string, double> evidence;
      bool begun = false;
      try
      {
        end.record
            = run_one(c, method, resolution, label, provenance, nullptr, once,
                      [&](cases::Observer &whole) -> std::unique_ptr<cases::Observer>
                      {
                        begun = true;
                        together(communicator, [] {});
                        return std::make_unique<RankObserver>(
                            communicator, method, &whole, part, limit, kept, evidence);
                      });
        end.record.cost.evidence.merge(evidence);
        end.by_another = end.record.message == OtherRankFailed().what();
      }
      catch(const cases::OutputError &error)
      {
        end.unwritten = true;
        end.record.message = error.what();
      }
      if(!begun)
        let_others_end(communicator);
      return end;
    }

    /** What the others do: solve, and keep how that ended. */
    RankEnd follow(MPI_Comm communicator, const cases::Case &c,
                   const MethodOnRanks &method, const cases::Resolution &resolution,
                   PartObserver &part, TimeLimit &limit,
                   const std::optional<KeptRun> &kept)
    {
      RankEnd end;
      RunRecord &record = end.record;
      record.status = RunStatus::failed;
      try
      {
        together(communicator, [] {});
        const cases::EffectSet effects
            = cases::effects_within(c.scene, c.effect_tolerance);
        const cases::Scene scene = cases::simulated_scene(c.scene, effects);
        std::map<std::string, double> evidence; // the first rank's is recorded
        RankObserver observer(communicator, method, nullptr, part, limit, kept, evidence);
        record.cost = method.solve(scene, effects, resolution, observer);
        record.status = RunStatus::finished;
      }
      catch(const OtherRankFailed &)
      {
        end.by_another = true;
      }
      catch(const cases::Refusal &refusal)
      {
        record.status = RunStatus::refused;
        record.message = refusal.what();
      }
      catch(const cases::InputError &error)
      {
        record.status = RunStatus::refused;
        record.message = fmt::format("{}: {}", method.name(), error.what());
      }
      catch(const cases::OutputError &error)
      {
        end.unwritten = true;
        record.message = error.what();
      }
      catch(const std::bad_alloc &)
      {
        record.message = fmt::format("{} needs more memory than there is", method.name());
      }
      catch(const std::exception &error)
      {
        record.message = error.what();
      }
      return end;
    }

    /** How the first rank that failed by itself ended, on all. */
    void agree(MPI_Comm communicator, RankEnd &end)
    {
      using End = std::tuple<bool, bool, int, std::string>;
      const auto ends = dealii::Utilities::MPI::all_gather(
          communicator, End(end.failed(), end.unwritten,
                            static_cast<int>(end.record.status), end.record.message));
      for(const auto &[failed, unwritten, status, message] : ends)
        if(failed)
        {
          end.unwritten = unwritten;
          end.record.status = static_cast<RunStatus>(status);
          end.record.message = message;
          return;
        }
    }

    void add_up(MPI_Comm communicator, RunRecord &record)
    {
      const auto sum
          = [&](double own) { return dealii::Utilities::MPI::sum(own, communicator); };
      record.cost.setup_cpu = sum(record.cost.setup_cpu);
      record.cost.stepping_cpu = sum(record.cost.stepping_cpu);
      record.peak_memory_mb = sum(peak_memory_mb());
      if(!record.times.cpu.empty())
        record.times.cpu.back() = record.cost.setup_cpu + record.cost.stepping_cpu;
    }
  } // namespace

  RunRecord run_on_ranks(const RankSession &session, const cases::Case &c,
                         const MethodOnRanks &method, const cases::Resolution &resolution,
                         const std::string &label,
                         const std::map<std::string, std::string> &provenance,
                         PartObserver &part, double time_limit, const std::string &file,
                         const std::optional<KeptRun> &kept)
  {
    constexpr double patience = 10; // s
    // Messages of its own, so that a rank that waits elsewhere is not taken for met.
    MPI_Comm communicator = MPI_COMM_NULL, meeting = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    MPI_Comm_dup(MPI_COMM_WORLD, &meeting);
    TimeLimit limit{time_limit};
    RankEnd end = session.rank() == 0
                      ? lead(communicator, c, method, resolution, label, provenance, part,
                             limit, kept)
                      : follow(communicator, c, method, resolution, part, limit, kept);
    if(!meet(meeting, end.failed() ? patience : 1e9))
    {
      RunRecord record = empty_record(c, method, resolution, label, provenance);
      record.status = end.record.status;
      record.message = end.record.message;
      write_json(file, record);
      session.abort(fmt::format("rank {}: {}", session.rank(), record.message),
                    end.exit_status());
    }
    agree(communicator, end);
    if(limit.exceeded)
      end.record.provenance["ended"] = "killed"; // its checkpoint stays
    add_up(communicator, end.record);
    MPI_Comm_free(&meeting);
    MPI_Comm_free(&communicator);
    if(end.unwritten)
      throw cases::OutputError(end.record.message);
    return end.record;
  }
} // namespace meltfront::verification
