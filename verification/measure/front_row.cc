#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** Mean solid fraction of the partly frozen sites at the end. */
    class FrontRow : public Measure
    {
    public:
      using Measure::Measure;

      void observe(const Sighting &sighting) override
      {
        if(!sighting.at_end || !run.scene.changes_phase())
          return;
        const cases::Snapshot &snapshot = sighting.snapshot;
        double sum = 0;
        int sites = 0;
        for(std::size_t i = 0; i < snapshot.solid_fraction.size(); ++i)
          if(const double fraction = snapshot.solid_fraction[i];
             snapshot.weights[i] > 0 && fraction > 0 && fraction < 1)
          {
            sum += fraction;
            ++sites;
          }
        if(sites > 0)
          values["front_row_solid_fraction"] = sum / sites;
      }
    };
  } // namespace

  MeasureKind front_row()
  {
    return {{hidden_quantity("front_row_solid_fraction")},
            MeasuredScenes::with_heat,
            start<FrontRow>};
  }
} // namespace meltfront::verification
