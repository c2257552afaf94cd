#include <verification/measure/formulas/front_shape.h>
#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** The amplitude of Measurement::front_mode in the front at the end (m). */
    class FrontMode : public Measure
    {
    public:
      using Measure::Measure;

      static bool asked_for(const MeasuredRun &run)
      {
        return run.the_case.measurement.front_mode > 0;
      }

      void observe(const Sighting &sighting) override
      {
        if(sighting.at_end)
          values["front_mode_end"] = front_mode_amplitude(
              sighting.snapshot, run.scene.domain,
              solid_holds_origin(run.scene, run.the_case.exact.get()),
              run.the_case.measurement.front_mode);
      }
    };
  } // namespace

  MeasureKind front_mode()
  {
    std::vector<Quantity> list
        = with_differences(value_quantity("front_mode_end", "amplitude, end", "m"));
    list[0].digits = 8;
    list[1] = error_quantity("front_mode_end_error", "amplitude's error, end", "m");
    list[1].from_reference = true;
    return {list, MeasuredScenes::with_heat, start<FrontMode>};
  }
} // namespace meltfront::verification
