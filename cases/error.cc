#include <cases/error.h>

#include <fmt/format.h>

namespace meltfront::cases
{
  NumericalError::NumericalError(const std::string &method, long step, double time,
                                 const std::string &quantity, const std::string &problem)
    : std::runtime_error(fmt::format("{}, step {}, t = {:.6g}: {} {}", method, step, time,
                                     quantity, problem))
    , method(method)
    , step(step)
    , time(time)
    , quantity(quantity)
  {
  }
} // namespace meltfront::cases
