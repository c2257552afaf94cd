#ifndef meltfront_verification_measure_formulas_exact_front_h
#define meltfront_verification_measure_formulas_exact_front_h

#include <cases/scene.h>

#include <vector>

namespace meltfront::verification
{
  /** A straight piece of a front in the plane. */
  struct FrontPiece
  {
    cases::Position begin{}, end{}; ///< m
  };

  /**
   * The edge of a region that a velocity carries along, at a time: the zero line of its
   * distance at the start, found by marching squares of 1/400 of the domain's side (a
   * corner is cut off by as much), whose points are followed along their paths; a piece
   * that is drawn out is halved before it is followed until its ends stay together.
   *
   * @param scene of ProblemKind::interface_advection in the plane
   * @param longest length of a piece at that time (m)
   * @return pieces in no order; none where the region fills the domain or none of it
   */
  std::vector<FrontPiece> exact_front_pieces(const cases::Scene &scene, double time,
                                             double longest);
} // namespace meltfront::verification

#endif
