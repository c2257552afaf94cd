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

  /** Iterations over which the energy's fall is judged. */
  inline constexpr long descent_window = 100;

  /** How far and how long conjugate gradients go. */
  struct DescentParameters
  {
    double longest_step = 0;  ///< of a particle in one iteration (m)
    double stiffness = 0;     ///< of a particle's place (J/m^2); 0: no spreading before
    double tolerance = 1e-12; ///< stop when |change of energy| <= tolerance |energy|
    double least_fall = 0;    ///< stop when the energy fell by less over a window (J)
    long most_iterations = 200000;
  };

  /** What a descent did. */
  struct Descent
  {
    bool converged = false; ///< stopped by a tolerance, or at round-off
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
   * holds. Its first trial is where the slope would vanish if the energy had the
   * curvature along d_k that it had along d_{k-1}; it moves no particle by more than the
   * longest step. Where the slope behind an accepted trial exceeds 0.3 of that before it,
   * the place where the secant of both vanishes is tried too, and the lower one is
   * taken: 1.3 evaluations per iteration instead of five.
   *
   * Particles at random overlap: their forces differ by many orders, and no common step
   * suits them. While more than a hundredth of the particles are pushed by more than
   * stiffness times longest step, each moves along its own force, x_i -= g_i / max(
   * stiffness, |g_i| / limit), the limit at most the longest step, halved until Armijo's
   * condition holds. These steps count as iterations.
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
