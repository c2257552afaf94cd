#include <reference_fem/enthalpy/distributed/node_shares.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    using NodeNumber = dealii::types::global_dof_index;

    /** The blocks of cells that are shared out as a whole. */
    struct Blocks
    {
      /** Ranks differ by a block: by one in a hundred, where there are cells enough. */
      Blocks(const BoxLattice &lattice, unsigned int ranks)
      {
        constexpr double blocks_of_rank = 100;
        int possible = 31;
        double count = 1;
        for(int d = 0; d < lattice.dimension; ++d)
          possible = std::min(possible, std::countr_zero(lattice.cells[d]));
        for(int d = 0; d < lattice.dimension; ++d)
        {
          of_root.push_back(lattice.cells[d] >> possible);
          count *= of_root.back();
        }
        for(; refinements < possible && count < blocks_of_rank * ranks; ++refinements)
          count *= lattice.n_corners();
        cells_along = 1u << (possible - refinements);
      }

      std::vector<unsigned int> of_root; ///< by direction
      int refinements = 0;               ///< of those
      unsigned int cells_along = 1;      ///< a block
    };

    /** Add those of a block, row by row. */
    void add_nodes(const BoxLattice &lattice, const BoxLattice::Place &first,
                   unsigned int cells_along, std::vector<NodeNumber> &numbers)
    {
      BoxLattice::Place last = first;
      for(int d = 0; d < lattice.dimension; ++d)
      {
        last[d] += cells_along;
        // Other than on the upper side the next block begins there.
        last[d] -= last[d] < lattice.cells[d] ? 1 : 0;
      }
      BoxLattice::visit_between(
          first, last,
          [&](const BoxLattice::Place &node)
          { numbers.push_back(static_cast<NodeNumber>(lattice.number_of(node))); });
    }

    template <int dim>
    std::vector<NodeNumber> shared_out(const BoxLattice &lattice, MPI_Comm communicator)
    {
      const Blocks blocks(lattice, dealii::Utilities::MPI::n_mpi_processes(communicator));
      dealii::parallel::distributed::Triangulation<dim> triangulation(communicator);
      dealii::Point<dim> cells;
      for(int d = 0; d < dim; ++d)
        cells[d] = lattice.cells[d];
      dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, blocks.of_root,
                                                        dealii::Point<dim>(), cells);
      triangulation.refine_global(blocks.refinements);
      std::vector<NodeNumber> numbers;
      for(const auto &block : triangulation.active_cell_iterators())
      {
        if(!block->is_locally_owned())
          continue;
        BoxLattice::Place first{};
        for(int d = 0; d < dim; ++d)
          first[d] = static_cast<unsigned int>(std::lround(block->vertex(0)[d]));
        add_nodes(lattice, first, blocks.cells_along, numbers);
      }
      return numbers;
    }
  } // namespace

  dealii::IndexSet own_nodes(const BoxLattice &lattice, MPI_Comm communicator)
  {
    std::vector<NodeNumber> numbers = lattice.dimension == 2
                                          ? shared_out<2>(lattice, communicator)
                                          : shared_out<3>(lattice, communicator);
    std::ranges::sort(numbers);
    dealii::IndexSet result(static_cast<NodeNumber>(lattice.n_nodes()));
    result.add_indices(numbers.begin(), numbers.end());
    result.compress();
    return result;
  }
} // namespace meltfront::reference_fem
