#ifndef meltfront_particles_relaxation_conjugate_gradients_h
#define meltfront_particles_relaxation_conjugate_gradients_h

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace meltfront::particles
{
  /** One value per particle and direction; empty beyond the dimension. */
  using Coordinates = std::array<std::vector<double>, 3>;

  /** What particles must not leave. */
  struct CoordinateBox
  {
    int dimension = 1;
    std::array<double, 3> lower{}, upper{}; ///< m
  };

  /** How far and how long conjugate gradients go. */
  struct DescentParameters
  {
    double longest_step = 0;  ///< of a particle in one iteration (m)
    double tolerance = 1e-12; ///< stop when |change of energy| <= tolerance |energy|
    long most_iterations = 200000;
  };

  /** What a descent did. */
  struct Descent
  {
    bool converged = false; ///< stopped by the tolerance, or at round-off
    double energy_before = 0;
    double energy = 0;
    double largest_force = 0; ///< on a particle, without what the walls of the box bear
    long iterations = 0;
    long evaluations = 0; ///< of the energy with its gradient
  };

  /** Energy at coordinates, and its gradient. */
  using EnergyFunction
      = std::function<double(const Coordinates &, Coordinates &gradient)>;

  /**
   * Minimise an energy inside a box by nonlinear conjugate gradients,
   *
   *   d_k = -g_k + max(0, g_k . (g_k - g_{k-1}) / |g_{k-1}|^2) d_{k-1}
   *
   * (Polak and Ribiere 1969, with the restart of Gilbert and Nocedal 1992), started anew
   * after as many iterations as there are coordinates or where d_k does not descend. The
   * step along d_k is halved until Armijo's condition E_new <= E + 1e-4 g . (x_new - x)
   * holds. Its first trial moves the fastest particle by the longest step, but is at most
   * four times the last step accepted.
   *
   * Coordinates are clamped to the box. Those at a wall towards which the energy pushes
   * them belong to the active set: their gradient counts as zero. The energy never rises.
   *
   * @throws cases::NumericalError if the energy at the start is not finite.
   */
  Descent conjugate_gradients(const EnergyFunction &energy, Coordinates &coordinates,
                              const CoordinateBox &box,
                              const DescentParameters &parameters);
} // namespace meltfront::particles

#endif
