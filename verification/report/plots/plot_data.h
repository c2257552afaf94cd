#ifndef meltfront_verification_report_plots_plot_data_h
#define meltfront_verification_report_plots_plot_data_h

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Most points that a curve over time or space is drawn through. */
  inline constexpr std::size_t most_points = 240;

  /** Indices of at most `most` entries, evenly spread, first and last among them. */
  std::vector<std::size_t> thinned(std::size_t size, std::size_t most = most_points);

  /** An entry, NaN beyond the end. */
  inline double entry(const std::vector<double> &values, std::size_t i)
  {
    return i < values.size() ? values[i] : std::nan("");
  }

  /** `quantity (unit)`, or the quantity alone. */
  std::string with_unit(const std::string &quantity, const std::string &unit);
} // namespace meltfront::verification

#endif
