#include <verification/measure/formulas/square_law.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meltfront::verification
{
  SquareLaw square_law(std::span<const double> time, std::span<const double> front,
                       const double from)
  {
    constexpr int fewest = 10;
    std::vector<double> t, square;
    for(std::size_t i = 0; i < time.size(); ++i)
      if(std::isfinite(front[i]) && (!t.empty() || front[i] >= from))
      {
        t.push_back(time[i]);
        square.push_back(front[i] * front[i]);
      }
    SquareLaw law;
    law.points = static_cast<int>(t.size());
    if(law.points < fewest)
    {
      law.slope = law.r_squared = law.largest_error
          = std::numeric_limits<double>::quiet_NaN();
      return law;
    }
    const double n = law.points;
    double mean_t = 0, mean_square = 0;
    for(std::size_t i = 0; i < t.size(); ++i)
    {
      mean_t += t[i] / n;
      mean_square += square[i] / n;
    }
    double tt = 0, ts = 0, ss = 0;
    for(std::size_t i = 0; i < t.size(); ++i)
    {
      tt += (t[i] - mean_t) * (t[i] - mean_t);
      ts += (t[i] - mean_t) * (square[i] - mean_square);
      ss += (square[i] - mean_square) * (square[i] - mean_square);
    }
    law.slope = ts / tt;
    law.r_squared = ts * ts / (tt * ss);
    for(std::size_t i = 0; i < t.size(); ++i)
    {
      const double line = mean_square + law.slope * (t[i] - mean_t);
      law.largest_error
          = std::max(law.largest_error, std::abs(square[i] - line) / square.back());
    }
    return law;
  }
} // namespace meltfront::verification
