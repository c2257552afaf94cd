#include <particles/rkpm_tracked/node_relaxation.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Stiffness of the springs to the nodes' homes, over epsilon / sigma^2. */
    constexpr double spring = 10;

    /** Curvature of the energy of a node among others, over epsilon / sigma^2. */
    constexpr double stiffness = 100;

    /** Of a node in an iteration, over sigma. */
    constexpr double longest_step = 0.1;

    /** Nodes start near rest: what more iterations would win moves nothing. */
    constexpr double tolerance = 1e-5;
    constexpr long most_descents = 100;

    const double least_of_potential = std::cbrt(std::numbers::sqrt2); // 2^(1/6)

    LennardJones potential_of(const NodeRelaxation &how)
    {
      if(how.rule == RelaxRule::lennard_jones)
        return {.length = how.spacing};
      return {.length = how.spacing / least_of_potential, .cutoff = least_of_potential};
    }
  } // namespace

  Descent relax_phase(ParticleStorage &moving, const ParticleStorage &homes,
                      const ParticleStorage &fixed, const CoordinateBox &box,
                      const NodeRelaxation &how)
  {
    if(moving.size() == 0)
      return {.converged = true};
    const LennardJones potential = potential_of(how);
    const double unit = potential.energy / (potential.length * potential.length);
    const double pull = how.rule == RelaxRule::springs ? spring * unit : 0;
    LennardJonesEnergy repulsion(box.dimension, fixed, potential, how.threads);
    const auto energy = [&](const Coordinates &places, Coordinates &gradient)
    {
      double sum = repulsion(places, gradient);
      for(int d = 0; d < box.dimension; ++d)
        for(std::size_t i = 0; i < places[d].size(); ++i)
        {
          const double away = places[d][i] - homes.position[d][i];
          sum += pull / 2 * away * away;
          gradient[d][i] += pull * away;
        }
      return sum;
    };
    return conjugate_gradients(energy, moving.position, box,
                               {.longest_step = longest_step * potential.length,
                                .stiffness = stiffness * unit,
                                .tolerance = tolerance,
                                .most_iterations = most_descents});
  }
} // namespace meltfront::particles::rkpm_tracked
