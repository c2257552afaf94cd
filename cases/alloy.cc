#include <cases/alloy.h>
#include <cases/error.h>

// Boost 1.74's pchip calls isnan unqualified: the name must stand in the global
// namespace.
#include <math.h>

#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <memory>

namespace meltfront::cases
{
  PhaseDiagram::PhaseDiagram(const Material &material, const Alloy &alloy)
    : melting_temperature(material.melting_temperature)
    , latent_heat(material.latent_heat)
    , solid_capacity(material.solid.specific_heat_capacity)
    , liquid_capacity(material.liquid.specific_heat_capacity)
    , solid_conductivity(material.solid.conductivity)
    , liquid_conductivity(material.liquid.conductivity)
    , expansion(
          alloy.crystal_density > 0 ? material.liquid.density / alloy.crystal_density : 1)
    , eutectic_excess(alloy.eutectic_temperature - material.melting_temperature)
  {
    for(const Solute &solute : alloy.solutes)
    {
      if(solute.liquidus_curve && alloy.solutes.size() > 1)
        throw InputError(fmt::format("the liquidus of {} is curved, which needs it to be "
                                     "the only solute",
                                     solute.name));
      if(!(solute.liquidus_slope >= 0))
        throw InputError(fmt::format("the liquidus slope of {} is {}; it must not be "
                                     "negative: solute lowers the melting point",
                                     solute.name, solute.liquidus_slope));
    }
    if(!alloy.solutes.empty())
    {
      first_slope = alloy.solutes[0].liquidus_slope;
      curve = alloy.solutes[0].liquidus_curve;
      largest_concentration = alloy.solutes[0].largest_concentration;
    }
    if(alloy.solutes.size() > 1)
      second_slope = alloy.solutes[1].liquidus_slope;
  }

  double PhaseDiagram::liquidus(double first, double second) const
  {
    return melting_temperature - depression(first, second);
  }

  PhaseState PhaseDiagram::on_curve(double enthalpy, double concentration) const
  {
    if(enthalpy >= latent_heat - liquid_capacity * curve(concentration))
      return above_liquidus(enthalpy);
    if(concentration <= 0)
      return below_liquidus(enthalpy, std::min(enthalpy, 0.) / solid_capacity);
    // The mush's enthalpy rises with its liquid fraction f, and so does its temperature.
    const auto excess_at = [&](double f)
    { return -curve(std::min(concentration / f, largest_concentration)); };
    const auto surplus = [&](double f)
    {
      const double excess = excess_at(f);
      return solid_capacity * excess
             + f * (latent_heat + (liquid_capacity - solid_capacity) * excess) - enthalpy;
    };
    double lower = concentration / largest_concentration;
    if(surplus(lower) >= 0)
    {
      if(excess_at(lower) <= eutectic_excess)
        return below_liquidus(enthalpy, -std::numeric_limits<double>::infinity());
      throw InputError(
          fmt::format("the mush is colder than the liquidus is known, {:.6g} at the mass "
                      "fraction {:.6g}: extend the liquidus or state the eutectic "
                      "temperature",
                      melting_temperature + excess_at(lower), largest_concentration));
    }
    std::uintmax_t iterations = 200;
    const auto closed
        = [](double a, double b) { return std::abs(a - b) <= 2e-16 * std::abs(b); };
    const auto bracket
        = boost::math::tools::toms748_solve(surplus, lower, 1., closed, iterations);
    return below_liquidus(enthalpy, excess_at(0.5 * (bracket.first + bracket.second)));
  }

  double PhaseDiagram::solid_fraction(double temperature, double first,
                                      double second) const
  {
    const double excess = temperature - melting_temperature;
    if(excess <= eutectic_excess)
      return 1;
    const double whole = depression(first, second);
    if(excess >= -whole)
      return excess == 0 && whole == 0 ? 1 : 0;
    if(!curve)
      return 1 + whole / excess;
    // C/f is the concentration whose liquidus is the temperature.
    if(first <= 0)
      return 1;
    if(-excess > curve(largest_concentration))
      throw InputError(fmt::format("the liquidus is not known down to the temperature "
                                   "{:.6g}",
                                   temperature));
    std::uintmax_t iterations = 200;
    const auto closed
        = [](double a, double b) { return std::abs(a - b) <= 2e-16 * std::abs(b); };
    const auto bracket = boost::math::tools::toms748_solve(
        [&](double concentration) { return curve(concentration) + excess; }, first,
        largest_concentration, closed, iterations);
    return 1 - first / (0.5 * (bracket.first + bracket.second));
  }

  double PhaseDiagram::enthalpy(double temperature, double first, double second) const
  {
    const double excess = temperature - melting_temperature;
    const double liquid = 1 - solid_fraction(temperature, first, second);
    return (1 - liquid) * solid_capacity * excess
           + liquid * (liquid_capacity * excess + latent_heat);
  }

  std::function<double(double)>
  liquidus_through(const std::vector<std::pair<double, double>> &points,
                   double melting_temperature)
  {
    if(points.size() < 4)
      throw InputError(
          fmt::format("a liquidus needs at least four points, not {}", points.size()));
    std::vector<double> concentration, fall;
    for(const auto &[mass_fraction, temperature] : points)
    {
      concentration.push_back(mass_fraction);
      fall.push_back(melting_temperature - temperature);
    }
    if(concentration[0] != 0 || fall[0] != 0)
      throw InputError(fmt::format(
          "a liquidus begins at the concentration 0 and the melting temperature {:.6g}",
          melting_temperature));
    for(std::size_t i = 1; i < points.size(); ++i)
      if(!(concentration[i] > concentration[i - 1] && fall[i] > fall[i - 1]))
        throw InputError(fmt::format("a liquidus falls as the concentration rises; point "
                                     "{} does not",
                                     i + 1));
    const double last = concentration.back();
    const auto interpolant
        = std::make_shared<boost::math::interpolators::pchip<std::vector<double>>>(
            std::move(concentration), std::move(fall));
    return [interpolant, last](double c)
    { return (*interpolant)(std::clamp(c, 0., last)); };
  }
} // namespace meltfront::cases
