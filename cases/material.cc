#include <cases/material.h>
#include <cases/numbers.h>

#include <algorithm>

namespace meltfront::cases
{
  bool Material::varies_with_temperature() const
  {
    return solid.conductivity_curve || solid.heat_capacity_curve
           || liquid.conductivity_curve || liquid.heat_capacity_curve;
  }

  std::pair<double, double> Material::known_temperatures() const
  {
    std::pair<double, double> known{-infinity, infinity};
    for(const auto &curve : {solid.conductivity_curve, solid.heat_capacity_curve})
      if(curve)
        known.first = std::max(known.first, curve->temperatures().front());
    for(const auto &curve : {liquid.conductivity_curve, liquid.heat_capacity_curve})
      if(curve)
        known.second = std::min(known.second, curve->temperatures().back());
    return known;
  }

  void Material::update_curves()
  {
    curves = varies_with_temperature() || melting_range
                 ? std::make_shared<const ThermalCurves>(*this)
                 : nullptr;
  }
} // namespace meltfront::cases
