#include <particles/sph/time/explicit_scheme.h>

namespace meltfront::particles
{
  void ExplicitScheme::add(double factor, const std::vector<double> &added,
                           std::vector<double> &state) const
  {
    double *y = state.data();
    const double *f = added.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)
    for(std::size_t i = 0; i < active; ++i)
      y[i] += factor * f[i];
  }

  void ExplicitScheme::combine(const SuperStage &stage, double factor,
                               const std::vector<double> &state)
  {
    const double *previous = state.data(), *first = start.data();
    const double *f = flow.data(), *first_flow = start_flow.data();
    double *next = before.data();
#pragma omp parallel for simd schedule(static) num_threads(threads) if(threads > 1)
    for(std::size_t i = 0; i < active; ++i)
      next[i] = stage.previous * previous[i] + stage.before * next[i]
                + stage.start * first[i]
                + factor * (stage.rate * f[i] + stage.start_rate * first_flow[i]);
  }
} // namespace meltfront::particles
