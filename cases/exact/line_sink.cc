#include <cases/exact/line_sink.h>
#include <cases/exact/sink_profile.h>

#include <fmt/format.h>

#include <numbers>

namespace meltfront::cases
{
  LineSink::LineSink(const Material &material, double lambda, double far_temperature)
    : RadialSimilarity(material,
                       sink_profile(2, material, lambda, far_temperature, "line sink"))
  {
  }

  double LineSink::strength() const
  {
    return 4 * std::numbers::pi * profile.solid.conductivity * profile.amplitude;
  }

  std::string LineSink::description() const
  {
    return fmt::format(
        "line sink that removes {:.16g} W/m, far {:.12g}, lambda = {:.12g}", strength(),
        profile.distant, profile.lambda);
  }
} // namespace meltfront::cases
