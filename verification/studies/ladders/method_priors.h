#ifndef meltfront_verification_studies_ladders_method_priors_h
#define meltfront_verification_studies_ladders_method_priors_h

#include <string>

namespace meltfront::verification
{
  /** What other cases say of a method before it has run on this one. */
  struct MethodPrior
  {
    double order;        ///< p of the front's error over time, C n^-p
    double lowest_order; ///< where the case itself may tell a lower one, else equal
    double growth;       ///< q of the time, C n^q
  };

  /**
   * Medians over nine matrices (2487 runs, 35 cases with an exact front): orders from
   * root mean squares over time, growth of the processor time between the two finest
   * levels. Where nothing was measured: second order in space, one more power in time for
   * each dimension.
   * @param dimension of the run
   */
  MethodPrior method_prior(const std::string &method, int dimension);
} // namespace meltfront::verification

#endif
