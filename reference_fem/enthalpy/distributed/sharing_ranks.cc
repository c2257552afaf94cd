#include <reference_fem/enthalpy/distributed/sharing_ranks.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>
#include <limits>

namespace meltfront::reference_fem
{
  SharingRanks::SharingRanks(const std::vector<RankLevel> &levels,
                             const ConductionMatrix &conduction, Traffic &traffic)
    : levels(levels)
    , traffic(traffic)
    , beside(levels.front().n_with_ghosts() - levels.front().n_own())
    , marks(levels.front().n_with_ghosts())
  {
    const auto n_own = static_cast<unsigned int>(levels.front().n_own());
    for(unsigned int i = 0; i < n_own; ++i)
      for(std::size_t k = conduction.row_start[i]; k < conduction.row_start[i + 1]; ++k)
        if(const unsigned int j = conduction.column[k]; j >= n_own)
        {
          if(border.empty() || border.back() != i)
            border.push_back(i);
          beside[j - n_own].push_back(i);
        }
  }

  bool SharingRanks::anywhere(bool here) const
  {
    ++traffic.reductions;
    return dealii::Utilities::MPI::max(here ? 1 : 0, levels.front().communicator) > 0;
  }

  void SharingRanks::agree(double &distance, double &largest, bool &settled) const
  {
    std::array<double, 3> most{
        std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance,
        largest, settled ? 0. : 1.};
    const dealii::ArrayView<double> view(most.data(), most.size());
    dealii::Utilities::MPI::max(dealii::ArrayView<const double>(view),
                                levels.front().communicator, view);
    ++traffic.reductions;
    distance = most[0];
    largest = most[1];
    settled = most[2] == 0;
  }

  void SharingRanks::add_up(double &one, double &other) const
  {
    std::array<double, 2> sums{one, other};
    const dealii::ArrayView<double> view(sums.data(), sums.size());
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(view),
                                levels.front().communicator, view);
    ++traffic.reductions;
    one = sums[0];
    other = sums[1];
  }
} // namespace meltfront::reference_fem
