#ifndef meltfront_reference_fem_cut_conservative_bodies_h
#define meltfront_reference_fem_cut_conservative_bodies_h

#include <reference_fem/cut/conservative/front.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** What a front is at a time: all that the scheme carries from step to step. */
  struct FrontState
  {
    Values level_set;           ///< negative in the solid (m)
    std::array<Values, 2> heat; ///< by phase and hat, over the melting temperature (J/m)
    /** By how much the solid's area is behind the heat that the front has taken up, by
     * hat (m^2). */
    Values debt;
  };

  /** A connected part of a phase. */
  struct Body
  {
    Phase phase;
    std::vector<unsigned int> nodes;
    double area = 0; ///< m^2
  };

  /** All bodies, in the order of their first nodes. */
  std::vector<Body> bodies(const TriangleMesh &mesh, const Front &front,
                           const Values &level_set);

  /**
   * Turn a body into the other phase and book its heat hat by hat: what it held, its
   * latent heat, and the debt of its hats. All heat stays where it is; nothing is lost.
   * @param latent_heat of the volume (J/m^3)
   */
  void turn(const TriangleMesh &mesh, const Front &front, const Body &body,
            double latent_heat, FrontState &state);
} // namespace meltfront::reference_fem::cut::conservative

#endif
