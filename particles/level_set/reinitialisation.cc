#include <cases/error.h>
#include <particles/level_set/reinitialisation.h>
#include <particles/level_set/weno.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    constexpr double near_front = 3; ///< spacings

    /** Add Godunov's (dphi/dx_d)^2 dx^2 along a run. */
    void add_slope(const double *phi, const std::ptrdiff_t step, const double *sign,
                   const int length, double *result)
    {
#pragma omp simd
      for(int n = 0; n < length; ++n)
      {
        const Differences differences(phi + n, step);
        const double below = differences.from_below(), above = differences.from_above();
        const bool inside = sign[n] > 0;
        // information comes from the front: up the slope inside, down the slope outside
        const double incoming = std::max(inside ? below : -below, 0.);
        const double outgoing = std::max(inside ? -above : above, 0.);
        result[n] += std::max(incoming * incoming, outgoing * outgoing);
      }
    }
  } // namespace

  void Reinitialisation::operator()(LevelSet &level_set, const int iterations)
  {
    const Grid &grid = level_set.grid();
    const double spacing = grid.spacing();
    const double *phi = level_set.values().data();
    sign.resize(level_set.band().size());
    for(const NodeRun &run : level_set.band().runs())
      for(int n = 0; n < run.length; ++n)
      {
        const double value = phi[run.node + n];
        sign[run.first + n] = value / std::sqrt(value * value + spacing * spacing);
      }
    const auto rate = [&](const NodeRun &run, double *result)
    {
      const double *side = &sign[run.first];
      std::fill_n(result, run.length, 0.);
      for(int d = 0; d < grid.dimension(); ++d)
        add_slope(phi + run.node, grid.stride(d), side, run.length, result);
      for(int n = 0; n < run.length; ++n)
        result[n] = -side[n] * (std::sqrt(result[n]) / spacing - 1);
    };
    // distances come from the front alone, nothing far from it comes in from outside
    const double level_beyond = near_front * spacing;
    level_set.fill_ghosts(level_beyond);
    for(int iteration = 0; iteration < iterations; ++iteration)
      if(!runge_kutta.step(
             level_set, spacing / 2, [](int) {}, rate, level_beyond))
        throw cases::NumericalError("level set", iteration, 0, "phi",
                                    "is not finite in its reinitialisation");
    level_set.rebuild_band();
  }
} // namespace meltfront::particles::level_set
