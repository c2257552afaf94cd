#include <verification/measure/formulas/entropy.h>
#include <verification/measure/measure.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Follows an entropy from snapshot to snapshot. */
    class EntropyCourse
    {
    public:
      void add(double value)
      {
        if(samples++ == 0)
          first = value;
        else
        {
          largest_fall = std::max(largest_fall, last - value);
          largest_gain = std::max(largest_gain, value - first);
        }
        last = value;
        if(std::isnan(value))
          largest_gain = largest_fall = std::nan("");
      }

      /** The largest fall over the largest gain; NaN for fewer than two samples. */
      double fall() const
      {
        return samples > 1 && largest_gain > 0 ? largest_fall / largest_gain
                                               : std::nan("");
      }

    private:
      long samples = 0;
      double first = 0, last = 0, largest_fall = 0, largest_gain = 0;
    };

    /** The largest fall of Entropy::total and of Entropy::mixing from one snapshot to the
     * next, over the largest gain since the start: above round-off the second law is
     * broken. */
    class EntropyFall : public Measure
    {
    public:
      explicit EntropyFall(const MeasuredRun &run)
        : Measure(run)
        , meter(run.scene, *run.the_case.measurement.absolute_zero)
      {
      }

      static bool asked_for(const MeasuredRun &run)
      {
        return run.the_case.measurement.absolute_zero.has_value();
      }

      void observe(const Sighting &sighting) override
      {
        const Entropy entropy = meter.of(sighting.snapshot);
        total.add(entropy.total);
        mixing.add(entropy.mixing);
        values["entropy_fall"] = total.fall();
        values["mixing_entropy_fall"] = mixing.fall();
      }

    private:
      EntropyMeter meter;
      EntropyCourse total, mixing;
    };
  } // namespace

  MeasureKind entropy_fall()
  {
    return {{value_quantity("entropy_fall", "fall of entropy", "relative"),
             value_quantity("mixing_entropy_fall", "fall of mixing entropy", "relative",
                            Shown::when_asked)},
            MeasuredScenes::with_heat,
            start<EntropyFall>};
  }
} // namespace meltfront::verification
