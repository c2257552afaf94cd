#include <cases/exact/manufactured/front_area.h>

#include <array>
#include <cmath>
#include <numbers>

namespace meltfront::cases::manufactured
{
  namespace
  {
    /** Half the layer's thickness, in cells. */
    constexpr double half_width = 1.5;

    /** From the front, up to the square of the distance over its radius of curvature
     * where it is within the trusted range. */
    double distance(const FrontDerivatives &f, double trusted)
    {
      const double square = f.square_of_gradient(), plain = f.value / std::sqrt(square);
      if(!(std::abs(plain) < trusted))
        return plain;
      double bend = 0;
      for(int i = 0; i < 3; ++i)
        for(int j = 0; j < 3; ++j)
          bend += f.gradient[i] * f.hessian[i][j] * f.gradient[j];
      return plain * (1 + f.value * bend / (2 * square * square));
    }

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
    const double cell = (upper[0] - lower[0]) / (dimension == 3 ? 48 : 160);
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
          const FrontDerivatives f = family.second_derivatives(p, time);
          area += layer(distance(f, 2 * half_width * cell), half_width * cell);
        }
    return area * volume;
  }
} // namespace meltfront::cases::manufactured
