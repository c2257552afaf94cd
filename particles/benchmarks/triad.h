#ifndef meltfront_particles_benchmarks_triad_h
#define meltfront_particles_benchmarks_triad_h

namespace meltfront::particles::benchmarks
{
  /**
   * Bandwidth of the memory (byte/s) by the triad a = b + s c over arrays far beyond the
   * caches, 24 bytes per element, the best of some repeats (J. D. McCalpin, IEEE TCCA
   * Newsletter, 1995).
   */
  double triad_bandwidth(int threads);
} // namespace meltfront::particles::benchmarks

#endif
