#include <verification/report/plots/plot_data.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  std::vector<std::size_t> thinned(std::size_t size, std::size_t most)
  {
    std::vector<std::size_t> indices;
    for(std::size_t i = 0; i < std::min(size, most); ++i)
      indices.push_back(size <= most ? i : i * (size - 1) / (most - 1));
    return indices;
  }

  std::string with_unit(const std::string &quantity, const std::string &unit)
  {
    return unit.empty() ? quantity : fmt::format("{} ({})", quantity, unit);
  }
} // namespace meltfront::verification
