#ifndef meltfront_particles_moab_integral_integral_rows_h
#define meltfront_particles_moab_integral_integral_rows_h

#include <particles/moab_integral/integral_weights.h>
#include <particles/scattered/compressed_rows.h>
#include <particles/scattered/node_set.h>

namespace meltfront::particles
{
  /** How rows of the integral method are made. */
  struct IntegralParameters
  {
    KernelShape kernel = KernelShape::wendland_c4;
    WeightPolicy weights = WeightPolicy::separate;
    int order = 3;                ///< K, degree up to which rows are exact
    double dilation = 2.5;        ///< in units of the spacing
    bool sampled_moments = false; ///< sums over the particles in place of the integrals
    bool enlarge = true; ///< the dilation of rows whose constraints cannot be met
    int threads = 1;
  };

  /** What holds at the particles on walls. */
  struct IntegralWalls
  {
    std::array<double, 2> lower{}, upper{}; ///< corners of the domain (m)
    std::vector<char>
        fixed; ///< of each particle: its temperature is given, it has no row
    /** Of each particle: bit s for a wall of Side s whose flux stands in its row. */
    std::vector<std::uint8_t> flux_sides;
  };

  /** A particle on a wall, and the part of the wall that it stands for. */
  struct WallParticle
  {
    std::uint32_t node;
    cases::Side side;
    double length; ///< m in 2D, 1 in 1D
  };

  /**
   * Rows of the integral method, each divided by the integral of its kernel: at particle
   * m
   *
   *   sum_n laplacian_mn u_n + sum_w flux_mw (du/dn)_w = sum_n load_mn (lap u)_n,
   *
   * n over particles, w over `wall_particles`. Rows of fixed particles are empty.
   */
  struct IntegralRows
  {
    CompressedRows laplacian; ///< 1/m^2
    CompressedRows load;      ///< 1
    CompressedRows flux;      ///< 1/m
    std::vector<WallParticle> wall_particles;

    long enlarged = 0;           ///< rows with a dilation beyond that asked for
    double largest_dilation = 0; ///< m
    double largest_residual = 0; ///< of a constraint, see IntegralWeights::compute
    long unmet = 0;              ///< rows whose residual is above the bound
    long work = 0;               ///< entries over all attempts
  };

  /** Residual above which constraints count as not met. */
  inline constexpr double constraint_bound = 1e-10;

  /**
   * Make the rows. With `enlarge` a row whose support has too few particles, or whose
   * constraints are not met, gets a dilation larger by a tenth until they are.
   *
   * @throws cases::NumericalError if `enlarge` reaches the size of the domain in vain, or
   * a row has no particles to make it of.
   */
  IntegralRows integral_rows(const NodeSet &nodes, const IntegralWalls &walls,
                             const IntegralParameters &parameters);
} // namespace meltfront::particles

#endif
