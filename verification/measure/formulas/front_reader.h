#ifndef meltfront_verification_measure_formulas_front_reader_h
#define meltfront_verification_measure_formulas_front_reader_h

#include <cases/exact_solution.h>
#include <cases/scene.h>
#include <cases/snapshot.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace meltfront::verification
{
  /** The coordinate of the front (m) as four readings of one snapshot give it; NaN where
   * a reading finds none. */
  struct FrontReading
  {
    /** Encloses the volume that is solid: sum of weight x solid fraction, and the hole of
     * a shell; of the liquid where that lies inside. In an alloy, whose mush no volume
     * tells from the liquid: the isotherm. */
    double latent_heat;
    double isotherm; ///< where T = T_m; in an alloy, where crystals first stand
    /** Largest coordinate of a fully frozen site plus half the smoothing length (Error-1
     * of Monaghan, Huppert and Worster 2005, Table 1). */
    double max_ice;
    /** Largest coordinate of a site with more than a quarter of its latent heat lost
     * (Error-2 of the same table). */
    double heat_loss;
  };

  /** The one coordinate that a case's solution depends on: that of the exact solution,
   * else of the scene, else the distance from the origin in the scene's dimension. */
  cases::Symmetry measured_symmetry(const cases::Scene &scene,
                                    const cases::ExactSolution *exact);

  /**
   * Whether solid holds the origin of the coordinate, or what lies next to the hole of a
   * shell. The exact solution says so; without one, the initial front of a symmetric
   * scene, the source that acts (a sink freezes), the initial front of a scene without
   * symmetry, the wall at the origin (x_min of a planar scene, the inner one of a shell:
   * or its surroundings below the melting point, or cooling), or the initial temperature
   * there.
   */
  bool solid_holds_origin(const cases::Scene &scene, const cases::ExactSolution *exact);

  /**
   * Where a temperature profile crosses the melting point.
   *
   * Linear interpolation between the first two neighbours that lie on either side of it;
   * the middle of a stretch at the melting point between them. A stretch that reaches an
   * end of the profile is a phase at its melting point, and its other end is the front.
   *
   * @param coordinate ascending (m)
   * @param excess T - T_m
   * @return NaN if the profile does not reach the melting point or never leaves it
   */
  double isotherm_crossing(std::span<const double> coordinate,
                           std::span<const double> excess);

  /** Sites gathered into shells of equal width along the coordinate. */
  struct Shells
  {
    /** Shells are centred on multiples of their width from the first site, so that the
     * rows of a lattice fall into one each; those without a site are left out. */
    Shells(const std::vector<double> &coordinates, double width);

    /** Mean over the sites of each shell. */
    std::vector<double> means(std::span<const double> values) const;

    std::vector<std::uint32_t> shell_of_site;
    std::vector<int> sites;
    std::vector<double> coordinate; ///< mean of the sites' (m), ascending
  };

  /** Reads the front of snapshots of one run; the same code for every method. */
  class FrontReader
  {
  public:
    /**
     * @param scene the scene as it was simulated
     * @param exact its exact solution, or null
     * @param spacing of particles, or cell size (m): the width of the shells over which
     * the temperature of sites in 2D and 3D is averaged before the isotherm is read
     * @param smoothing_length of the particles' kernel (m), 0 for a mesh
     */
    FrontReader(const cases::Scene &scene, const cases::ExactSolution *exact,
                double spacing, double smoothing_length);

    FrontReading read(const cases::Snapshot &snapshot);

    /** Coordinates of the snapshot's sites (m), valid until the next call. */
    const std::vector<double> &coordinates(const cases::Snapshot &snapshot);

  private:
    double by_latent_heat(const cases::Snapshot &snapshot,
                          const std::vector<double> &coordinate);
    double enclosing(const cases::Snapshot &snapshot, bool solid) const;
    void find_phase_at_origin(const cases::Snapshot &snapshot,
                              const std::vector<double> &coordinate);
    double by_isotherm(const cases::Snapshot &snapshot,
                       const std::vector<double> &coordinate);
    void read_extreme_sites(const cases::Snapshot &snapshot,
                            const std::vector<double> &coordinate,
                            FrontReading &reading) const;

    cases::Symmetry symmetry;
    bool solid_at_origin;
    bool sites_tell_phase;    ///< at the origin, as walls may change it
    double origin = 0;        ///< of the coordinate in a planar scene (m)
    double cross_section = 1; ///< by which a box's volume is divided to give a length
    double hole = 0;          ///< of a shell, in the measure of the scene
    bool alloy;
    double melting_temperature; ///< of an alloy: where the melt begins to freeze
    double spacing;
    double smoothing_length;
    SiteCoordinates site_coordinates;
    std::optional<Shells> shells; ///< of the coordinates of `shells_version`
    long shells_version = 0;
  };
} // namespace meltfront::verification

#endif
