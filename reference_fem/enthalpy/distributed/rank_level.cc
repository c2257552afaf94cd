#include <reference_fem/enthalpy/distributed/rank_level.h>

namespace meltfront::reference_fem
{
  namespace
  {
    dealii::IndexSet index_set(const BoxLattice &lattice,
                               std::vector<dealii::types::global_dof_index> numbers)
    {
      std::ranges::sort(numbers);
      const auto repeated = std::ranges::unique(numbers);
      dealii::IndexSet result(
          static_cast<dealii::types::global_dof_index>(lattice.n_nodes()));
      result.add_indices(numbers.begin(), repeated.begin());
      result.compress();
      return result;
    }
  } // namespace

  RankLevel::RankLevel(const cases::Scene &scene, const BoxLattice &lattice,
                       const dealii::IndexSet &own_nodes, const RankLevel *finer,
                       MPI_Comm communicator)
    : communicator(communicator)
    , lattice(lattice)
    , own(own_nodes)
    , shared(own.n_elements() < own.size())
  {
    find_ghosts(finer);
    partitioner.reinit(own, ghosts, communicator);
    conduct(scene);
    if(finer)
      interpolate(*finer);
  }

  unsigned int RankLevel::local(const BoxLattice::Place &node) const
  {
    const auto number
        = static_cast<dealii::types::global_dof_index>(lattice.number_of(node));
    if(const auto found = own.index_within_set(number);
       found != dealii::numbers::invalid_dof_index)
      return found;
    const auto found = ghosts.index_within_set(number);
    return found == dealii::numbers::invalid_dof_index
               ? dealii::numbers::invalid_unsigned_int
               : static_cast<unsigned int>(n_own()) + found;
  }

  void RankLevel::exchange(std::vector<double> &values, Traffic &traffic) const
  {
    ++traffic.exchanges;
    if(!shared)
      return;
    partitioner.export_to_ghosted_array(
        dealii::ArrayView<const double>(values.data(), n_own()),
        dealii::ArrayView<double>(values.data() + n_own(), ghosts.n_elements()));
    traffic.sent += partitioner.temporary_storage_size() - ghosts.n_elements();
  }

  void RankLevel::find_ghosts(const RankLevel *finer)
  {
    std::vector<dealii::types::global_dof_index> numbers;
    const auto take = [&](const BoxLattice::Place &node)
    {
      const auto number
          = static_cast<dealii::types::global_dof_index>(lattice.number_of(node));
      if(!own.is_element(number))
        numbers.push_back(number);
    };
    if(shared)
      for(const auto number : own)
        lattice.visit_around(lattice.place_of(number), take);
    if(shared && finer)
      for(const auto number : finer->own)
        BoxLattice::visit_coarser(finer->lattice.place_of(number),
                                  [&](const auto &node, double) { take(node); });
    ghosts = index_set(lattice, std::move(numbers));
  }

  dealii::IndexSet RankLevel::own_on_coarser() const
  {
    const BoxLattice coarser = lattice.coarser();
    std::vector<dealii::types::global_dof_index> numbers;
    for(const auto number : own)
    {
      const BoxLattice::Place node = lattice.place_of(number);
      if(node[0] % 2 == 0 && node[1] % 2 == 0 && node[2] % 2 == 0)
        numbers.push_back(static_cast<dealii::types::global_dof_index>(
            coarser.number_of({node[0] / 2, node[1] / 2, node[2] / 2})));
    }
    return index_set(coarser, std::move(numbers));
  }

  /** Edges conduct, with the mean of what lies across them at their two ends, which is
   * the same number whichever end comes first: both rows of a pair hold the same bits on
   * whatever ranks they are. */
  void RankLevel::conduct(const cases::Scene &scene)
  {
    const auto prescribes = [&](int side)
    {
      return scene.boundary(static_cast<cases::Side>(side)).kind
             == cases::BoundaryKind::fixed_temperature;
    };
    std::vector<RunEntry> row;
    for(const auto number : own)
    {
      const BoxLattice::Place node = lattice.place_of(number);
      row.clear();
      free.push_back(1);
      for(int d = 0; d < lattice.dimension; ++d)
      {
        const double length = lattice.spacing(d);
        const auto conducts = [&](int step)
        {
          BoxLattice::Place other = node;
          other[d] += step;
          const double measure
              = (lattice.measure(node, d) + lattice.measure(other, d)) / 2;
          row.push_back({local(other), measure / (length * length)});
        };
        const int side = 2 * lattice.coordinate(d);
        if(lattice.at_lower(node, d) ? prescribes(side)
                                     : lattice.at_upper(node, d) && prescribes(side + 1))
          free.back() = 0;
        if(!lattice.at_lower(node, d))
          conducts(-1);
        if(!lattice.at_upper(node, d))
          conducts(1);
      }
      std::ranges::sort(row, {}, &RunEntry::column);
      conduction.add_node(row);
    }
    conduction.close();
  }

  void RankLevel::interpolate(const RankLevel &finer)
  {
    std::vector<RunEntry> row;
    const auto n_fine = static_cast<unsigned int>(finer.n_own());
    const auto add_fine = [&](unsigned int i)
    {
      row.clear();
      BoxLattice::visit_coarser(finer.place(i),
                                [&](const BoxLattice::Place &node, double share) {
                                  row.push_back({local(node), share});
                                });
      to_finer.add_row(i, row);
    };
    // Of a row of the lattice every other node, then those between: each is a run.
    for(unsigned int first = 0, last = 0; first < n_fine; first = last)
    {
      const BoxLattice::Place start = finer.place(first);
      for(last = first + 1; last < n_fine; ++last)
        if(const BoxLattice::Place next = finer.place(last);
           next[1] != start[1] || next[2] != start[2])
          break;
      for(unsigned int i = first; i < last; i += 2)
        add_fine(i);
      for(unsigned int i = first + 1; i < last; i += 2)
        add_fine(i);
    }
    for(unsigned int i = 0; i < n_own(); ++i)
    {
      BoxLattice::Place same = place(i);
      for(unsigned int &along : same)
        along *= 2;
      row.clear();
      finer.lattice.visit_around(same,
                                 [&](const BoxLattice::Place &node)
                                 {
                                   double share = 1;
                                   for(std::size_t d = 0; d < 3; ++d)
                                     share /= 1 + node[d] % 2;
                                   row.push_back({finer.local(node), share});
                                 });
      from_finer.add_row(i, row);
    }
  }
} // namespace meltfront::reference_fem
