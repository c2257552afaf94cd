#ifndef meltfront_particles_rkpm_reproducing_weights_h
#define meltfront_particles_rkpm_reproducing_weights_h

#include <particles/rkpm/moment_engine.h>
#include <particles/rkpm/supports.h>

namespace meltfront::particles::rkpm
{
  /** What had to be done so that every point's neighbours determine its polynomial. */
  struct SupportRecord
  {
    std::size_t enlarged = 0;    ///< points with a larger support than the rule's
    std::size_t lowered = 0;     ///< points with a lower order than asked for
    int most_enlargements = 0;   ///< of one point
    int lowest_order = 0;        ///< of all points
    double least_rank_ratio = 0; ///< of all points
  };

  /** Weights of the value, gradient and second derivatives at many points. */
  struct ReproducingWeights
  {
    int dimension = 1;
    Supports supports;
    std::vector<std::vector<double>> weights; ///< by derivative, one for each neighbour
    std::vector<int> enlargements;            ///< of each point's support
    std::vector<int> order;                   ///< of each point's basis
    SupportRecord record;

    std::span<const double> operator()(int derivative, std::size_t point) const
    {
      const std::size_t begin = supports.offsets[point];
      return {weights[derivative].data() + begin, supports.offsets[point + 1] - begin};
    }

    /** Apply derivative j to nodal values at a point. */
    double apply(int derivative, std::size_t point, std::span<const double> values) const;
  };

  /**
   * Weights at points, with supports enlarged where the neighbours do not determine the
   * polynomial (up to eight times), and a lower order as the last resort; both are
   * recorded. The result has the same bits for any number of threads.
   *
   * `multiple_fixed` is for the particles themselves as points.
   *
   * @throws cases::InputError where not even order 1 is determined, as for particles on
   *         one line in 2D, or for settings that do not fit together.
   */
  ReproducingWeights compute_weights(const ParticleStorage &points,
                                     const ParticleStorage &particles,
                                     const MomentSettings &how,
                                     const SupportSettings &support_settings,
                                     int threads);
} // namespace meltfront::particles::rkpm

#endif
