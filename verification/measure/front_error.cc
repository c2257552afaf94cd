#include <verification/measure/formulas/front_displacement.h>
#include <verification/measure/formulas/run_statistics.h>
#include <verification/measure/measure.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** The front found less the exact one (m): by latent heat but where another reading
     * is named. Of an exact front that no one coordinate gives, its mean displacement and
     * the volume that is in the wrong phase, over the front's area. */
    class FrontError : public Measure
    {
    public:
      using Measure::Measure;

      void observe(const Sighting &sighting) override
      {
        const auto &solution = run.the_case.exact;
        if(solution && solution->has_front() && !solution->depends_on_one_coordinate())
          return displace(sighting, *solution);
        const FrontReading &found = sighting.front;
        const double exact = sighting.exact_front, time = sighting.snapshot.time;
        if(sighting.at_end)
        {
          values["front_end_position"] = found.latent_heat;
          values["front_end"] = std::abs(found.latent_heat - exact);
        }
        if(!sighting.front_counts)
          return;
        front.add(found.latent_heat - exact);
        if(time >= (run.scene.start_time + run.scene.end_time) / 2)
          late_front.add(found.latent_heat - exact);
        isotherm.add(found.isotherm - exact);
        if(std::isnan(found.max_ice))
          return; // no site is frozen throughout
        max_ice.add(found.max_ice - exact);
        heat_loss.add(found.heat_loss - exact);
      }

      Results results() const override
      {
        Results all = values;
        all["front_rms"] = front.mean_over_time();
        all["front_max"] = front.largest();
        all["front_isotherm_rms"] = isotherm.root_mean_square();
        all["front_max_ice_rms"] = max_ice.root_mean_square();
        all["front_heat_loss_rms"] = heat_loss.root_mean_square();
        all["front_mismatch_rms"] = mismatch.mean_over_time();
        if(run.the_case.measurement.front_floor > 0)
          all["front_floor"] = run.the_case.measurement.front_floor;
        if(!run.the_case.exact)
          return all;
        const double scale = std::abs(run.the_case.exact->front(run.scene.end_time));
        all["front_rms_relative"] = all["front_rms"] / scale;
        all["front_late_max_relative"] = late_front.largest() / scale;
        if(values.contains("front_end"))
          all["front_end_relative"] = all["front_end"] / scale;
        return all;
      }

    private:
      void displace(const Sighting &sighting, const cases::ExactSolution &solution)
      {
        if(!sighting.front_counts && !sighting.at_end)
          return;
        const FrontDisplacement found = front_displacement(sighting.snapshot, solution);
        if(sighting.at_end)
          values["front_end"] = std::abs(found.mean);
        if(!sighting.front_counts)
          return;
        front.add(found.mean);
        mismatch.add(found.mismatch);
      }

      ErrorStatistics mismatch, front, late_front, isotherm, max_ice, heat_loss;
    };
  } // namespace

  MeasureKind front_error()
  {
    using enum Shown;
    return {
        {error_quantity("front_rms", "front, RMS", "m", always, 0),
         error_quantity("front_end", "front, end", "m", always, 0),
         error_quantity("front_isotherm_rms", "front by isotherm, RMS", "m", always, 0),
         error_quantity("front_max_ice_rms", "largest frozen radius, RMS", "m",
                        when_asked, 1),
         error_quantity("front_heat_loss_rms", "largest radius a quarter frozen, RMS",
                        "m", when_asked, 1),
         error_quantity("front_late_max_relative", "front, late maximum", "relative",
                        when_asked, 1),
         error_quantity("front_end_relative", "front, end", "relative", when_asked, 1),
         error_quantity("front_max", "front, maximum", "m", when_asked),
         error_quantity("front_mismatch_rms", "in the wrong phase, RMS", "m", when_asked),
         hidden_quantity("front_rms_relative"), hidden_quantity("front_end_position"),
         hidden_quantity("front_floor")},
        MeasuredScenes::with_heat,
        start<FrontError>};
  }
} // namespace meltfront::verification
