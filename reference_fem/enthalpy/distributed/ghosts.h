#ifndef meltfront_reference_fem_enthalpy_distributed_ghosts_h
#define meltfront_reference_fem_enthalpy_distributed_ghosts_h

#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/distributed/rank_solver.h>

#include <vector>

namespace meltfront::reference_fem
{
  /** Brings arrays of the own nodes and the ghosts up to date at the ghosts. */
  class Ghosts
  {
  public:
    Ghosts(const RankLevel &level, Traffic &traffic)
      : level(level)
      , traffic(traffic)
      , work(level.nodes)
    {
    }

    void update(std::vector<double> &values)
    {
      exchange([&](unsigned int i) { return values[i]; });
      for(auto i = first(); i < last(); ++i)
        values[i] = work.local_element(i);
    }

    void update(CompensatedVector &values)
    {
      exchange([&](unsigned int i) { return values.remainder_of(i); });
      std::vector<double> rest;
      for(auto i = first(); i < last(); ++i)
        rest.push_back(work.local_element(i));
      exchange([&](unsigned int i) { return values[i]; });
      for(auto i = first(); i < last(); ++i)
        values.set(i, work.local_element(i), rest[i - first()]);
    }

  private:
    unsigned int first() const
    {
      return static_cast<unsigned int>(level.n_own());
    }
    unsigned int last() const
    {
      return static_cast<unsigned int>(level.n_with_ghosts());
    }

    template <typename Value>
    void exchange(const Value &value)
    {
      for(unsigned int i = 0; i < first(); ++i)
        work.local_element(i) = value(i);
      work.update_ghost_values();
      ++traffic.exchanges;
      traffic.sent += level.nodes->n_import_indices();
    }

    const RankLevel &level;
    Traffic &traffic;
    RankVector work;
  };
} // namespace meltfront::reference_fem

#endif
