#include <verification/ranks/whole_snapshot.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace meltfront::verification
{
  namespace
  {
    /** Those of all ranks in turn, on the first rank; nothing on the others. */
    template <typename Number>
    std::vector<Number> gathered(MPI_Comm communicator, const std::vector<Number> &own)
    {
      std::vector<Number> result;
      for(const auto &of_rank : dealii::Utilities::MPI::gather(communicator, own))
        result.insert(result.end(), of_rank.begin(), of_rank.end());
      return result;
    }
  } // namespace

  std::vector<double> WholeSnapshot::in_order(std::span<const double> own) const
  {
    const std::vector<double> all
        = gathered(communicator, std::vector<double>(own.begin(), own.end()));
    std::vector<double> result(order.size());
    for(std::size_t i = 0; i < order.size(); ++i)
      result[i] = all[order[i]];
    return result;
  }

  void WholeSnapshot::gather_mesh(const cases::Snapshot &snapshot,
                                  const cases::RankPart &part)
  {
    const std::span<const std::uint64_t> own = part.site_numbers.first(part.n_own_sites);
    std::vector<std::uint64_t> numbers
        = gathered(communicator, std::vector<std::uint64_t>(own.begin(), own.end()));
    order.resize(numbers.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::sort(order, {}, [&](std::size_t i) { return numbers[i]; });
    std::ranges::sort(numbers);
    for(int d = 0; d < snapshot.dimension; ++d)
      positions[d] = in_order(snapshot.positions[d].first(part.n_own_sites));
    weights = in_order(snapshot.weights.first(part.n_own_sites));

    std::vector<std::uint64_t> corners;
    for(const unsigned int site : snapshot.cells)
      corners.push_back(part.site_numbers[site]);
    corners = gathered(communicator, corners);
    const std::size_t n_corners = std::size_t(1) << snapshot.dimension;
    std::vector<std::size_t> first(corners.size() / n_corners);
    for(std::size_t c = 0; c < first.size(); ++c)
      first[c] = c * n_corners;
    std::ranges::sort(first, {}, [&](std::size_t corner) { return corners[corner]; });
    cells.clear();
    for(const std::size_t corner : first)
      for(std::size_t a = 0; a < n_corners; ++a)
        cells.push_back(static_cast<unsigned int>(
            std::ranges::lower_bound(numbers, corners[corner + a]) - numbers.begin()));
  }

  cases::Snapshot WholeSnapshot::gather(const cases::Snapshot &snapshot,
                                        const cases::RankPart &part)
  {
    const bool changed = !std::ranges::equal(part.site_numbers, numbers_sent)
                         || !std::ranges::equal(snapshot.cells, cells_sent);
    if(dealii::Utilities::MPI::max(changed ? 1 : 0, communicator) > 0)
    {
      gather_mesh(snapshot, part);
      numbers_sent.assign(part.site_numbers.begin(), part.site_numbers.end());
      cells_sent.assign(snapshot.cells.begin(), snapshot.cells.end());
    }
    temperature = in_order(snapshot.temperature.first(part.n_own_sites));
    solid_fraction = in_order(snapshot.solid_fraction.first(part.n_own_sites));
    cases::Snapshot whole = snapshot;
    for(int d = 0; d < snapshot.dimension; ++d)
      whole.positions[d] = positions[d];
    whole.weights = weights;
    whole.temperature = temperature;
    whole.solid_fraction = solid_fraction;
    whole.cells = cells;
    return whole;
  }
} // namespace meltfront::verification
