#ifndef meltfront_particles_greenspan_experiments_h
#define meltfront_particles_greenspan_experiments_h

#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/phases.h>

#include <cstdint>
#include <string>

namespace meltfront::particles::greenspan
{
  /** The steps begin + 1 to end of a run. */
  struct RunStage
  {
    long begin, end;
  };

  /** A melting of the report: what is heated, how and for how long. */
  struct Experiment
  {
    std::string name;
    ParticleState start;
    MotionParameters parameters;
    long steps = 0;
    PhaseTest test = PhaseTest::average_speed;
    long interval = 100; ///< steps from one look at the particles to the next
    std::vector<std::uint32_t> corners; ///< particles whose last triangle is looked for
    std::vector<RunStage> stages;       ///< whose structure is looked at
  };

  /** What one run of an experiment was like. Steps are -1 where a thing never happened.
   */
  struct RunRecord
  {
    long first_break = -1;  ///< a bond of the start is missing
    long first_fluid = -1;  ///< first fluid particle from step 1000 on
    long unheated = -1;     ///< no particle is within the source's reach
    long all_fluid = -1;    ///< no solid particle is left
    std::vector<int> solid; ///< number of solid particles at each look, from step 0
    int least_solid = 0;
    int old_bonds = 0;                      ///< bonds of the start that the end has
    std::vector<std::uint32_t> final_fluid; ///< particles, counted from 1
    bool base_buckled
        = false; ///< one that lay on the base lies higher than 0.2 at the end
    double lowest_x = 0, highest_x = 0; ///< at the end
    double highest_y = 0;               ///< at any look
    double kinetic_energy = 0;          ///< at the end, from the stored velocities
    double mean_temperature = 0;        ///< at the end; 0 where it is not kept

    /** Where a corner leaves its last triangle of bonds for the first time. */
    struct Corner
    {
      long step = -1;
      double temperature = 0;
    };
    std::vector<Corner> corners;
  };

  /** Gaussian noise on all coordinates; who would lie below the base lies on it. */
  void disturb(ParticleState &state, double deviation, std::uint64_t seed);

  /** Mean, standard deviation and number of some values. */
  struct Spread
  {
    double mean = 0;
    double deviation = 0;
    int count = 0;

    double standard_error() const;
  };

  Spread spread(const std::vector<double> &values);
} // namespace meltfront::particles::greenspan

#endif
