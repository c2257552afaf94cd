#ifndef meltfront_reference_fem_cut_conservative_appearance_h
#define meltfront_reference_fem_cut_conservative_appearance_h

#include <cases/scene.h>
#include <reference_fem/cut/conservative/bodies.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** A body that came to be in the other phase. */
  struct Appearance
  {
    Phase phase;
    double area; ///< m^2
    Point place; ///< a node of it
  };

  /** Where the other phase may appear in a phase, and what of. */
  struct AppearanceSetting
  {
    AppearanceSetting(const TriangleMesh &mesh, const cases::Scene &scene, double reach);

    const TriangleMesh &mesh;
    const cases::Domain &domain;
    std::vector<cases::Side> walls;
    /** Walls that layers begin on: those that are not insulated. Right beside a front,
     * too, as where its contact runs along the wall. */
    std::vector<cases::Side> driving_walls;
    std::vector<char> at_driving_wall; ///< by node, within a spacing of one
    double latent_heat;                ///< of the volume (J/m^3)
    double reach;                      ///< up to which the level set is a distance (m)
  };

  /** Whether a layer can hold nodes on a wall that drives it: two of them at least. */
  bool lies_along_wall(const AppearanceSetting &setting,
                       const std::vector<unsigned int> &nodes);

  /**
   * Where a phase is undercooled (superheated) away from any front, what it lacks (has
   * too much) of heat is the latent heat of a body of the other phase at the melting
   * temperature. Once that is a twentieth of a cell thick somewhere, and larger than
   * bodies that are booked as vanished, it is put there: as a layer on the wall that is
   * nearest, as thick as the heat along the wall's normal says, or as a disk about the
   * node farthest beyond the melting temperature where no wall is near. The hats'
   * latent heat takes the place of that heat; what the body's area is off by is debt of
   * its hats. No heat is lost or gained.
   *
   * @param tolerated heat beyond the melting temperature, by phase (J/m^3)
   */
  std::vector<Appearance> let_phases_appear(const AppearanceSetting &setting,
                                            const std::array<double, 2> &tolerated,
                                            FrontState &state);

  /** By how much a phase's heat is at most beyond the melting temperature away from any
   * front, over what is tolerated. */
  double largest_excess(const AppearanceSetting &setting,
                        const std::array<double, 2> &tolerated, const Values &level_set,
                        const std::array<Values, 2> &heat);
} // namespace meltfront::reference_fem::cut::conservative

#endif
