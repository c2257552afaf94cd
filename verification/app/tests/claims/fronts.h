#ifndef meltfront_verification_app_tests_claims_fronts_h
#define meltfront_verification_app_tests_claims_fronts_h

#include <verification/app/tests/claims/trial.h>

#include <optional>

namespace meltfront::verification::claims
{
  /**
   * A front that moves away from x = 0 or the centre with walls of a kind at its far end
   * (periodic ones: across), held against the oracle of one coordinate.
   * @param symmetric whether the scene says that it depends on one coordinate
   * @param displaced density of the liquid over the solid's
   */
  Trial moving_front(cases::DomainShape shape, int dimension, cases::BoundaryKind kind,
                     bool symmetric, double displaced = 1);

  /** Of an effect of scenes with a front in one coordinate, on a domain of that shape. */
  std::optional<EffectTrials> front_trials(cases::Effect effect, cases::DomainShape shape,
                                           int dimension, double displaced = 1);

  /** Ice around a line that draws heat from the centre of a disk, from the start or,
   * where it has `begun`, from a front that is there. */
  Trial line_sink(double lambda, bool symmetric, bool begun);

  /** Liquid that a cold wall begins to freeze (Neumann); half of it solid, at the melting
   * point, where `partly_melted`. */
  Trial cold_wall(bool partly_melted, double displaced = 1,
                  cases::DomainShape shape = cases::DomainShape::slab);

  /** A disk of solid whose melt has become as warm as its curved front. */
  EffectTrials capillary_trials();
} // namespace meltfront::verification::claims

#endif
