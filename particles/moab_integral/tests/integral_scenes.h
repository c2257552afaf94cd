#ifndef meltfront_particles_moab_integral_tests_integral_scenes_h
#define meltfront_particles_moab_integral_tests_integral_scenes_h

#include <particles/moab_integral/integral_rows.h>

#include <functional>

/** Particles on lines and squares, and Poisson's equation on them. */
namespace meltfront::particles::integral_scenes
{
  using Function = std::function<double(double x, double y)>;

  /** A solution with what the equation and its walls need of it. */
  struct Solution
  {
    Function value, laplacian;
    std::array<Function, 2> gradient;
  };

  struct Particles
  {
    NodeSet nodes;
    IntegralWalls walls;
  };

  /**
   * n particles along each side of [lower, upper]^dimension, those on walls included;
   * inner ones displaced by at most `jitter` spacings. Volumes of the lattice.
   * @param flux_sides bit s for a wall of Side s whose flux is given; the others have
   * given temperatures
   */
  Particles arrange(int dimension, int n, double lower, double upper, double jitter,
                    unsigned seed, std::uint8_t flux_sides);

  /** Largest |row applied to the solution| over the sum of its terms' magnitudes. */
  double row_defect(const Particles &particles, const IntegralRows &rows,
                    const Solution &solution);

  /** Root mean square error over the largest exact value (the report's (2.31)). */
  double poisson_error(const Particles &particles, const IntegralParameters &parameters,
                       const Solution &solution);

  /** sin(x) on a line. */
  Solution sine();

  /** x^a y^b. */
  Solution monomial(int a, int b);

  /** Slopes log2(e_k / e_(k+1)) of errors at doubled resolutions. */
  std::vector<double> orders(const std::vector<double> &errors);
} // namespace meltfront::particles::integral_scenes

#endif
