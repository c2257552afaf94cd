#include <verification/measure/formulas/site_coordinates.h>
#include <verification/measure/formulas/temperature_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    double relative(double error, double reference)
    {
      return reference > 0 ? error / reference : std::numeric_limits<double>::quiet_NaN();
    }
  } // namespace

  double exact_temperature(const cases::ExactSolution &exact,
                           const cases::Snapshot &snapshot, double coordinate,
                           std::size_t site)
  {
    return exact.depends_on_one_coordinate()
               ? exact.temperature(coordinate, snapshot.time)
               : exact.temperature(site_position(snapshot, site), snapshot.time);
  }

  TemperatureError temperature_error(const cases::Snapshot &snapshot,
                                     std::span<const double> coordinates,
                                     const cases::ExactSolution &exact,
                                     double melting_temperature, double from, double to)
  {
    double weighted = 0, weighted_exact = 0, plain = 0, plain_exact = 0;
    double largest = 0, largest_excess = 0, largest_exact = 0;
    long sites = 0;
    for(std::size_t i = 0; i < coordinates.size(); ++i)
    {
      const double weight = snapshot.weights[i];
      if(weight == 0 || coordinates[i] < from || coordinates[i] > to)
        continue;
      const double expected = exact_temperature(exact, snapshot, coordinates[i], i);
      if(!std::isfinite(expected))
        continue;
      const double error = snapshot.temperature[i] - expected;
      const double excess = expected - melting_temperature;
      weighted += weight * error * error;
      weighted_exact += weight * excess * excess;
      plain += error * error;
      plain_exact += excess * excess;
      largest = std::max(largest, std::abs(error));
      largest_excess = std::max(largest_excess, std::abs(excess));
      largest_exact = std::max(largest_exact, std::abs(expected));
      ++sites;
    }
    // A maximum passes over NaN where a sum does not.
    if(std::isnan(plain))
      largest = plain;
    return {relative(std::sqrt(weighted), std::sqrt(weighted_exact)),
            relative(largest, largest_excess),
            relative(std::sqrt(plain / static_cast<double>(sites)), largest_exact),
            relative(std::sqrt(plain), std::sqrt(plain_exact))};
  }
} // namespace meltfront::verification
