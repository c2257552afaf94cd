#include <cases/error.h>
#include <particles/greenspan/calibration/coexistence.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Half of the bar is melted at so many times the guess, while the other is kept
     * below it. */
    constexpr double hot_half = 1.4, keeping_cool = 0.95;

    /** Time between looks. */
    constexpr double interval = 0.5;

    /** Least share of each phase that is a phase. */
    constexpr double least_share = 0.12;

    std::vector<BathZone> halves(const CoexistenceSettings &settings, double middle,
                                 double left, double right)
    {
      std::vector<BathZone> zones;
      for(const bool first : {true, false})
      {
        BathZone zone;
        zone.begin = first ? 0 : middle;
        zone.end = first ? middle : 1e6;
        zone.bath.first_temperature = zone.bath.last_temperature = first ? left : right;
        zone.bath.rate = 4;
        zone.bath.seed = 7 * settings.bar.seed + (first ? 1 : 2);
        zones.push_back(zone);
      }
      return zones;
    }
  } // namespace

  Coexistence measure_coexistence(const CoexistenceSettings &settings)
  {
    if(!(settings.guess > 0 && settings.duration > 0))
      throw cases::InputError(
          fmt::format("coexistence is looked for near the temperature {} during {}; both "
                      "must be positive",
                      settings.guess, settings.duration));
    BarSettings cool = settings.bar;
    cool.cold_temperature = keeping_cool * settings.guess;
    Bar bar(cool);
    const double middle = bar.look().length / 2;
    double time = settings.melting;
    bar.set_zones(halves(settings, middle, hot_half * settings.guess,
                         keeping_cool * settings.guess));
    bar.advance_to(time);
    time += settings.melting / 2;
    bar.set_zones(halves(settings, middle, settings.guess, settings.guess));
    bar.advance_to(time);
    bar.set_zones({});
    const double energy = bar.particles().energy().total();
    time += settings.relaxation;
    bar.advance_to(time);

    Coexistence result;
    const double n = static_cast<double>(bar.particles().size());
    const double all = n / bar.width();
    const int looks = std::max(1, static_cast<int>(settings.duration / interval));
    result.least_front = 1;
    for(int k = 1; k <= looks; ++k)
    {
      bar.advance_to(time + k * settings.duration / looks);
      const double share = bar.look().front / all;
      result.temperature += bar.particles().temperature() / looks;
      result.front += share / looks;
      result.least_front = std::min(result.least_front, share);
      result.largest_front = std::max(result.largest_front, share);
    }
    result.heating = (bar.particles().energy().total() - energy) / n;
    if(!(result.front > least_share && result.front < 1 - least_share))
      throw cases::NumericalError(
          "greenspan", bar.particles().step(), time, "the molten share of a bar",
          fmt::format("is {:.2f} where both phases should last; a guess of the melting "
                      "temperature nearer to it than {} is needed, or a longer bar",
                      result.front, settings.guess));
    return result;
  }
} // namespace meltfront::particles::greenspan
