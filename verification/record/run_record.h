#ifndef meltfront_verification_record_run_record_h
#define meltfront_verification_record_run_record_h

#include <cases/method.h>
#include <cases/numbers.h>
#include <verification/measure/checks/check.h>
#include <verification/record/run_times.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** How a run ended. */
  enum class RunStatus
  {
    finished,
    refused, ///< the method declined it, with a reason
    failed   ///< it broke a bound, did not converge, crashed or ran out of time
  };

  /** Values over time, one entry per snapshot. */
  struct RunSeries
  {
    std::vector<double> time;
    std::vector<double> front;          ///< by latent heat (m)
    std::vector<double> front_isotherm; ///< by T = T_m (m); NaN where there is none
    std::vector<double> front_exact;    ///< empty without an exact solution
    std::vector<double> solid_volume;   ///< in the measure of the scene (m, m^2, m^3)
    std::vector<double> heat;           ///< taken in since the start (J/m^2, J/m, J)
    std::vector<double> budget_defect;  ///< relative
    std::vector<double> temperature_min;
    std::vector<double> temperature_max;
  };

  /** The state at the end, thinned out for plots. */
  struct RunProfile
  {
    double time = 0;
    std::vector<double> coordinate; ///< x or r (m), ascending
    std::vector<double> temperature;
    std::vector<double> solid_fraction;
    std::vector<double> temperature_exact; ///< empty without an exact solution
    /** Mass fraction of the first solute in the liquid; NaN where there is no liquid,
     * empty without solute. The exact ones where the exact solution is a mush. */
    std::vector<double> concentration, concentration_exact, solid_fraction_exact;
    /** Sites in the plane for a picture (2D sites, or the slice nearest z = 0), at most
     * 6000. */
    std::vector<double> picture_x, picture_y, picture_solid_fraction, picture_temperature;
  };

  /** The temperature at a place at the end. */
  struct TemperatureProbe
  {
    std::string coordinate{}; ///< `x` or `r`, the one that the scene depends on, or empty
    std::vector<double> place; ///< that coordinate, or all of a point (m)
    double temperature = 0;
    double temperature_exact = cases::nan; ///< NaN without an exact solution
  };

  /** Points that a method tracked on the front at a time (m), in the plane z = 0 or the
   * layer nearest to it. */
  struct FrontFrame
  {
    double time = 0;
    std::vector<double> x, y;
  };

  /** Particles of a solid in the plane at a time. */
  struct ParticleFrame
  {
    double time = 0;
    long step = 0;
    std::vector<double> x, y, velocity_x, velocity_y;
    std::vector<double> solid; ///< 1 or 0
  };

  /** Something that happened in a run between its snapshots. */
  struct RunEvent
  {
    double time = 0; ///< s
    std::string what;
  };

  /** Everything needed to repeat a run, and everything that is reported of it. */
  struct RunRecord
  {
    std::string case_name;
    std::string method;
    /** The label of tables: the method, with option values a matrix varies:
     * `sph[step_factor=1.1]`. */
    std::string label;
    int n = 0;
    std::uint64_t seed = 1;
    int threads = 1;
    std::map<std::string, std::string> options; ///< all values in use, defaults included

    RunStatus status = RunStatus::failed;
    std::string message; ///< reason of a refusal or failure, one sentence

    cases::RunDescription description;
    std::vector<cases::EffectDecision> effects;
    cases::Cost cost;
    double peak_memory_mb = 0;
    int repeats = 1; ///< times are the minimum of so many runs
    RunTimes times;

    /**
     * Scalar results by name: front_rms, front_end, front_isotherm_rms, temperature_l2,
     * ... as the columns of the convergence table; NaN where a quantity is not defined
     * for the run.
     */
    std::map<std::string, double> quantities;

    /** NaN for one that the run does not have. */
    double quantity(const std::string &name) const
    {
      const auto found = quantities.find(name);
      return found == quantities.end() ? cases::nan : found->second;
    }

    RunSeries series;
    RunProfile profile;
    std::vector<TemperatureProbe> probes;   ///< at places that are the same for all runs
    double solid_volume_exact = cases::nan; ///< at the end; NaN where it is unknown
    double heat_exact = cases::nan; ///< taken in from start to end; NaN where unknown
    std::vector<RunProfile>
        intermediate_profiles;      ///< at Measurement::intermediate_times or some
    std::vector<FrontFrame> frames; ///< at Measurement::intermediate_times and at the end
    std::vector<ParticleFrame>
        particle_frames; ///< at the start, the intermediate times and the end
    std::vector<ParticleFrame> animation; ///< of the first seed: throughout the run
    std::vector<RunEvent> events;
    std::vector<Check> checks;
    /** Checks that could not be made, with the reason. */
    std::map<std::string, std::string> unchecked;

    /** case_text, case_hash, program_version, compiler, flags, cpu, packages, date,
     * command_line. */
    std::map<std::string, std::string> provenance;
  };

  void to_json(nlohmann::json &json, const RunRecord &record);
  void from_json(const nlohmann::json &json, RunRecord &record);

  const char *to_string(RunStatus status);
} // namespace meltfront::verification

#endif
