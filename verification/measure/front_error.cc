#include <cases/exact/manufactured/manufactured_solution.h>
#include <verification/measure/formulas/front_displacement.h>
#include <verification/measure/formulas/run_statistics.h>
#include <verification/measure/measure.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Where a moment is to the known ones at which bodies merge or part. */
    enum class MergeStage
    {
      before,
      near, ///< within a twentieth of the front's period of one of them
      after
    };

    MergeStage merge_stage(const cases::FrontFamily &family, const cases::Scene &scene,
                           double time)
    {
      const double window = 0.05 * family.period();
      MergeStage stage = MergeStage::before;
      for(const double merge : family.merge_times(scene.start_time, scene.end_time))
        if(std::abs(time - merge) < window)
          return MergeStage::near;
        else if(time > merge)
          stage = MergeStage::after;
      return stage;
    }

    /** The front found less the exact one (m): by latent heat but where another reading
     * is named. Of an exact front that no one coordinate gives, its mean displacement and
     * the volume that is in the wrong phase, over the front's area; where it is known
     * when bodies merge or part, these near such a moment and after it by themselves. */
    class FrontError : public Measure
    {
    public:
      explicit FrontError(const MeasuredRun &run)
        : Measure(run)
        , manufactured(
              dynamic_cast<const cases::ManufacturedSolution *>(run.the_case.exact.get()))
      {
      }

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
        if(manufactured && manufactured->family().merges())
        {
          all["front_merge_rms"] = near_merge.front.root_mean_square();
          all["front_merge_mismatch_rms"] = near_merge.mismatch.root_mean_square();
          all["front_merged_rms"] = after_merge.front.root_mean_square();
          all["front_merged_mismatch_rms"] = after_merge.mismatch.root_mean_square();
        }
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
        if(!manufactured || !manufactured->family().merges())
          return;
        const MergeStage stage
            = merge_stage(manufactured->family(), run.scene, sighting.snapshot.time);
        if(stage == MergeStage::before)
          return;
        Stage &of = stage == MergeStage::near ? near_merge : after_merge;
        of.front.add(found.mean);
        of.mismatch.add(found.mismatch);
      }

      struct Stage
      {
        ErrorStatistics front, mismatch;
      };

      const cases::ManufacturedSolution *manufactured;
      Stage near_merge, after_merge;

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
         error_quantity("front_merge_rms", "front near a merge, RMS", "m", when_asked),
         error_quantity("front_merge_mismatch_rms",
                        "in the wrong phase near a merge, RMS", "m", when_asked),
         error_quantity("front_merged_rms", "front after a merge, RMS", "m", when_asked),
         error_quantity("front_merged_mismatch_rms",
                        "in the wrong phase after a merge, RMS", "m", when_asked),
         hidden_quantity("front_rms_relative"), hidden_quantity("front_end_position"),
         hidden_quantity("front_floor")},
        MeasuredScenes::with_heat,
        start<FrontError>};
  }
} // namespace meltfront::verification
