#include <verification/measure/formulas/front_shape.h>
#include <verification/measure/formulas/run_statistics.h>
#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** The signed distance of tracked front points from the exact front over time; how
     * round they are at the end, where the front is. */
    class TrackedPoints : public Measure
    {
    public:
      using Measure::Measure;

      void observe(const Sighting &sighting) override
      {
        const auto &exact = run.the_case.exact;
        const cases::Symmetry symmetry = exact ? exact->symmetry() : run.scene.symmetry;
        if(sighting.at_end && run.scene.changes_phase()
           && (symmetry == cases::Symmetry::cylindrical
               || symmetry == cases::Symmetry::spherical))
          values["roundness_end"] = roundness(sighting.snapshot);
        if(!sighting.front_counts)
          return;
        if(const auto distance = front_distance(sighting.snapshot, *exact))
        {
          errors.add(distance->root_mean_square);
          values["front_points_rms"] = errors.mean_over_time();
          keep_largest("front_points_max", distance->largest);
        }
      }

    private:
      ErrorStatistics errors;
    };
  } // namespace

  MeasureKind tracked_points()
  {
    using enum Shown;
    return {
        {error_quantity("front_points_rms", "tracked points, RMS", "m", when_asked),
         error_quantity("front_points_max", "tracked points, maximum", "m", when_asked),
         error_quantity("roundness_end", "roundness, end", "m", when_asked)},
        MeasuredScenes::with_heat,
        start<TrackedPoints>};
  }
} // namespace meltfront::verification
