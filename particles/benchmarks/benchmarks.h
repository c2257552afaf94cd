#ifndef meltfront_particles_benchmarks_benchmarks_h
#define meltfront_particles_benchmarks_benchmarks_h

/** The benchmarks, in the order of the table. */
namespace meltfront::particles::benchmarks
{
  /** Sweeps of the particle operator over one and two fields, in cache and beyond it. */
  void register_operator_benchmarks();

  /** Heat and a solute between particles of a mixture. */
  void register_mixture_benchmarks();

  /** Building lists of neighbours. */
  void register_neighbour_benchmarks();

  /** Weights of reproducing kernels. */
  void register_moment_benchmarks();

  /** Steps of particle solids. */
  void register_solid_benchmarks();

  /** Energies of relaxations, and relaxations. */
  void register_relaxation_benchmarks();

  /** Steps of level sets. */
  void register_level_set_benchmarks();

  /** Steps of level sets with markers. */
  void register_marker_benchmarks();

  /** Whole runs. */
  void register_run_benchmarks();
} // namespace meltfront::particles::benchmarks

#endif
