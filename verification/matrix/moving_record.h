#ifndef meltfront_verification_matrix_moving_record_h
#define meltfront_verification_matrix_moving_record_h

#include <cases/case.h>
#include <verification/matrix/run_record.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What the report says of a scene in which things move and no heat is conducted. */
  struct MovingRecord
  {
    std::string problem; ///< `particle solid` or `interface advection`
    std::optional<cases::ParticleSolid> solid;

    std::string region;       ///< what is carried along, in words with its numbers
    std::string velocity;     ///< by what
    double region_volume = 0; ///< m^2, m^3; infinite of a half-space
    /** Where the region's edge is at Measurement::marks and at the end, in the plane:
     * pieces of it as pairs of points. Empty in space. */
    std::vector<FrontFrame> exact_fronts;
  };

  /** @param c of a scene that conducts no heat */
  MovingRecord make_moving_record(const cases::Case &c);

  void to_json(nlohmann::json &json, const MovingRecord &record);
  void from_json(const nlohmann::json &json, MovingRecord &record);
} // namespace meltfront::verification

#endif
