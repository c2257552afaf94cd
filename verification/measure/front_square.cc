#include <verification/measure/formulas/square_law.h>
#include <verification/measure/measure.h>

namespace meltfront::verification
{
  namespace
  {
    /** The straight line through the squares of the front's positions over time, from
     * Measurement::front_square_from on, and how much of the variance it explains. */
    class FrontSquare : public Measure
    {
    public:
      using Measure::Measure;

      static bool asked_for(const MeasuredRun &run)
      {
        return run.the_case.measurement.front_square_from.has_value();
      }

      void observe(const Sighting &sighting) override
      {
        if(!sighting.in_series)
          return;
        time.push_back(sighting.snapshot.time);
        front.push_back(sighting.front.latent_heat);
      }

      Results results() const override
      {
        const SquareLaw law
            = square_law(time, front, *run.the_case.measurement.front_square_from);
        return {{"front_square_slope", law.slope}, {"front_square_r2", law.r_squared}};
      }

    private:
      std::vector<double> time, front;
    };
  } // namespace

  MeasureKind front_square()
  {
    Quantity r2 = value_quantity("front_square_r2", "its R²", "");
    r2.digits = 5;
    return {
        {value_quantity("front_square_slope", "slope of the front squared", "m²/s"), r2},
        MeasuredScenes::with_heat,
        start<FrontSquare>};
  }
} // namespace meltfront::verification
