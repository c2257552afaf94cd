#include <cases/error.h>
#include <particles/level_set/advection.h>
#include <particles/level_set/weno.h>

#include <fmt/format.h>

namespace meltfront::particles::level_set
{
  namespace
  {
    /** Add -u_d dphi/dx_d along a run. */
    void add_transport(const double *phi, const std::ptrdiff_t step,
                       const double *velocity, const double per_spacing, const int length,
                       double *rate)
    {
#pragma omp simd
      for(int n = 0; n < length; ++n)
        rate[n] -= velocity[n] * per_spacing
                   * Differences(phi + n, step).from(velocity[n] > 0);
    }
  } // namespace

  VelocityFunction velocity_function(const cases::VelocityField &field)
  {
    return [&field](const cases::PointArrays &points, const double time,
                    const std::array<std::span<double>, 3> &result)
    { field.velocities(points, time, result); };
  }

  void Advection::step(LevelSet &level_set, const VelocityFunction &velocity,
                       const TimeStep &time_step)
  {
    const Grid &grid = level_set.grid();
    const double per_spacing = 1 / grid.spacing();
    double courant_number = 0;
    const auto prepare = [&](const int stage)
    {
      find_velocities(level_set, velocity,
                      time_step.time + RungeKutta::stage_times[stage] * time_step.length);
      courant_number = std::max(courant_number, largest_component(level_set)
                                                    * time_step.length * per_spacing);
      if(courant_number > 1)
        throw cases::NumericalError(
            "level set", time_step.number, time_step.time, "CFL number",
            fmt::format("of {:.3g} is above 1: shorter steps are needed",
                        courant_number));
    };
    const double *phi = level_set.values().data();
    const auto rate = [&](const NodeRun &run, double *result)
    {
      std::fill_n(result, run.length, 0.);
      for(int d = 0; d < grid.dimension(); ++d)
        add_transport(phi + run.node, grid.stride(d), &velocities[d][run.first],
                      per_spacing, run.length, result);
    };
    if(!runge_kutta.step(level_set, time_step.length, prepare, rate))
      throw cases::NumericalError("level set", time_step.number, time_step.time, "phi",
                                  "is not finite");
    level_set.follow(courant_number);
  }

  double Advection::longest_step(const LevelSet &level_set,
                                 const VelocityFunction &velocity, const double time,
                                 const double courant_number)
  {
    find_velocities(level_set, velocity, time);
    return courant_number * level_set.grid().spacing() / largest_component(level_set);
  }

  void Advection::find_velocities(const LevelSet &level_set,
                                  const VelocityFunction &velocity, const double time)
  {
    std::array<std::span<double>, 3> components;
    for(int d = 0; d < level_set.grid().dimension(); ++d)
    {
      velocities[d].resize(level_set.band().size());
      components[d] = velocities[d];
    }
    if(level_set.band().size() > 0)
      velocity(level_set.band_positions(), time, components);
  }

  double Advection::largest_component(const LevelSet &level_set) const
  {
    double largest = 0;
    for(int d = 0; d < level_set.grid().dimension(); ++d)
      for(const double component : velocities[d])
        largest = std::max(largest, std::abs(component));
    return largest;
  }
} // namespace meltfront::particles::level_set
