#include <reference_fem/enthalpy/distributed/mpi_start.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <memory>

namespace meltfront::reference_fem
{
  namespace
  {
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi_alone;
  }

  void start_mpi_alone()
  {
    if(dealii::Utilities::MPI::job_supports_mpi())
      return;
    static char name[] = "meltfront";
    static char *words[] = {name, nullptr};
    int n_words = 1;
    char **arguments = words;
    mpi_alone = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(n_words,
                                                                           arguments, 1);
    const auto end_mpi = [] { mpi_alone.reset(); };
    std::atexit(end_mpi);
    // The runs of a matrix are processes of their own, which end quickly.
    std::at_quick_exit(end_mpi);
  }
} // namespace meltfront::reference_fem
