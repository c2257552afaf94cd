#ifndef meltfront_particles_greenspan_motion_particle_state_h
#define meltfront_particles_greenspan_motion_particle_state_h

#include <particles/greenspan/motion/periodic_space.h>

namespace meltfront::particles::greenspan
{
  /**
   * All that a motion depends on, particle by particle in the order in which they were
   * given: what a run starts from, shows and goes on from.
   */
  struct ParticleState
  {
    int dimension = 2;
    long step = 0; ///< steps taken

    /** The stored velocities are those half a step after the positions, as leapfrog keeps
     * them; otherwise both are of the same time, as in the tables. */
    bool staggered = false;

    std::array<std::vector<double>, 3> position; ///< empty beyond the dimension
    std::array<std::vector<double>, 3> velocity; ///< empty beyond the dimension

    /** Sum of each particle's kinetic energy over the steps taken: `step` times its
     * temperature (section 5 of the report). Empty where it is not kept. */
    std::vector<double> kinetic_sum;

    Period period{}; ///< of space

    std::size_t size() const
    {
      return position[0].size();
    }

    /** Add a particle at rest. */
    void add(const std::array<double, 3> &point)
    {
      for(int d = 0; d < dimension; ++d)
      {
        position[d].push_back(point[d]);
        velocity[d].push_back(0);
      }
    }
  };

  /** From a particle to the nearest image of another one. */
  inline double distance(const ParticleState &state, std::size_t a, std::size_t b)
  {
    double squared = 0;
    for(int d = 0; d < state.dimension; ++d)
    {
      const double way
          = NearestImage(state.period[d])(state.position[d][a] - state.position[d][b]);
      squared += way * way;
    }
    return std::sqrt(squared);
  }
} // namespace meltfront::particles::greenspan

#endif
