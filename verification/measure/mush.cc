#include <verification/measure/formulas/mush_error.h>
#include <verification/measure/measure.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    /**
     * MushError at the end (K, mass fractions, relative), between
     * Measurement::temperature_from and temperature_to; the same with _1 to _8 at the
     * intermediate times, each in the first snapshot at or after it, against the exact
     * state of the snapshot's own time.
     */
    class Mush : public Measure
    {
    public:
      using Measure::Measure;

      static bool asked_for(const MeasuredRun &run)
      {
        return run.the_case.exact && run.the_case.exact->mushy();
      }

      void observe(const Sighting &sighting) override
      {
        const cases::Domain &domain = run.scene.domain;
        const cases::Measurement &measurement = run.the_case.measurement;
        for(const std::string &suffix : sighting.suffixes(""))
        {
          const MushError error
              = mush_error(sighting.snapshot, *sighting.coordinates, *run.the_case.exact,
                           measurement.temperature_from, measurement.temperature_to,
                           domain.round() ? domain.inner_radius : domain.lower[0],
                           domain.round() ? domain.radius : domain.upper[0]);
          values["temperature_rms" + suffix] = error.temperature_rms;
          values["solid_fraction_rms" + suffix] = error.solid_fraction_rms;
          values["concentration_rms" + suffix] = error.concentration_rms;
          values["ice_error" + suffix] = error.ice_error;
        }
      }
    };
  } // namespace

  MeasureKind mush()
  {
    using enum Shown;
    std::vector<Quantity> list{
        error_quantity("temperature_rms", "temperature, RMS", "K", when_asked),
        error_quantity("temperature_rms_1", "temperature, RMS, time 1", "K", when_asked),
        error_quantity("solid_fraction_rms", "solid fraction, RMS", ""),
        error_quantity("solid_fraction_rms_1", "solid fraction, RMS, time 1", "",
                       when_asked),
        error_quantity("concentration_rms", "concentration, RMS", ""),
        error_quantity("ice_error", "solid, end", "relative"),
        error_quantity("ice_error_1", "solid, time 1", "relative", when_asked),
        hidden_quantity("concentration_rms_1")};
    for(int intermediate = 2; intermediate <= cases::most_intermediate_times;
        ++intermediate)
      for(const char *name :
          {"temperature_rms", "solid_fraction_rms", "concentration_rms", "ice_error"})
        list.push_back(hidden_quantity(fmt::format("{}_{}", name, intermediate)));
    return {list, MeasuredScenes::with_heat, start<Mush>};
  }
} // namespace meltfront::verification
