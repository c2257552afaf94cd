#ifndef meltfront_particles_level_set_level_set_h
#define meltfront_particles_level_set_level_set_h

#include <particles/level_set/band.h>
#include <particles/level_set/fast_marching.h>

#include <functional>
#include <limits>

namespace meltfront::particles::level_set
{
  /** Any function of place. */
  using ScalarFunction = std::function<double(const Position &)>;

  /** How a level set is kept. */
  struct LevelSetParameters
  {
    /** Layers of nodes on either side of the front that are computed; 0: the whole
     * grid. */
    int band_layers = 6;
    int threads = 1; ///< results have the same bits for any number
  };

  /**
   * A front as the zero contour of phi on the nodes of a grid: phi > 0 in the phase that
   * is followed, phi <= 0 outside, |phi| the distance (m).
   *
   * Only a band of nodes about the front is computed. Around it lies a halo, three layers
   * that differences reach into; its values come from fast marching when the band is
   * rebuilt and rest in between. All other nodes hold +-far_value(), the sign of their
   * side. The work of every function but the constructor grows with the length of the
   * front (its area in 3D), not with the grid.
   *
   * @code
   * LevelSet front(Grid(2, {0, 0, 0}, 0.0125, {80, 80, 0}),
   *                [](const Position &p) { return 0.15 - std::hypot(p[0] - 0.5, p[1] -
   * 0.75); }); const double distance = front.value({0.5, 0.61, 0});
   * @endcode
   */
  class LevelSet
  {
  public:
    /**
     * @param initial phi at the start, its sign right everywhere, a distance near the
     * front (m)
     * @throws cases::InputError if it is not a finite number at a node
     */
    LevelSet(const Grid &grid, const ScalarFunction &initial,
             const LevelSetParameters &parameters = {});

    const Grid &grid() const
    {
      return lattice;
    }

    const LevelSetParameters &parameters() const
    {
      return settings;
    }

    /** phi at all nodes, ghosts included (m). Who changes it calls fill_ghosts() or, if
     * the front moved, rebuild_band(). */
    std::span<double> values()
    {
      return phi;
    }

    std::span<const double> values() const
    {
      return phi;
    }

    /** The nodes that are computed. */
    const Band &band() const
    {
      return computed;
    }

    /** The band and its halo. */
    const Band &band_with_halo() const
    {
      return extended;
    }

    /** Where the band's nodes are, in its order. */
    cases::PointArrays band_positions() const;

    /** |phi| of nodes beyond the halo, the diagonal of the band's and the halo's layers
     * (m). */
    double far_value() const;

    /** phi at a point, bilinear or trilinear (m); beyond the grid extrapolated. */
    double value(const Position &point) const
    {
      return interpolate(lattice, phi.data(), lattice.locate(point));
    }

    /** Gradient at a point: central differences at the nodes, interpolated. Right within
     * the band. */
    Position gradient(const Position &point) const
    {
      return interpolate_gradient(lattice, phi.data(), lattice.locate(point));
    }

    /**
     * Values at the ghost nodes near the band: along each coordinate the straight line
     * through the last two nodes.
     * @param level_beyond where |phi| is larger than this on the border it does not fall
     * outwards (m): a line that led to zero out there would be a front that no one put
     * there
     */
    void fill_ghosts(double level_beyond = std::numeric_limits<double>::infinity());

    /**
     * Lay the band anew about the front, which must still be well within the old
     * one. Nodes that enter it get the distances that fast marching
     * finds; without a front nothing is left of the band.
     */
    void rebuild_band();

    /** Tell that the front moved by up to so many spacings; the band is rebuilt before
     * that sums up to more than a third of its layers. */
    void follow(double spacings);

    /** phi at all nodes: within the band as it is, beyond it by fast marching (m). */
    std::vector<double> distances_everywhere() const;

  private:
    /** A place on the grid's border from where a line of ghosts goes out. */
    struct GhostLine
    {
      std::size_t node;
      std::ptrdiff_t outwards;

      auto operator<=>(const GhostLine &) const = default;
    };

    std::vector<Interval> nodes_at_front(const Band &searched) const;
    void lay_band(std::vector<Interval> front);
    void drop(const Band &old);
    void find_ghost_lines();
    void find_positions();

    Grid lattice;
    LevelSetParameters settings;
    std::vector<double> phi;
    std::vector<std::uint8_t> states; ///< known: in the band
    Band computed, extended;
    std::array<std::vector<double>, 3> positions; ///< of the band's nodes
    std::vector<GhostLine> ghost_lines;
    FastMarching marching;
    double moved = 0; ///< since the band was laid, in spacings
  };
} // namespace meltfront::particles::level_set

#endif
