#include <cases/error.h>
#include <cases/property_curve.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  PropertyCurve::PropertyCurve(std::vector<double> temperatures,
                               std::vector<double> values, std::string words)
    : knots(std::move(temperatures))
    , ordinates(std::move(values))
    , text(std::move(words))
  {
    if(knots.size() < 2 || knots.size() != ordinates.size())
      throw InputError("needs two points or more, with a value each");
    for(std::size_t i = 0; i < knots.size(); ++i)
    {
      if(!std::isfinite(knots[i]) || !std::isfinite(ordinates[i]))
        throw InputError(fmt::format("is {} at {:.6g}", ordinates[i], knots[i]));
      if(i > 0 && !(knots[i] > knots[i - 1]))
        throw InputError(
            fmt::format("needs points that ascend; {:.6g} comes after {:.6g}", knots[i],
                        knots[i - 1]));
    }
  }

  PropertyCurve PropertyCurve::tabulated(const std::function<double(double)> &function,
                                         double lowest, double highest, std::string words)
  {
    std::vector<double> temperatures, values;
    for(int i = 0; i <= samples_of_expression; ++i)
    {
      temperatures.push_back(lowest + (highest - lowest) * i / samples_of_expression);
      values.push_back(function(temperatures.back()));
    }
    return {std::move(temperatures), std::move(values), std::move(words)};
  }

  double PropertyCurve::operator()(double temperature) const
  {
    const auto next = std::ranges::upper_bound(knots, temperature);
    if(next == knots.begin())
      return ordinates.front();
    if(next == knots.end())
      return ordinates.back();
    const auto i = static_cast<std::size_t>(next - knots.begin());
    const double share = (temperature - knots[i - 1]) / (knots[i] - knots[i - 1]);
    return ordinates[i - 1] + share * (ordinates[i] - ordinates[i - 1]);
  }
} // namespace meltfront::cases
