#include <cases/error.h>
#include <particles/greenspan/bar/conduction.h>
#include <particles/greenspan/motion/bonds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Steps from one look at the temperatures to the next. */
    constexpr long steps_between_profiles = 50;

    /** Share of the way from bath to bath that is left out at each end of it. */
    constexpr double margin = 0.125;

    /** Sums of a bin over looks. */
    struct Bin
    {
      double count = 0, kinetic = 0, order = 0;

      double temperature() const
      {
        return count > 0 ? kinetic / count : 0;
      }
    };

    BathZone bath(const ConductionSettings &settings, double length, double centre,
                  double temperature, std::uint64_t salt)
    {
      BathZone zone;
      zone.begin = (centre - settings.bath_share / 2) * length;
      zone.end = (centre + settings.bath_share / 2) * length;
      zone.bath.first_temperature = zone.bath.last_temperature = temperature;
      zone.bath.rate = settings.bath_rate;
      zone.bath.seed = 5 * settings.phase.seed + salt;
      return zone;
    }

    void look(const Motion &motion, std::vector<Bin> &bins)
    {
      const ParticleState state = motion.state();
      const BondGraph bonds(state, motion.parameters().force.cutoff);
      const std::vector<double> order = lattice_order(state, bonds);
      const double length = state.period[0];
      for(std::size_t i = 0; i < state.size(); ++i)
      {
        const double share = wrapped(state.position[0][i], length) / length;
        const double place = share * static_cast<double>(bins.size());
        Bin &bin = bins[std::min(bins.size() - 1, static_cast<std::size_t>(place))];
        ++bin.count;
        bin.order += order[i];
        for(int d = 0; d < 2; ++d)
          bin.kinetic += state.velocity[d][i] * state.velocity[d][i] / 2;
      }
    }

    /** Flux over gradient; both ways from the hot bath (1/4) to the cold one (3/4). */
    double fit(const ConductionResult &result, const ConductionSettings &settings,
               double length)
    {
      const double way = 0.5 - settings.bath_share;
      const double begin = settings.bath_share / 2 + margin * way;
      double n = 0, x = 0, t = 0, xx = 0, xt = 0;
      for(std::size_t b = 0; b < result.profile.size(); ++b)
      {
        const double share = std::abs(result.position[b] / length - 0.25);
        const double distance = std::min(share, 1 - share); // from the hot bath
        if(distance < begin || distance > 0.5 - begin)
          continue;
        n += 1;
        x += distance * length;
        t += result.profile[b];
        xx += distance * length * distance * length;
        xt += distance * length * result.profile[b];
      }
      return -result.flux * (n * xx - x * x) / (n * xt - x * t);
    }
  } // namespace

  ConductionResult measure_conduction(const ConductionSettings &settings)
  {
    if(!(settings.bins >= 16 && settings.bins % 4 == 0 && settings.bath_share > 0
         && settings.bath_share < 0.3 && settings.duration > 0))
      throw cases::InputError(fmt::format(
          "conduction is to be measured in {} bins, with baths over {} of the length; 16 "
          "bins or more are needed, a multiple of four, and baths over less than 0.3",
          settings.bins, settings.bath_share));
    MotionParameters parameters;
    parameters.force = settings.phase.crystal.force;
    parameters.gravity = 0;
    parameters.time_step = settings.phase.time_step;
    const ParticleState start = equilibrated_bulk(settings.phase);
    const double length = start.period[0], middle = settings.phase.temperature;
    parameters.zones
        = {bath(settings, length, 0.25, middle + settings.half_difference, 1),
           bath(settings, length, 0.75, middle - settings.half_difference, 2)};
    Motion motion(parameters, start);
    const auto steps
        = [&](double time) { return std::lround(time / parameters.time_step); };
    motion.advance(steps(settings.relaxation));
    motion.set_zones(parameters.zones);
    std::vector<Bin> bins(settings.bins);
    for(long step = 0; step < steps(settings.duration); step += steps_between_profiles)
    {
      motion.advance(steps_between_profiles);
      look(motion, bins);
    }
    ConductionResult result;
    const double given = motion.zone_heat()[0], taken = -motion.zone_heat()[1];
    // Both halves carry heat.
    result.flux = (given + taken) / 2 / (2 * start.period[1] * settings.duration);
    result.imbalance = 2 * (given - taken) / (given + taken);
    result.temperature = middle;
    result.lowest_order = 1;
    for(std::size_t b = 0; b < bins.size(); ++b)
    {
      result.position.push_back((static_cast<double>(b) + 0.5) * length
                                / static_cast<double>(bins.size()));
      result.profile.push_back(bins[b].temperature());
      result.lowest_order
          = std::min(result.lowest_order, bins[b].order / std::max(1., bins[b].count));
    }
    result.conductivity = fit(result, settings, length);
    return result;
  }
} // namespace meltfront::particles::greenspan
