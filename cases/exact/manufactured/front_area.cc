#include <cases/exact/manufactured/front_area.h>

#include <array>
#include <cmath>
#include <numbers>

namespace meltfront::cases::manufactured
{
  namespace
  {
    /** Half the layer's thickness, in cells. */
    constexpr double half_width = 2.5;

    /** A layer of integral one about zero. */
    double layer(double distance, double width)
    {
      return std::abs(distance) < width
                 ? (1 + std::cos(std::numbers::pi * distance / width)) / (2 * width)
                 : 0;
    }
  } // namespace

  double front_area(const FrontFamily &family, double time)
  {
    const auto [lower, upper] = family.domain();
    const int dimension = family.dimension();
    const double cell = (upper[0] - lower[0]) / (dimension == 3 ? 40 : 160);
    std::array<int, 3> cells{1, 1, 1};
    double volume = 1;
    for(int d = 0; d < dimension; ++d)
    {
      cells[d] = static_cast<int>(std::lround((upper[d] - lower[d]) / cell));
      volume *= (upper[d] - lower[d]) / cells[d];
    }
    double area = 0;
    for(int i = 0; i < cells[0]; ++i)
      for(int j = 0; j < cells[1]; ++j)
        for(int k = 0; k < cells[2]; ++k)
        {
          Position p{};
          const std::array<int, 3> number{i, j, k};
          for(int d = 0; d < dimension; ++d)
            p[d] = lower[d] + (upper[d] - lower[d]) * (number[d] + 0.5) / cells[d];
          const FrontDerivatives f = family.derivatives(p, time);
          area += layer(f.value / std::sqrt(f.square_of_gradient()), half_width * cell);
        }
    return area * volume;
  }
} // namespace meltfront::cases::manufactured
