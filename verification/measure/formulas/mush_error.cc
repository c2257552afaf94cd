#include <cases/numbers.h>
#include <verification/measure/formulas/mush_error.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    /** A weighted root mean square, NaN of nothing. */
    struct WeightedSquares
    {
      void add(double weight, double error)
      {
        weights += weight;
        squares += weight * error * error;
      }

      double root_mean_square() const
      {
        return weights > 0 ? std::sqrt(squares / weights) : nan;
      }

      double weights = 0, squares = 0;
    };
  } // namespace

  double liquid_concentration(double concentration, double solid_fraction)
  {
    return solid_fraction < 1 ? concentration / (1 - solid_fraction) : nan;
  }

  MushError mush_error(const cases::Snapshot &snapshot,
                       std::span<const double> coordinates,
                       const cases::ExactSolution &exact, double from, double to,
                       double lower, double upper)
  {
    WeightedSquares temperature, solid_fraction, concentration;
    double solid = 0;
    for(std::size_t i = 0; i < coordinates.size(); ++i)
    {
      const double weight = snapshot.weights[i];
      solid += weight * snapshot.solid_fraction[i];
      if(weight == 0 || coordinates[i] < from || coordinates[i] > to)
        continue;
      const double solid_here = snapshot.solid_fraction[i];
      const double expected = exact.solid_fraction(coordinates[i], snapshot.time);
      temperature.add(weight, snapshot.temperature[i]
                                  - exact.temperature(coordinates[i], snapshot.time));
      solid_fraction.add(weight, solid_here - expected);
      if(snapshot.concentration[0].empty() || !(expected < 1 && solid_here < 1))
        continue;
      concentration.add(
          weight, liquid_concentration(snapshot.concentration[0][i], solid_here)
                      - liquid_concentration(
                          exact.concentration(coordinates[i], snapshot.time), expected));
    }
    const double exact_solid = exact.solid_volume(lower, upper, snapshot.time);
    return {temperature.root_mean_square(), solid_fraction.root_mean_square(),
            concentration.root_mean_square(),
            exact_solid > 0 ? std::abs(solid - exact_solid) / exact_solid : nan};
  }
} // namespace meltfront::verification
