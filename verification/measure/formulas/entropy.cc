#include <cases/error.h>
#include <cases/numbers.h>
#include <verification/measure/formulas/entropy.h>
#include <verification/measure/formulas/mush_error.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;

    /** x ln x, continued to zero. */
    double x_log_x(double x)
    {
      return x == 0 ? 0 : x * std::log(x);
    }
  } // namespace

  EntropyMeter::EntropyMeter(const cases::Scene &scene, double absolute_zero)
    : material(scene.material)
    , absolute_zero(absolute_zero)
    , melting(scene.material.melting_temperature - absolute_zero)
  {
    if(!(melting > 0))
      throw cases::InputError(
          fmt::format("{}: the absolute zero {} is not below the melting temperature {}",
                      scene.name, absolute_zero, scene.material.melting_temperature));
    if(!scene.alloy)
      return;
    solutes = scene.alloy->solutes.size();
    straight = solutes == 1 && !scene.alloy->solutes[0].liquidus_curve;
    slope = scene.alloy->solutes[0].liquidus_slope;
  }

  double EntropyMeter::site_entropy(double temperature, double liquid,
                                    double concentration) const
  {
    const double logarithm = std::log((temperature - absolute_zero) / melting);
    const double melting_entropy = material.latent_heat / melting;
    const double solid_part = material.solid.specific_heat_capacity * logarithm;
    if(liquid == 0)
      return solid_part;
    const double gain
        = material.liquid.specific_heat_capacity - material.solid.specific_heat_capacity;
    const double x = slope * concentration / melting;
    const double mixing
        = -melting_entropy * (x_log_x(x) - x * std::log1p(-x)) - gain * std::log1p(-x);
    return solid_part + liquid * (gain * logarithm + melting_entropy + mixing);
  }

  Entropy EntropyMeter::of(const cases::Snapshot &snapshot) const
  {
    Entropy entropy{0, solutes > 0 ? 0 : nan};
    const double density = material.liquid.density;
    for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
    {
      const double mass = density * snapshot.weights[i];
      const double liquid = 1 - snapshot.solid_fraction[i];
      if(mass == 0)
        continue;
      double solvent = 1, ideal = 0, first = 0;
      for(std::size_t s = 0; s < solutes && liquid > 0; ++s)
      {
        const double c = liquid_concentration(snapshot.concentration[s][i],
                                              snapshot.solid_fraction[i]);
        if(s == 0)
          first = c;
        solvent -= c;
        ideal -= x_log_x(c);
      }
      entropy.total += mass * site_entropy(snapshot.temperature[i], liquid, first);
      entropy.mixing += mass * liquid * (ideal - x_log_x(solvent));
    }
    if(!straight)
      entropy.total = nan;
    return entropy;
  }
} // namespace meltfront::verification
