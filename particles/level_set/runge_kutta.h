#ifndef meltfront_particles_level_set_runge_kutta_h
#define meltfront_particles_level_set_runge_kutta_h

#include <particles/level_set/level_set.h>

namespace meltfront::particles::level_set
{
  /**
   * Steps of the Runge-Kutta method of order 3 that keeps what the Euler step keeps (Shu
   * and Osher 1988), along the band: phi_1 = E phi, phi_2 = 3/4 phi + 1/4 E phi_1, new
   * phi = 1/3 phi + 2/3 E phi_2, with E phi = phi + dt rate(phi).
   */
  class RungeKutta
  {
  public:
    /** Where in a step the stages' rates are taken. */
    static constexpr std::array<double, 3> stage_times{0, 1, 0.5};

    /**
     * Take a step.
     * @param prepare what to do before a stage: prepare(stage)
     * @param rate rates of phi along one run: rate(run, result), called for several runs
     * at once
     * @param level_beyond see LevelSet::fill_ghosts
     * @return whether all new values are numbers
     */
    template <typename Prepare, typename Rate>
    bool step(LevelSet &level_set, double length, const Prepare &prepare,
              const Rate &rate,
              double level_beyond = std::numeric_limits<double>::infinity())
    {
      constexpr std::array<double, 3> share{1, 0.25, 2. / 3};
      const auto runs = level_set.band().runs();
      double *phi = level_set.values().data();
      start.resize(level_set.band().size());
      rates.resize(level_set.band().size());
      bool good = true;
      for(int stage = 0; stage < 3; ++stage)
      {
        prepare(stage);
        const double weight = share[stage];
#pragma omp parallel num_threads(level_set.parameters().threads)
        {
#pragma omp for schedule(static)
          for(std::size_t r = 0; r < runs.size(); ++r)
          {
            if(stage == 0)
              std::copy_n(phi + runs[r].node, runs[r].length, &start[runs[r].first]);
            rate(runs[r], &rates[runs[r].first]);
          }
#pragma omp for schedule(static) reduction(&& : good)
          for(std::size_t r = 0; r < runs.size(); ++r)
          {
            double *value = phi + runs[r].node;
            const double *first = &start[runs[r].first], *change = &rates[runs[r].first];
            for(int n = 0; n < runs[r].length; ++n)
            {
              // in this form what has no rate stays as it is to the bit
              value[n] = first[n] + weight * (value[n] - first[n] + length * change[n]);
              good = good && std::abs(value[n]) < 1e300;
            }
          }
        }
        level_set.fill_ghosts(level_beyond);
      }
      return good;
    }

  private:
    std::vector<double> start, rates; ///< along the band
  };
} // namespace meltfront::particles::level_set

#endif
