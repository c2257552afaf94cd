#ifndef meltfront_cases_exact_tests_salt_water_h
#define meltfront_cases_exact_tests_salt_water_h

#include <cases/exact/mushy_layer.h>
#include <cases/exact/tests/materials.h>

namespace meltfront::cases
{
  /** Water with sodium nitrate (Monaghan, Huppert and Worster 2005, section 5). */
  inline Material salt_water()
  {
    return {{2.408, 2006, 1097}, {0.498, 4180, 1097}, 334400, 0};
  }

  inline constexpr double salt_diffusivity = 6.8e-7 / 1097;

  inline Alloy sodium_nitrate(double crystal_density, double diffusivity = 0)
  {
    Alloy alloy;
    alloy.solutes.push_back(
        {.name = "sodium nitrate", .liquidus_slope = 42.28, .diffusivity = diffusivity});
    alloy.crystal_density = crystal_density;
    return alloy;
  }

  /**
   * The four sets of data, a wall at -16.5 and a melt at 14.7: A and C with a constant
   * heat of freezing, B and D with the consistent one; A and B with crystals of 917
   * kg/m^3, C and D with crystals of the liquid's density.
   */
  inline MushyLayer data_set(char name, double diffusivity = 0)
  {
    const bool constant = name == 'A' || name == 'C';
    return {salt_water(),
            sodium_nitrate(name < 'C' ? 917 : 0, diffusivity),
            {0.14},
            -16.5,
            14.7,
            constant ? similarity::HeatOfFreezing::constant
                     : similarity::HeatOfFreezing::consistent};
  }

  /** The same as what the equations hold, without diffusion. */
  template <typename Real = double>
  similarity::Mush<Real> equations_of(char name)
  {
    similarity::Mush<Real> mush;
    mush.conductivity_ratio = Real(2.408) / Real(0.498);
    mush.capacity_ratio = Real(2006) / Real(4180);
    mush.expansion = name < 'C' ? Real(1097) / Real(917) : Real(1);
    mush.latent = Real(334400) / Real(4180);
    mush.composition = Real(42.28) * Real(0.14);
    mush.excess = Real(14.7);
    mush.wall = Real(16.5);
    mush.heat = name == 'A' || name == 'C' ? similarity::HeatOfFreezing::constant
                                           : similarity::HeatOfFreezing::consistent;
    return mush;
  }
} // namespace meltfront::cases

#endif
