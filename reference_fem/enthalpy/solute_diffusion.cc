#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/solute_diffusion.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    double harmonic_mean(double a, double b)
    {
      return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0;
    }
  } // namespace

  SoluteDiffusion::SoluteDiffusion(const Discretisation &mesh, double density,
                                   const LinearSolverMaker &make_linear_solver)
    : mesh(mesh)
    , density(density)
    , network(mesh.conduction)
    , linear_solver(make_linear_solver(network))
    , active(mesh.volume.size())
    , liquid_mass(mesh.volume.size())
    , in_liquid(mesh.volume.size())
    , residual(mesh.volume.size())
    , change(mesh.volume.size())
  {
    effect_cost.bytes = static_cast<long>(
        network.column.size() * (sizeof(double) + sizeof(unsigned int))
        + mesh.volume.size() * (5 * sizeof(double) + sizeof(std::size_t) + sizeof(char)));
  }

  void SoluteDiffusion::set_liquid(const std::vector<double> &mass_fraction)
  {
    const cases::ScopedTimer timer(effect_cost.seconds);
    network.weigh(mesh.conduction,
                  [&](std::size_t a, std::size_t b) {
                    return density * harmonic_mean(mass_fraction[a], mass_fraction[b]);
                  });
    linear_solver->conductances_changed();
    for(std::size_t i = 0; i < active.size(); ++i)
    {
      active[i] = mass_fraction[i] > 0;
      liquid_mass[i] = density * mesh.volume[i] * mass_fraction[i];
    }
  }

  void SoluteDiffusion::step(double c, double diffusivity,
                             const std::vector<double> &supply,
                             const std::vector<double> &fixed,
                             std::vector<double> &concentration)
  {
    constexpr double reduction = 1e-14;
    const cases::ScopedTimer timer(effect_cost.seconds);
    ++effect_cost.calls;
    const std::size_t n = active.size();
    const auto mass = [&](std::size_t i) { return density * mesh.volume[i]; };
    for(std::size_t i = 0; i < n; ++i)
      in_liquid[i]
          = active[i] ? (concentration[i] - fixed[i]) * mass(i) / liquid_mass[i] : 0;
    double square = 0;
    for(std::size_t i = 0; i < n; ++i)
    {
      residual[i] = active[i] ? supply[i] - mass(i) * concentration[i]
                                    + c * diffusivity * network.inflow(i, in_liquid)
                              : 0;
      square += supply[i] * supply[i];
    }
    linear_solver->solve(
        {liquid_mass, c * diffusivity, active, residual, reduction * std::sqrt(square)},
        reduction, change);
    for(std::size_t i = 0; i < n; ++i)
      in_liquid[i] += change[i];
    for(std::size_t i = 0; i < n; ++i)
      concentration[i]
          = (supply[i] + c * diffusivity * network.inflow(i, in_liquid)) / mass(i);
  }

  long SoluteDiffusion::work() const
  {
    return linear_solver->work();
  }
} // namespace meltfront::reference_fem
