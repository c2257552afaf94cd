#include <cases/error.h>
#include <particles/greenspan/bar/similarity.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    constexpr int intervals = 2000; ///< of each phase's grid
    constexpr int most_iterations = 200;
    constexpr double tolerance = 1e-13; ///< of temperatures, relative to their range

    /** The solid ends where exp(-reach^2) of its flux is left. */
    constexpr double reach = 6;

    /** One phase between two coordinates with given temperatures. */
    struct Profile
    {
      std::vector<double> eta, excess; ///< excess: T - T_m
      double first_flux = 0;           ///< kappa T' at the first coordinate
      double last_flux = 0;            ///< and at the last one
    };

    Profile solve(const ContinuumPhase &phase, double begin, double end, double first,
                  double last)
    {
      Profile profile;
      const double step = (end - begin) / intervals;
      for(int k = 0; k <= intervals; ++k)
      {
        profile.eta.push_back(begin + k * step);
        profile.excess.push_back(first + (last - first) * k / intervals);
      }
      if(first == last)
        return profile;
      std::vector<double> flux(intervals + 1), integral(intervals + 1);
      for(int iteration = 0; iteration < most_iterations; ++iteration)
      {
        // Trapezoidal rule: exponent, then the integral of flux / kappa.
        const auto decay = [&](int k)
        {
          const double t = profile.excess[k];
          return profile.eta[k] * phase.heat_capacity(t)
                 / (2 * phase.mass_conductivity(t));
        };
        const auto slope
            = [&](int k) { return flux[k] / phase.mass_conductivity(profile.excess[k]); };
        double exponent = 0;
        flux[0] = 1;
        integral[0] = 0;
        for(int k = 1; k <= intervals; ++k)
        {
          exponent += step * (decay(k - 1) + decay(k)) / 2;
          flux[k] = std::exp(-exponent);
          integral[k] = integral[k - 1] + step * (slope(k - 1) + slope(k)) / 2;
        }
        const double factor = (last - first) / integral[intervals];
        profile.first_flux = factor;
        profile.last_flux = factor * flux[intervals];
        double change = 0;
        for(int k = 0; k <= intervals; ++k)
        {
          const double t = first + factor * integral[k];
          change = std::max(change, std::abs(t - profile.excess[k]));
          profile.excess[k] = t;
        }
        if(change < tolerance * std::abs(last - first))
          break;
      }
      return profile;
    }

    void check(const Substance &substance, double wall, double initial)
    {
      const double melting = substance.melting_temperature;
      if(!(wall > melting && melting >= initial && substance.latent_heat > 0))
        throw cases::InputError(fmt::format(
            "a half space melts where its wall ({}) is hotter than its melting "
            "temperature "
            "({}), its start ({}) is not, and its latent heat ({}) is positive",
            wall, melting, initial, substance.latent_heat));
      const auto require
          = [&](const ContinuumPhase &phase, double excess, const char *name)
      {
        if(!(phase.density(excess) > 0 && phase.conductivity(excess) > 0
             && phase.heat_capacity(excess) > 0))
          throw cases::InputError(fmt::format(
              "at the temperature {:.6g} a property of the {} is not positive: density "
              "{:.4g}, conductivity {:.4g}, heat capacity {:.4g}",
              melting + excess, name, phase.density(excess), phase.conductivity(excess),
              phase.heat_capacity(excess)));
      };
      for(const double excess : {0., wall - melting})
        require(substance.liquid, excess, "liquid");
      for(const double excess : {initial - melting, 0.})
        require(substance.solid, excess, "solid");
    }

    /** Largest kappa / c, at one of the ends, for properties that are linear. */
    double diffusivity(const ContinuumPhase &phase, double excess)
    {
      return std::max(phase.mass_conductivity(0) / phase.heat_capacity(0),
                      phase.mass_conductivity(excess) / phase.heat_capacity(excess));
    }
  } // namespace

  SimilaritySolution melt_half_space(const Substance &substance, double wall_temperature,
                                     double initial_temperature)
  {
    check(substance, wall_temperature, initial_temperature);
    const double hot = wall_temperature - substance.melting_temperature;
    const double cold = initial_temperature - substance.melting_temperature;
    const double far = 2 * reach * std::sqrt(diffusivity(substance.solid, cold));
    const auto liquid
        = [&](double front) { return solve(substance.liquid, 0, front, hot, 0); };
    const auto solid = [&](double front)
    { return solve(substance.solid, front, front + far, 0, cold); };
    // Heat that arrives less heat that is needed: falls with the front.
    const auto excess_heat = [&](double front)
    {
      return -liquid(front).last_flux + solid(front).first_flux
             - substance.latent_heat * front / 2;
    };
    double low = 0, high = std::sqrt(diffusivity(substance.liquid, hot));
    while(excess_heat(high) > 0)
      high *= 2;
    for(int k = 0; k < 60; ++k)
    {
      const double middle = (low + high) / 2;
      (excess_heat(middle) > 0 ? low : high) = middle;
    }
    const double front = (low + high) / 2;
    SimilaritySolution result;
    result.slope = front * front;
    for(const Profile &profile : {liquid(front), solid(front)})
      for(std::size_t k = 0; k < profile.eta.size(); ++k)
      {
        result.coordinate.push_back(profile.eta[k]);
        result.temperature.push_back(substance.melting_temperature + profile.excess[k]);
      }
    return result;
  }
} // namespace meltfront::particles::greenspan
