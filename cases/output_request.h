#ifndef meltfront_cases_output_request_h
#define meltfront_cases_output_request_h

#include <cases/position.h>

#include <vector>

namespace meltfront::cases
{
  /** A straight line along which temperatures are written. */
  struct OutputLine
  {
    Position from{}, to{}; ///< m
  };

  /** What a run writes beside its fields: values at points over time, and along lines. It
   * changes nothing of what is simulated or measured. */
  struct OutputRequest
  {
    std::vector<Position> probes; ///< m
    int probe_samples = 200;      ///< times over the run
    std::vector<OutputLine> lines;
    int line_points = 101;
    std::vector<double> line_times; ///< s, ascending; the end among them
  };

  /** Most probes, and most lines, of a case. */
  inline constexpr int most_probes = 40;
} // namespace meltfront::cases

#endif
