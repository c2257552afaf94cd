#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** The largest relative defect of any snapshot: of heat; of mass, where a method
     * counts it; of an alloy, of the solute that has the larger one. */
    class Budgets : public Measure
    {
    public:
      using Measure::Measure;

      void observe(const Sighting &sighting) override
      {
        keep_largest("budget_defect", sighting.snapshot.heat.defect());
        if(run.scene.alloy || sighting.snapshot.mass.initial > 0)
          keep_largest("mass_defect", sighting.snapshot.mass.defect());
        if(!run.scene.alloy)
          return;
        for(std::size_t s = 0; s < run.scene.alloy->solutes.size(); ++s)
          keep_largest("solute_defect", sighting.snapshot.solute[s].defect());
      }
    };
  } // namespace

  MeasureKind budgets()
  {
    return {{value_quantity("budget_defect", "heat budget defect", "relative",
                            Shown::always, 0),
             value_quantity("mass_defect", "mass defect", "relative"),
             value_quantity("solute_defect", "solute defect", "relative")},
            MeasuredScenes::with_heat,
            start<Budgets>};
  }
} // namespace meltfront::verification
