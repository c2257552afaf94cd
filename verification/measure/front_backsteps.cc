#include <verification/measure/formulas/run_statistics.h>
#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** The farthest that the front fell back behind where it had been on its way, the
     * exact front's, or without one its own net way (m). */
    class FrontBacksteps : public Measure
    {
    public:
      using Measure::Measure;

      void observe(const Sighting &sighting) override
      {
        if(run.scene.changes_phase())
          course.add(sighting.front.latent_heat);
      }

      Results results() const override
      {
        const auto &exact = run.the_case.exact;
        const double advance = exact ? exact->front(run.scene.end_time)
                                           - exact->front(run.scene.start_time)
                                     : course.net_advance();
        return {{"front_backsteps", course.largest_backstep(advance < 0)}};
      }

    private:
      FrontCourse course;
    };
  } // namespace

  MeasureKind front_backsteps()
  {
    return {{hidden_quantity("front_backsteps")},
            MeasuredScenes::with_heat,
            start<FrontBacksteps>};
  }
} // namespace meltfront::verification
