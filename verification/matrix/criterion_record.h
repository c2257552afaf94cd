#ifndef meltfront_verification_matrix_criterion_record_h
#define meltfront_verification_matrix_criterion_record_h

#include <cases/case.h>

#include <nlohmann/json_fwd.hpp>

namespace meltfront::verification
{
  /** An acceptance criterion as JSON. */
  nlohmann::json json_of(const cases::Criterion &criterion);

  /** Inverse of json_of(). */
  cases::Criterion criterion_in(const nlohmann::json &json);
} // namespace meltfront::verification

#endif
