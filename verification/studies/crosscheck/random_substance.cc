#include <verification/studies/crosscheck/random_substance.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace meltfront::verification
{
  namespace
  {
    /** What an actual substance has, rounded: conductivities, heat capacities, density,
     * latent heat, melting temperature (degrees Celsius). */
    struct Actual
    {
      double solid_conductivity, liquid_conductivity, solid_capacity, liquid_capacity,
          density, latent_heat, melting_temperature;
    };

    constexpr Actual actual_substances[] = {
        {40.6, 29.4, 371, 397, 6000, 80160, 29.78}, // gallium
        {2.2, 0.591, 2090, 4190, 1000, 333500, 0},  // water
        {211, 91, 917, 1080, 2400, 397000, 660.3},  // aluminium
        {0.24, 0.15, 2400, 1900, 820, 226000, 28},  // a wax
    };

    /** 1 often, else of the order of one, seldom far from it. */
    double contrast(RandomStream &random, double mild, double strong)
    {
      switch(random.weighted({0.35, 0.45, 0.2}))
      {
      case 0:
        return 1;
      case 1:
        return random.log_uniform(1 / mild, mild);
      default:
        return random.log_uniform(1 / strong, strong);
      }
    }
  } // namespace

  double Substance::diffusivity() const
  {
    return std::sqrt(solid_conductivity / (solid_density * solid_capacity)
                     * liquid_conductivity / (liquid_density * liquid_capacity));
  }

  double Substance::conductivity() const
  {
    return std::sqrt(solid_conductivity * liquid_conductivity);
  }

  std::string words(double value, int digits)
  {
    return fmt::format("{:.{}g}", value, digits);
  }

  double rounded(double value)
  {
    return std::strtod(words(value).c_str(), nullptr);
  }

  Substance random_substance(RandomStream &random, bool changes_phase)
  {
    Substance s;
    s.si = random.chance(0.5);
    const Actual &actual = actual_substances[random.below(std::size(actual_substances))];
    const bool as_it_is = random.chance(0.5);
    if(s.si)
    {
      s.solid_conductivity = actual.solid_conductivity;
      s.solid_capacity = actual.solid_capacity;
      s.solid_density = actual.density;
      s.melting_temperature = actual.melting_temperature;
      s.temperature_scale = rounded(random.log_uniform(1, 50));
      s.length = rounded(random.log_uniform(1e-3, 1));
    }
    else if(random.chance(0.3))
    {
      s.melting_temperature = rounded(random.uniform(-10, 10));
      s.length = rounded(random.log_uniform(0.1, 10));
    }
    s.liquid_conductivity = rounded(s.solid_conductivity * contrast(random, 4, 1e3));
    s.liquid_capacity = rounded(s.solid_capacity * contrast(random, 2, 20));
    if(s.si && as_it_is)
    {
      s.liquid_conductivity = actual.liquid_conductivity;
      s.liquid_capacity = actual.liquid_capacity;
    }
    s.liquid_density = s.solid_density;
    if(random.chance(0.06))
      s.liquid_density = rounded(s.solid_density * random.uniform(0.7, 1.4));
    const double stefan_number = random.chance(0.75) ? random.log_uniform(0.1, 5)
                                                     : random.log_uniform(1e-2, 1e2);
    if(changes_phase)
      s.latent_heat
          = s.si && as_it_is
                ? actual.latent_heat
                : rounded(s.solid_capacity * s.temperature_scale / stefan_number);
    return s;
  }

  void write_substance(const Substance &s, bool changes_phase, SceneDraft &draft)
  {
    const std::string material = "Scene/Material";
    draft.set(material, "latent heat", words(s.latent_heat));
    if(changes_phase)
      draft.set(material, "melting temperature", words(s.melting_temperature));
    const std::string solid = material + "/Solid", liquid = material + "/Liquid";
    draft.set(solid, "conductivity", words(s.solid_conductivity));
    draft.set(solid, "specific heat capacity", words(s.solid_capacity));
    draft.set(solid, "density", words(s.solid_density));
    if(!changes_phase)
      return;
    const auto of_liquid = [&](const char *key, double of_solid, double value)
    {
      if(value != of_solid)
        draft.set(liquid, key, words(value));
    };
    of_liquid("conductivity", s.solid_conductivity, s.liquid_conductivity);
    of_liquid("specific heat capacity", s.solid_capacity, s.liquid_capacity);
    of_liquid("density", s.solid_density, s.liquid_density);
  }
} // namespace meltfront::verification
