#include <cases/error.h>
#include <reference_fem/enthalpy/liquidus.h>

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

#include <limits>

namespace meltfront::reference_fem
{
  namespace
  {
    constexpr int knots_per_octave = 16;
    constexpr int most_octaves = 40;

    /** Share of the concentration, or of a tenth of the largest, for differences. */
    constexpr double difference = 1e-5;

    [[noreturn]] void refuse(double concentration)
    {
      throw cases::InputError(fmt::format("the liquidus must fall as the concentration "
                                          "rises; it does not at the mass fraction "
                                          "{:.6g}",
                                          concentration));
    }
  } // namespace

  Liquidus::Liquidus(const cases::Alloy &alloy)
  {
    if(alloy.solutes.empty() || !alloy.solutes[0].liquidus_curve)
      return;
    curve = alloy.solutes[0].liquidus_curve;
    const double largest = alloy.solutes[0].largest_concentration;
    if(!(std::abs(curve(0)) <= least_depression))
      throw cases::InputError(fmt::format("the liquidus lies {:.6g} below the melting "
                                          "temperature at the concentration 0; it must "
                                          "begin there",
                                          curve(0)));
    for(int i = 0; i <= most_octaves * knots_per_octave; ++i)
    {
      const double solute
          = largest * std::exp2(-static_cast<double>(i) / knots_per_octave);
      const double depression = curve(solute);
      if(!std::isfinite(depression)
         || (!knots.empty() && !(depression < knots.back().depression)))
        refuse(solute);
      if(depression < least_depression)
        break;
      knots.push_back({solute, depression, 0});
    }
    if(knots.size() < 2)
      refuse(largest);
    knots.push_back({0, 0, 0});
    std::reverse(knots.begin(), knots.end());
    for(std::size_t i = 2; i < knots.size(); ++i)
      knots[i].dilution
          = knots[i - 1].dilution + integrated_dilution(knots[i - 1], knots[i]);
    const Knot &last = knots.back(), &before = *(knots.end() - 2);
    last_slope = (last.depression - before.depression) / (last.solute - before.solute);
  }

  double Liquidus::on_curve(double solute) const
  {
    const Knot &last = knots.back();
    return solute <= last.solute ? curve(solute)
                                 : last.depression + last_slope * (solute - last.solute);
  }

  double Liquidus::largest_depression() const
  {
    return straight() ? std::numeric_limits<double>::infinity() : knots.back().depression;
  }

  double Liquidus::slope(double solute) const
  {
    if(straight())
      return 1;
    const double largest = knots.back().solute;
    if(solute >= largest)
      return last_slope;
    const double step = difference * std::max(solute, largest / 10);
    const double lower = std::max(solute - step, 0.);
    const double upper = std::min(solute + step, largest);
    return (curve(upper) - curve(lower)) / (upper - lower);
  }

  /** By parts, with D the depression over that at the lower end: the integral of dD/y is
   * D/y at the upper end and the integral of D/y^2, none of which cancels. */
  double Liquidus::integrated_dilution(const Knot &lower, const Knot &upper) const
  {
    if(!(upper.solute > lower.solute))
      return 0;
    const auto integrand = [&](double solute)
    { return (on_curve(solute) - lower.depression) / (solute * solute); };
    return (upper.depression - lower.depression) / upper.solute
           + boost::math::quadrature::gauss<double, 4>::integrate(integrand, lower.solute,
                                                                  upper.solute);
  }

  double Liquidus::mean_dilution(double low, double high) const
  {
    if(straight())
      return std::log1p((high - low) / low) / (high - low);
    const auto at = [this](double depression)
    {
      const double solute = solute_at(depression);
      return Knot{solute, on_curve(solute), 0};
    };
    const Knot lower = at(low), upper = at(high);
    const double rise = upper.depression - lower.depression;
    if(!(upper.solute > lower.solute && rise > 0))
      return 1 / upper.solute;
    const auto beyond
        = [](double solute, const Knot &knot) { return solute < knot.solute; };
    const auto first = std::upper_bound(knots.begin(), knots.end(), lower.solute, beyond);
    const auto next = std::upper_bound(first, knots.end(), upper.solute, beyond);
    if(first == next)
      return integrated_dilution(lower, upper) / rise;
    const Knot &last = *std::prev(next);
    return (integrated_dilution(lower, *first) + (last.dilution - first->dilution)
            + integrated_dilution(last, upper))
           / rise;
  }
} // namespace meltfront::reference_fem
