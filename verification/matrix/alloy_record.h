#ifndef meltfront_verification_matrix_alloy_record_h
#define meltfront_verification_matrix_alloy_record_h

#include <cases/scene.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What the report says of a solute. */
  struct SoluteRecord
  {
    std::string name;
    std::string liquidus;      ///< as the case file gives it
    double liquidus_slope = 0; ///< K; NaN where the liquidus is curved
    double diffusivity = 0;    ///< m^2/s
    std::string concentration; ///< at the start, as the case file gives it
  };

  /** What the report says of an alloy. */
  struct AlloyRecord
  {
    std::vector<SoluteRecord> solutes;
    double eutectic_temperature = 0; ///< NaN: none
    double crystal_density = 0;      ///< kg/m^3
  };

  /** @param scene of an alloy */
  AlloyRecord make_alloy_record(const cases::Scene &scene);

  void to_json(nlohmann::json &json, const AlloyRecord &record);
  void from_json(const nlohmann::json &json, AlloyRecord &record);
} // namespace meltfront::verification

#endif
