#include <cases/exact/point_sink.h>
#include <cases/exact/sink_profile.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace meltfront::cases
{
  PointSink::PointSink(const Material &material, double lambda, double far_temperature)
    : RadialSimilarity(material,
                       sink_profile(3, material, lambda, far_temperature, "point sink"))
  {
  }

  double PointSink::amplitude() const
  {
    // The profile is written with Gamma(-1/2, s^2/4) = 4 F3(s).
    return 4 * profile.amplitude;
  }

  double PointSink::strength(double time) const
  {
    return 4 * std::numbers::pi * profile.solid.conductivity * amplitude()
           * std::sqrt(profile.solid.diffusivity * time);
  }

  double PointSink::energy(double time) const
  {
    return 2. / 3. * time * strength(time);
  }

  std::string PointSink::description() const
  {
    return fmt::format("point sink that removes {:.16g} W/s^(1/2) sqrt(t), far {:.12g}, "
                       "lambda = {:.12g}",
                       strength(1), profile.distant, profile.lambda);
  }
} // namespace meltfront::cases
