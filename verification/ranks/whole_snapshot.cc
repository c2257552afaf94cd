#include <verification/ranks/whole_snapshot.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    /** use(k, number), on the first rank, of the numbers of all ranks in turn.
     * @param own gives the i-th of the n_own numbers of this rank */
    template <typename Number, typename Own, typename Use>
    void bring_to_first(MPI_Comm communicator, std::size_t n_own, const Own &own,
                        const Use &use)
    {
      constexpr std::size_t most_at_once = (1 << 20) / sizeof(Number);
      constexpr int tag = 0;
      const auto rank = dealii::Utilities::MPI::this_mpi_process(communicator);
      const std::vector<std::size_t> counts
          = dealii::Utilities::MPI::gather(communicator, n_own);
      std::vector<Number> message(most_at_once);
      const auto pass = [&](std::size_t n, const auto &pass_on)
      {
        for(std::size_t first = 0; first < n; first += most_at_once)
          pass_on(first, std::min(n, first + most_at_once));
      };
      const auto bytes = [](std::size_t first, std::size_t end)
      { return static_cast<int>((end - first) * sizeof(Number)); };
      if(rank > 0)
        return pass(n_own,
                    [&](std::size_t first, std::size_t end)
                    {
                      for(std::size_t i = first; i < end; ++i)
                        message[i - first] = own(i);
                      MPI_Send(message.data(), bytes(first, end), MPI_BYTE, 0, tag,
                               communicator);
                    });
      std::size_t k = 0;
      for(; k < n_own; ++k)
        use(k, own(k));
      for(std::size_t other = 1; other < counts.size(); ++other)
        pass(counts[other],
             [&](std::size_t first, std::size_t end)
             {
               MPI_Recv(message.data(), bytes(first, end), MPI_BYTE,
                        static_cast<int>(other), tag, communicator, MPI_STATUS_IGNORE);
               for(std::size_t i = first; i < end; ++i)
                 use(k++, message[i - first]);
             });
    }
  } // namespace

  void WholeSnapshot::take_in_order(std::span<const double> own,
                                    std::vector<double> &whole) const
  {
    whole.resize(place.size());
    bring_to_first<double>(
        communicator, own.size(), [&](std::size_t i) { return own[i]; },
        [&](std::size_t k, double value) { whole[place[k]] = value; });
  }

  void WholeSnapshot::gather_mesh(const cases::Snapshot &snapshot,
                                  const cases::RankPart &part)
  {
    const std::size_t n_own = part.n_own_sites,
                      n = dealii::Utilities::MPI::sum(n_own, communicator);
    const bool first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    std::vector<std::uint64_t> numbers(first ? n : 0);
    bring_to_first<std::uint64_t>(
        communicator, n_own, [&](std::size_t i) { return part.site_numbers[i]; },
        [&](std::size_t k, std::uint64_t number) { numbers[k] = number; });
    std::vector<unsigned int> order(numbers.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](unsigned int i) { return numbers[i]; });
    std::ranges::sort(numbers);
    place.resize(numbers.size());
    for(unsigned int i = 0; i < order.size(); ++i)
      place[order[i]] = i;
    order = {};
    for(int d = 0; d < snapshot.dimension; ++d)
      take_in_order(snapshot.positions[d].first(n_own), positions[d]);
    take_in_order(snapshot.weights.first(n_own), weights);
    gather_cells(snapshot, part, numbers);
  }

  /** @param numbers of all sites, in order */
  void WholeSnapshot::gather_cells(const cases::Snapshot &snapshot,
                                   const cases::RankPart &part,
                                   const std::vector<std::uint64_t> &numbers)
  {
    const std::size_t n_own = snapshot.cells.size(),
                      n = dealii::Utilities::MPI::sum(n_own, communicator),
                      n_corners = std::size_t(1) << snapshot.dimension;
    std::vector<unsigned int> corners;
    corners.resize(numbers.empty() ? 0 : n);
    bring_to_first<std::uint64_t>(
        communicator, n_own,
        [&](std::size_t k) { return part.site_numbers[snapshot.cells[k]]; },
        [&](std::size_t k, std::uint64_t number)
        {
          corners[k] = static_cast<unsigned int>(std::ranges::lower_bound(numbers, number)
                                                 - numbers.begin());
        });
    std::vector<unsigned int> order(corners.size() / n_corners);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {},
                      [&](unsigned int cell) { return corners[n_corners * cell]; });
    cells.clear();
    cells.reserve(corners.size());
    for(const unsigned int cell : order)
      for(std::size_t a = 0; a < n_corners; ++a)
        cells.push_back(corners[n_corners * cell + a]);
  }

  cases::Snapshot WholeSnapshot::gather(const cases::Snapshot &snapshot,
                                        const cases::RankPart &part)
  {
    if(!std::exchange(mesh_is_here, true))
      gather_mesh(snapshot, part);
    take_in_order(snapshot.temperature.first(part.n_own_sites), temperature);
    take_in_order(snapshot.solid_fraction.first(part.n_own_sites), solid_fraction);
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
