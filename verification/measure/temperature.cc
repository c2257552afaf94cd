#include <verification/measure/formulas/temperature_error.h>
#include <verification/measure/measure.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** TemperatureError at the end; the farthest beyond the bounds of the maximum
     * principle in any snapshot, over their span, where they are both finite. */
    class Temperature : public Measure
    {
    public:
      using Measure::Measure;

      void observe(const Sighting &sighting) override
      {
        const cases::TemperatureBounds &bounds = sighting.bounds;
        const double span = bounds.upper - bounds.lower;
        const double beyond = std::max(
            {bounds.lower - sighting.lowest, sighting.highest - bounds.upper, 0.});
        if(std::isfinite(span))
          keep_largest("temperature_overshoot", beyond > 0 ? beyond / span : 0);
        if(!sighting.at_end || !run.the_case.exact)
          return;
        const cases::Measurement &measurement = run.the_case.measurement;
        const TemperatureError error = temperature_error(
            sighting.snapshot, *sighting.coordinates, *run.the_case.exact,
            run.scene.material.melting_temperature, measurement.temperature_from,
            measurement.temperature_to);
        values["temperature_l2"] = error.l2;
        values["temperature_max"] = error.maximum;
        values["temperature_rmse"] = error.rmse;
        values["temperature_sites_l2"] = error.sites_l2;
      }
    };
  } // namespace

  MeasureKind temperature()
  {
    using enum Shown;
    return {
        {error_quantity("temperature_l2", "temperature, L2", "relative", always, 0),
         error_quantity("temperature_max", "temperature, maximum", "relative", always, 0),
         error_quantity("temperature_rmse", "temperature, RMS over the largest",
                        "relative", when_asked),
         error_quantity("temperature_sites_l2", "temperature, L2 over sites", "relative",
                        when_asked),
         hidden_quantity("temperature_overshoot")},
        MeasuredScenes::with_heat,
        start<Temperature>};
  }
} // namespace meltfront::verification
