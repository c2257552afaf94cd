#ifndef meltfront_verification_external_sample_places_h
#define meltfront_verification_external_sample_places_h

#include <cases/scene.h>

#include <vector>

namespace meltfront::verification::external
{
  /** Places of a lattice of n cells along the domain's side, x first: the middles of its
   * cells or their ends, so far as they lie in the domain. Along the radius alone where
   * the scene depends on that. */
  std::vector<cases::Position> places_in(const cases::Scene &scene, int n,
                                         bool at_vertices);

  /** The same on a wall; 4 n points at equal distances of a curved one.
   * @throws cases::Refusal for a curved wall in space of a scene without symmetry */
  std::vector<cases::Position> places_on(const cases::Scene &scene, cases::Side side,
                                         int n, bool at_vertices);
} // namespace meltfront::verification::external

#endif
