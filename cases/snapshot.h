#ifndef meltfront_cases_snapshot_h
#define meltfront_cases_snapshot_h

#include <cases/position.h>

#include <array>
#include <functional>
#include <span>

namespace meltfront::cases
{
  /**
   * Where the heat is. Extensive values in the measure of the scene (see
   * Snapshot::weights), counted from the start of the run; J, J/m or J/m^2.
   */
  struct HeatBudget
  {
    double stored = 0;   ///< sensible heat now: sum of rho c (T - T_m) over the domain
    double latent = 0;   ///< latent heat now: sum of rho L (1 - solid fraction)
    double boundary = 0; ///< heat in through walls since the start
    double sources = 0;  ///< heat from sources since the start (negative for sinks)
    double initial = 0;  ///< stored + latent at the start
    /** Whether the method balances heat; collocation, which solves equations at points,
     * does not: its defect is NaN, and what is stored as well if it keeps no book. */
    bool conservative = true;

    /** stored + latent - initial - boundary - sources; NaN if not conservative. */
    double imbalance() const;

    /** |imbalance| over the largest magnitude among its terms: round-off for a method
     * that conserves heat. */
    double defect() const;
  };

  /** Most solutes of an alloy. */
  inline constexpr std::size_t most_solutes = 2;

  /** How much of a substance there is, in the measure of the scene (kg, kg/m or kg/m^2);
   * no substance crosses a wall. */
  struct SubstanceBudget
  {
    double now = 0;
    double initial = 0;

    /** |now - initial| / initial; zero of nothing. */
    double defect() const;
  };

  /**
   * The state at a time in the form that every method shares. Views into the method's own
   * arrays, valid during Observer::observe only.
   */
  struct Snapshot
  {
    long step = 0;
    double time = 0;
    int dimension = 1; ///< of the sites

    /** Coordinates of the sites (particles, nodes or quadrature points), one array per
     * dimension. */
    std::array<std::span<const double>, 3> positions{};

    /**
     * Volume that each site stands for, in the measure of the scene: per area in a planar
     * scene (the sum is the slab's length, also where a strip is simulated in 2D), per
     * depth in 2D and cylindrical scenes (the sum is the area), volume in 3D and
     * spherical ones. A site that only holds a boundary value has weight zero.
     */
    std::span<const double> weights;
    std::span<const double> temperature;
    std::span<const double> solid_fraction;

    /**
     * Vertices of the mesh's cells, 2^dimension site numbers per cell in lexicographic
     * order; empty for particles.
     */
    std::span<const unsigned int> cells;

    /** Points on the front (m), one array per dimension, of a method that tracks it;
     * empty for one that does not. */
    std::array<std::span<const double>, 3> front{};

    /** At these points, of a method that carries a front along: the unit normal out of
     * the region, and the curvature (sum of the principal ones, positive where the region
     * is convex; 1/m). */
    std::array<std::span<const double>, 3> front_normal{};
    std::span<const double> front_curvature;

    /** The level set of a region that is carried along, positive inside: any point of the
     * domain (m). Empty in other scenes. */
    std::function<double(const Position &)> level_set;

    /** Velocities of the sites, one array per dimension, in a scene of moving particles.
     */
    std::array<std::span<const double>, 3> velocity{};

    /** Whether the method obeys the maximum principle at any spacing; those of high order
     * and those that track a front do so in the limit only. */
    bool obeys_maximum_principle = true;

    HeatBudget heat;

    /** Of bodies that a method took out because they were too small for it, its heat
     * shared out about them: what may still be there by the rate at which they shrank (in
     * the measure of the scene). Error bars of the solid's volume are no smaller. */
    double vanished_volume = 0;

    /** Of an alloy, for each solute: its mass over all the mass at a site; the liquid
     * there holds this over 1 - solid_fraction. Empty for a solute that is not simulated.
     */
    std::array<std::span<const double>, most_solutes> concentration{};
    SubstanceBudget mass; ///< of an alloy, all substances; of a method that counts it
    std::array<SubstanceBudget, most_solutes> solute{};
  };
} // namespace meltfront::cases

#endif
