#include <reference_fem/enthalpy/mush_conduction.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meltfront::reference_fem
{
  MushConductivity::MushConductivity(const cases::Material &material,
                                     const cases::Alloy &alloy)
    : line(alloy)
    , solid(material.solid.conductivity)
    , liquid(material.liquid.conductivity)
    , expansion(
          alloy.crystal_density > 0 ? material.liquid.density / alloy.crystal_density : 1)
    , eutectic(alloy.eutectic_temperature - material.melting_temperature)
  {
  }

  /** t below which crystals lighter than the liquid fill all the space. */
  double MushConductivity::full_excess(const Composition &node) const
  {
    return expansion > 1 ? -line.depression(node.solute / (1 - 1 / expansion))
                         : -std::numeric_limits<double>::infinity();
  }

  /** Integral of the liquid fraction over a span of temperatures of mush. */
  double MushConductivity::molten(double low, double span, const Composition &node) const
  {
    return line.straight() ? -node.depression * std::log1p(span / low)
                           : node.solute * span * line.mean_dilution(-low - span, -low);
  }

  double MushConductivity::mean(double a, double b, const Composition &node) const
  {
    const auto [low, high] = std::minmax(a, b);
    const double liquidus = std::max(-node.depression, eutectic);
    if(low >= liquidus)
      return liquid;
    // Where the rest freezes, or crystals fill the space, the solid's share no longer
    // grows.
    const double floor = node.depression > 0
                             ? std::min(std::max(eutectic, full_excess(node)), liquidus)
                             : liquidus;
    const double most = std::min(expansion, 1.);
    if(low == high)
    {
      const double share
          = low < floor ? most : expansion * (1 - node.solute / line.solute_at(-low));
      return liquid + share * (solid - liquid);
    }
    double share = most * std::max(std::min(high, floor) - low, 0.);
    const double mush_low = std::max(low, floor);
    const double mush = std::min(high, liquidus) - mush_low;
    if(mush > 0)
      share += expansion * (mush - molten(mush_low, mush, node));
    return liquid + share / (high - low) * (solid - liquid);
  }

  MushConduction::MushConduction(const ConductionMatrix &unit,
                                 const cases::Material &material,
                                 const cases::Alloy &alloy,
                                 const std::vector<Composition> &composition)
    : unit(unit)
    , conductivity(material, alloy)
    , composition(composition)
    , mixed(unit)
    , renewed(unit.conductance.size())
  {
  }

  double MushConduction::renew(const CompensatedVector &excess)
  {
    double change = 0;
    for(std::size_t i = 0; i < unit.size(); ++i)
      for(std::size_t k = unit.row_start[i]; k < unit.row_start[i + 1]; ++k)
      {
        const std::size_t j = unit.column[k];
        // In the same order from both sides: both rows hold the same bits.
        const Composition &here = composition[std::min(i, j)],
                          &there = composition[std::max(i, j)];
        double mean = conductivity.mean(excess[i], excess[j], here);
        if(there.solute != here.solute)
          mean = (mean + conductivity.mean(excess[i], excess[j], there)) / 2;
        renewed[k] = mean * unit.conductance[k];
        change = std::max(change, std::abs(renewed[k] - mixed.conductance[k])
                                      / std::abs(renewed[k]));
      }
    return change;
  }

  void MushConduction::adopt()
  {
    mixed.conductance.swap(renewed);
    for(std::size_t i = 0; i < unit.size(); ++i)
    {
      mixed.diagonal[i] = 0;
      for(std::size_t k = unit.row_start[i]; k < unit.row_start[i + 1]; ++k)
        mixed.diagonal[i] += mixed.conductance[k];
    }
  }

  long MushConduction::bytes() const
  {
    return static_cast<long>(mixed.column.size()
                                 * (2 * sizeof(double) + sizeof(unsigned int))
                             + mixed.size() * (sizeof(double) + sizeof(std::size_t)));
  }
} // namespace meltfront::reference_fem
