#ifndef meltfront_cases_shared_run_h
#define meltfront_cases_shared_run_h

#include <cases/run.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace meltfront::cases
{
  /**
   * Sites of which a snapshot on one of several ranks (processes of MPI) consists: its
   * own ones first, so many, then those of other ranks that its cells have, with weight
   * zero; the cells are those of the rank. Sums (heat, mass) are those of all ranks.
   * Sites and cells are the same in all snapshots of a run.
   */
  struct RankPart
  {
    std::size_t n_own_sites = 0;
    /** Of every site: the same on every rank and whatever the ranks are. */
    std::span<const std::uint64_t> site_numbers;
  };

  /**
   * A run that several ranks share: all of them make it, take it to its end and fail at
   * the same time. Each goes on from what it saved itself; on another number of ranks
   * than before, Run::restore() is called on each with the states of all in turn.
   */
  class SharedRun : public Run
  {
  public:
    /** What the snapshots hold that it hands over. */
    virtual RankPart part() const = 0;
  };

  /** What a method is that can share a run among several ranks. Those that are not are
   * refused there. */
  class SharedMethod
  {
  public:
    virtual ~SharedMethod() = default;

    /** As Method::capabilities(), of what it takes on several ranks. */
    virtual Capabilities capabilities_on_ranks() const = 0;

    /** Whether a run of one process is made like those that ranks share. */
    virtual bool shares_on_one(const Options &) const
    {
      return false;
    }

    /** As Method::demand(), of all ranks together. */
    virtual Demand demand_on_ranks(const Scene &scene, const EffectSet &effects,
                                   const Resolution &resolution, int ranks) const = 0;

    /** As Method::set_up(), on every rank at the same time. */
    virtual std::unique_ptr<SharedRun> set_up_on_ranks(const Scene &scene,
                                                       const EffectSet &effects,
                                                       const Resolution &resolution,
                                                       int ranks) const = 0;
  };
} // namespace meltfront::cases

#endif
