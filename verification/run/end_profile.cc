#include <verification/measure/formulas/mush_error.h>
#include <verification/measure/formulas/temperature_error.h>
#include <verification/run/end_profile.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::size_t most_sites = 600;
    constexpr std::size_t most_picture_sites = 6000;

    /** All sites, or those of the layer whose z is nearest zero. */
    std::vector<std::size_t> picture_layer(const cases::Snapshot &snapshot,
                                           double spacing)
    {
      std::vector<std::size_t> sites(snapshot.temperature.size());
      std::iota(sites.begin(), sites.end(), 0);
      if(snapshot.dimension < 3 || sites.empty())
        return sites;
      const auto z = snapshot.positions[2];
      const double layer = *std::ranges::min_element(
          z, {}, [](double height) { return std::abs(height); });
      std::erase_if(sites, [&](std::size_t i)
                    { return std::abs(z[i] - layer) > 0.25 * spacing; });
      return sites;
    }

    /** At most one site for each square of a grid. */
    std::vector<std::size_t> one_for_each_square(const cases::Snapshot &snapshot,
                                                 const std::vector<std::size_t> &sites,
                                                 double width)
    {
      std::set<std::pair<long, long>> taken;
      std::vector<std::size_t> kept;
      for(const std::size_t i : sites)
        if(taken
               .emplace(std::lround(snapshot.positions[0][i] / width),
                        std::lround(snapshot.positions[1][i] / width))
               .second)
          kept.push_back(i);
      return kept;
    }

    std::vector<std::size_t> spread_evenly(const cases::Snapshot &snapshot,
                                           const std::vector<std::size_t> &sites)
    {
      const auto [left, right] = std::ranges::minmax(snapshot.positions[0]);
      const auto [bottom, top] = std::ranges::minmax(snapshot.positions[1]);
      double width
          = std::max(std::sqrt((right - left) * (top - bottom) / most_picture_sites),
                     (right - left) / most_picture_sites);
      std::vector<std::size_t> kept = sites;
      for(; kept.size() > most_picture_sites; width *= 1.05)
        kept = one_for_each_square(snapshot, sites, width);
      return kept;
    }

    void add_picture(const cases::Snapshot &snapshot, double spacing, RunProfile &profile)
    {
      for(const std::size_t i : spread_evenly(snapshot, picture_layer(snapshot, spacing)))
      {
        profile.picture_x.push_back(snapshot.positions[0][i]);
        profile.picture_y.push_back(snapshot.positions[1][i]);
        profile.picture_solid_fraction.push_back(snapshot.solid_fraction[i]);
        profile.picture_temperature.push_back(snapshot.temperature[i]);
      }
    }
    void add_exact_mush(const cases::ExactSolution &exact, double coordinate, double time,
                        RunProfile &profile)
    {
      const double solid = exact.solid_fraction(coordinate, time);
      profile.solid_fraction_exact.push_back(solid);
      profile.concentration_exact.push_back(
          liquid_concentration(exact.concentration(coordinate, time), solid));
    }
  } // namespace

  RunProfile make_end_profile(const cases::Snapshot &snapshot,
                              const std::vector<double> &coordinates,
                              const cases::ExactSolution *exact, double spacing)
  {
    RunProfile profile;
    profile.time = snapshot.time;
    std::vector<std::size_t> order(coordinates.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return coordinates[i]; });
    const std::size_t kept = std::min(order.size(), most_sites);
    for(std::size_t k = 0; k < kept; ++k)
    {
      // First and last site included.
      const std::size_t i = order[kept > 1 ? k * (order.size() - 1) / (kept - 1) : 0];
      profile.coordinate.push_back(coordinates[i]);
      profile.temperature.push_back(snapshot.temperature[i]);
      profile.solid_fraction.push_back(snapshot.solid_fraction[i]);
      if(!snapshot.concentration[0].empty())
        profile.concentration.push_back(liquid_concentration(snapshot.concentration[0][i],
                                                             snapshot.solid_fraction[i]));
      if(!exact)
        continue;
      const double expected = exact_temperature(*exact, snapshot, coordinates[i], i);
      profile.temperature_exact.push_back(
          std::isfinite(expected) ? expected : std::numeric_limits<double>::quiet_NaN());
      if(exact->mushy())
        add_exact_mush(*exact, coordinates[i], snapshot.time, profile);
    }
    if(snapshot.dimension > 1)
      add_picture(snapshot, spacing, profile);
    return profile;
  }
} // namespace meltfront::verification
