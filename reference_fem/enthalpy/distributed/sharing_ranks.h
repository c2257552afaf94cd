#ifndef meltfront_reference_fem_enthalpy_distributed_sharing_ranks_h
#define meltfront_reference_fem_enthalpy_distributed_sharing_ranks_h

#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/conduction_matrix.h>
#include <reference_fem/enthalpy/distributed/rank_level.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem
{
  /** What StepNewton asks of the processes that share a mesh: ghosts brought up to date,
   * and sums and maxima over all ranks, so that all ranks decide alike. */
  class SharingRanks
  {
  public:
    /** @param conduction of the finest mesh, ghosts in its columns */
    SharingRanks(const RankLevel &finest, const ConductionMatrix &conduction,
                 Traffic &traffic);

    void update(std::vector<double> &values) const
    {
      level.exchange(values, traffic);
    }

    void update(CompensatedVector &values) const
    {
      for(std::vector<double> *part : values.parts())
        update(*part);
    }

    bool anywhere(bool here) const;

    /** A distance that is not a number on one rank is infinite on all. */
    void agree(double &distance, double &largest, bool &settled) const;

    std::array<double, 2> sum(std::array<double, 2> own) const;

    /** See StepNewton. */
    template <typename Visit>
    void update_marks(std::vector<char> &marked, const Visit &mark_around);

  private:
    const RankLevel &level;
    Traffic &traffic;
    std::vector<unsigned int> border;              ///< own nodes beside ghosts
    std::vector<std::vector<unsigned int>> beside; ///< of each ghost, own nodes
    std::vector<double> marks;
  };

  template <typename Visit>
  void SharingRanks::update_marks(std::vector<char> &marked, const Visit &mark_around)
  {
    for(const unsigned int i : border)
      marks[i] = marked[i];
    update(marks);
    for(std::size_t ghost = 0; ghost < beside.size(); ++ghost)
      if(const std::size_t i = level.n_own() + ghost; marks[i] > 0 && !marked[i])
      {
        marked[i] = 1;
        for(const unsigned int neighbour : beside[ghost])
          mark_around(neighbour);
      }
  }
} // namespace meltfront::reference_fem

#endif
