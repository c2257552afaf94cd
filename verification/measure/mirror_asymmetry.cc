#include <verification/measure/formulas/mirror_symmetry.h>
#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** How far the temperature is from its mirror image, in any snapshot (K). */
    class MirrorAsymmetry : public Measure
    {
    public:
      explicit MirrorAsymmetry(const MeasuredRun &run)
        : Measure(run)
        , mirror(*run.the_case.measurement.mirror, run.spacing)
      {
      }

      static bool asked_for(const MeasuredRun &run)
      {
        return run.the_case.measurement.mirror.has_value();
      }

      void observe(const Sighting &sighting) override
      {
        keep_largest("mirror_asymmetry", mirror.largest_difference(sighting.snapshot));
      }

    private:
      MirrorSymmetry mirror;
    };
  } // namespace

  MeasureKind mirror_asymmetry()
  {
    return {{value_quantity("mirror_asymmetry", "mirror asymmetry", "K")},
            MeasuredScenes::with_heat,
            start<MirrorAsymmetry>};
  }
} // namespace meltfront::verification
