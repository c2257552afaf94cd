#include <cases/error.h>
#include <particles/sph_two_population/curved_liquidus.h>

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    constexpr int samples = 256;

    /** Half a difference over the concentration, or over a tenth of the largest. */
    constexpr double half_difference = 1e-5;

    constexpr double rounding = 2e-16;
  } // namespace

  CurvedLiquidus::CurvedLiquidus(const AlloySubstance &substance)
    : curve(substance.alloy.solutes.at(0).liquidus_curve)
    , largest(substance.alloy.solutes[0].largest_concentration)
    , last(curve(largest))
    , expansion(substance.expansion)
    , eutectic_excess(substance.eutectic_excess)
    , at_eutectic(std::numeric_limits<double>::infinity())
  {
    double before = curve(0);
    if(!(std::abs(before) <= 1e-9 * std::abs(last)))
      throw cases::InputError(fmt::format("the liquidus lies {:.6g} below the melting "
                                          "temperature at the concentration 0; it must "
                                          "begin there",
                                          before));
    for(int i = 1; i <= samples; ++i)
    {
      const double y = largest * i / samples, here = curve(y);
      if(!(here > before) || !std::isfinite(here))
        throw cases::InputError(fmt::format("the liquidus must fall as the concentration "
                                            "rises; it does not at the mass fraction "
                                            "{:.6g}",
                                            y));
      before = here;
    }
    last_slope = slope(largest);
    if(std::isfinite(eutectic_excess))
      at_eutectic = solute_at(-eutectic_excess);
  }

  double CurvedLiquidus::slope(double y) const
  {
    if(y > largest)
      return last_slope;
    const double half = half_difference * std::max(y, 0.1 * largest);
    const double from = std::max(y - half, 0.), to = std::min(y + half, largest);
    return (curve(to) - curve(from)) / (to - from);
  }

  double CurvedLiquidus::solute_at(double wanted) const
  {
    if(wanted >= last)
      return largest + (wanted - last) / last_slope;
    if(!(wanted > 0))
      return 0;
    return rising_root([&](double y) { return curve(y) - wanted; }, 0., -wanted, largest,
                       largest * wanted / last, rounding * largest);
  }

  double CurvedLiquidus::solid_path(double excess, double concentration) const
  {
    const double start = depression(concentration);
    if(!(excess < -start))
      return 0;
    const double most = std::min(expansion, 1.);
    if(!(concentration > 0))
      return most * excess;
    double y = solute_at(std::min(-excess, -eutectic_excess));
    // Where crystals are lighter than the liquid they fill the volume before all is
    // solid.
    if(expansion > 1)
      y = std::min(y, concentration * expansion / (expansion - 1));
    const double end = depression(y);
    const double by_concentration = boost::math::quadrature::gauss<double, 10>::integrate(
        [this](double t)
        {
          const double content = std::exp(t);
          return depression(content) / content;
        },
        std::log(concentration), std::log(y));
    const double dilution = end / y - start / concentration + by_concentration;
    const double mush = expansion * (end - start - concentration * dilution);
    return -(mush + most * (-excess - end));
  }
} // namespace meltfront::particles
