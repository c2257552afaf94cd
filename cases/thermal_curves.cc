#include <cases/error.h>
#include <cases/material.h>
#include <cases/numbers.h>
#include <cases/thermal_curves.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <tuple>

namespace meltfront::cases
{
  namespace
  {
    /** So many pieces of a melting range where properties vary as well: a product of two
     * straight lines is none. */
    constexpr int pieces_of_range = 512;

    double upper_end(const Material &material)
    {
      return material.melting_range ? material.melting_range->liquidus
                                    : material.melting_temperature;
    }

    std::vector<double> lay_knots(const Material &material)
    {
      const double melting = material.melting_temperature;
      const double molten = upper_end(material);
      std::vector<double> knots{melting, molten};
      const auto take = [&knots](const std::shared_ptr<const PropertyCurve> &curve,
                                 double above, double below)
      {
        if(curve)
          for(const double temperature : curve->temperatures())
            if(temperature > above && temperature < below)
              knots.push_back(temperature);
      };
      for(const auto &[phase, above, below] :
          {std::tuple(&material.solid, -infinity, molten),
           std::tuple(&material.liquid, melting, infinity)})
      {
        take(phase->conductivity_curve, above, below);
        take(phase->heat_capacity_curve, above, below);
      }
      if(material.melting_range)
      {
        take(material.melting_range->solid_fraction, melting, molten);
        for(int i = 1; material.varies_with_temperature() && i < pieces_of_range; ++i)
          knots.push_back(melting + (molten - melting) * i / pieces_of_range);
      }
      std::ranges::sort(knots);
      // Knots that only round-off parts would make pieces without a length.
      const double least = 1e-12 * (std::abs(knots.front()) + std::abs(knots.back()));
      std::vector<double> kept;
      for(const double knot : knots)
        if(kept.empty() || knot - kept.back() > least)
          kept.push_back(knot);
        else if(knot == melting || knot == molten)
          kept.back() = knot;
      return kept;
    }

    void require_positive(double value, const char *what, double temperature)
    {
      if(!(value > 0) || !std::isfinite(value))
        throw InputError(fmt::format("{} is {:.6g} at T = {:.6g}; it must be above zero",
                                     what, value, temperature));
    }
  } // namespace

  ThermalCurves::ThermalCurves(const Material &material)
    : reference(material.melting_temperature)
    , latent_heat(material.latent_heat)
    , temperatures(lay_knots(material))
  {
    melting_knot = static_cast<std::size_t>(
        std::ranges::lower_bound(temperatures, reference) - temperatures.begin());
    const double molten = upper_end(material);
    const auto end = [&](double temperature, bool from_above)
    {
      const double solid
          = temperature < reference || (temperature == reference && !from_above) ? 1
            : temperature < molten || (temperature == molten && !from_above)
                ? (*material.melting_range->solid_fraction)(temperature)
                : 0;
      const double conductivity
          = solid * material.solid.conductivity_at(temperature)
            + (1 - solid) * material.liquid.conductivity_at(temperature);
      const double capacity
          = solid * material.solid.heat_capacity_at(temperature)
            + (1 - solid) * material.liquid.heat_capacity_at(temperature);
      require_positive(conductivity, "the conductivity", temperature);
      require_positive(capacity, "the specific heat capacity", temperature);
      return End{conductivity, capacity, solid};
    };
    // A substance with one knot has no piece: what lies beyond its ends says all.
    pieces.push_back(
        {end(temperatures.front(), false), end(temperatures.front(), false)});
    for(std::size_t i = 0; i + 1 < temperatures.size(); ++i)
    {
      Piece piece{end(temperatures[i], true), end(temperatures[i + 1], false)};
      const double released = latent_heat
                              * (piece.lower.solid_fraction - piece.upper.solid_fraction)
                              / (temperatures[i + 1] - temperatures[i]);
      if(released < 0)
        throw InputError(
            fmt::format("the solid fraction rises at T = {:.6g}; it must fall "
                        "from solidus to liquidus",
                        temperatures[i]));
      piece.lower.capacity += released;
      piece.upper.capacity += released;
      pieces.push_back(piece);
    }
    pieces.push_back({end(temperatures.back(), true), end(temperatures.back(), true)});
    latent_jump = latent_heat * (1 - pieces[melting_knot + 1].lower.solid_fraction);
    integrate();
  }

  void ThermalCurves::integrate()
  {
    enthalpies.assign(temperatures.size(), 0);
    kirchhoffs.assign(temperatures.size(), 0);
    enthalpies[melting_knot] = latent_jump;
    const auto mean = [this](std::size_t knot, double End::*value)
    {
      const Piece &piece = pieces[knot + 1];
      return (temperatures[knot + 1] - temperatures[knot])
             * (piece.lower.*value + piece.upper.*value) / 2;
    };
    for(std::size_t i = melting_knot; i + 1 < temperatures.size(); ++i)
    {
      enthalpies[i + 1] = enthalpies[i] + mean(i, &End::capacity);
      kirchhoffs[i + 1] = kirchhoffs[i] + mean(i, &End::conductivity);
    }
    for(std::size_t i = melting_knot; i > 0; --i)
    {
      const double above = i == melting_knot ? 0 : enthalpies[i];
      enthalpies[i - 1] = above - mean(i - 1, &End::capacity);
      kirchhoffs[i - 1] = kirchhoffs[i] - mean(i - 1, &End::conductivity);
    }
  }

  ThermalState ThermalCurves::at_temperature(double temperature) const
  {
    return solve(temperature - reference, {0, 0, 1});
  }

  ThermalState ThermalCurves::at_enthalpy(double enthalpy) const
  {
    return solve(enthalpy, {1, 0, 0});
  }

  ThermalState ThermalCurves::at_kirchhoff(double kirchhoff) const
  {
    return solve(kirchhoff, {0, 1, 0});
  }

  ThermalState ThermalCurves::resolve(double target, double mass, double stiffness,
                                      double transfer) const
  {
    return solve(target, {mass, stiffness, transfer});
  }

  double ThermalCurves::at_knot(std::size_t knot, const Factors &factors) const
  {
    return factors.mass * enthalpies[knot] + factors.stiffness * kirchhoffs[knot]
           + factors.transfer * (temperatures[knot] - reference);
  }

  ThermalState ThermalCurves::in_jump(double enthalpy) const
  {
    const End &below = pieces[melting_knot].upper,
              &above = pieces[melting_knot + 1].lower;
    const double molten = latent_jump > 0 ? enthalpy / latent_jump : 0;
    return {reference,
            enthalpy,
            0,
            1 - molten * (1 - above.solid_fraction),
            (1 - molten) * below.conductivity + molten * above.conductivity,
            infinity};
  }

  ThermalState ThermalCurves::solve(double target, const Factors &factors) const
  {
    if(factors.mass > 0 && target >= 0 && target <= factors.mass * latent_jump)
      return in_jump(target / factors.mass);
    const bool above = target >= 0;
    const auto candidates = above
                                ? std::views::iota(melting_knot + 1, temperatures.size())
                                : std::views::iota(std::size_t(0), melting_knot);
    const std::size_t passed = *std::ranges::partition_point(
        candidates, [&](std::size_t knot) { return at_knot(knot, factors) <= target; });
    // From the end of the piece that is nearer to the melting temperature, where all is
    // counted from: a piece may reach far.
    const std::size_t base = above ? passed - 1 : passed;
    // The melting temperature's knot stands for the liquid there.
    const double jump = !above && base == melting_knot ? latent_jump : 0;
    const double rest = target - at_knot(base, factors) + factors.mass * jump;
    const Piece &piece = pieces[passed];
    const End &near = above ? piece.lower : piece.upper;
    const double width = passed == 0 || passed == temperatures.size()
                             ? infinity
                             : temperatures[passed] - temperatures[passed - 1];
    const auto slope = [&factors](const End &end)
    {
      return factors.mass * end.capacity + factors.stiffness * end.conductivity
             + factors.transfer;
    };
    const double begin = slope(near);
    const double bend = (slope(piece.upper) - slope(piece.lower)) / width;
    // begin d + bend d^2/2 = rest, in the form without cancellation
    const double d
        = 2 * rest / (begin + std::sqrt(std::max(begin * begin + 2 * bend * rest, 0.)));
    const auto along = [&](double End::*value)
    { return near.*value + (piece.upper.*value - piece.lower.*value) * d / width; };
    const double conductivity = along(&End::conductivity),
                 capacity = along(&End::capacity);
    return {temperatures[base] + d,
            enthalpies[base] - jump + d * (near.capacity + capacity) / 2,
            kirchhoffs[base] + d * (near.conductivity + conductivity) / 2,
            along(&End::solid_fraction),
            conductivity,
            capacity};
  }

  double ThermalCurves::least_slope(double lowest, double highest) const
  {
    double least = infinity;
    for(std::size_t i = 0; i < pieces.size(); ++i)
    {
      const bool below = i < temperatures.size() && temperatures[i] < lowest;
      const bool beyond = i > 0 && temperatures[i - 1] > highest;
      if(!below && !beyond)
        for(const End &end : {pieces[i].lower, pieces[i].upper})
          least = std::min(least, end.capacity / end.conductivity);
    }
    return least;
  }
} // namespace meltfront::cases
