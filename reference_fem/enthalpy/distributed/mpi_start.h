#ifndef meltfront_reference_fem_enthalpy_distributed_mpi_start_h
#define meltfront_reference_fem_enthalpy_distributed_mpi_start_h

namespace meltfront::reference_fem
{
  /**
   * Start MPI, with what deal.II starts beside it (p4est), in a process that needs it and
   * was not started on several ranks: there main has done so. It ends with the process,
   * also with one that ends by std::quick_exit. Further calls do nothing.
   */
  void start_mpi_alone();
} // namespace meltfront::reference_fem

#endif
