#include <cases/error.h>
#include <particles/core/kernels.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    using std::numbers::pi;

    constexpr double power(double base, int exponent)
    {
      double result = 1;
      for(int i = 0; i < exponent; ++i)
        result *= base;
      return result;
    }

    /** Norm for unit integral; rows: cubic, quintic, C2, C4, C6; columns: 1D, 2D, 3D. */
    constexpr double norms[5][3] = {{2. / 3, 10 / (7 * pi), 1 / pi},
                                    {1. / 120, 7 / (478 * pi), 1 / (120 * pi)},
                                    {5. / 4, 7 / pi, 21 / (2 * pi)},
                                    {3. / 2, 9 / pi, 495 / (32 * pi)},
                                    {55. / 32, 78 / (7 * pi), 1365 / (64 * pi)}};

    double cubic(double q)
    {
      if(q < 1)
        return 1 + q * q * (-1.5 + 0.75 * q);
      return 0.25 * power(2 - q, 3);
    }

    double cubic_slope(double q)
    {
      return q < 1 ? -3 + 2.25 * q : -0.75 * power(2 - q, 2) / q;
    }

    double quintic(double q)
    {
      return power(3 - q, 5) - 6 * power(std::max(2 - q, 0.), 5)
             + 15 * power(std::max(1 - q, 0.), 5);
    }

    double quintic_slope(double q)
    {
      if(q < 1)
        return -120 + q * q * (120 - 50 * q);
      return -5 * (power(3 - q, 4) - 6 * power(std::max(2 - q, 0.), 4)) / q;
    }

    double wendland(KernelShape shape, bool line, double q)
    {
      const double p = 1 - q;
      switch(shape)
      {
      case KernelShape::wendland_c2:
        return line ? power(p, 3) * (1 + 3 * q) : power(p, 4) * (1 + 4 * q);
      case KernelShape::wendland_c4:
        return line ? power(p, 5) * (1 + q * (5 + 8 * q))
                    : power(p, 6) * (1 + q * (6 + 35. / 3 * q));
      default:
        return line ? power(p, 7) * (1 + q * (7 + q * (19 + 21 * q)))
                    : power(p, 8) * (1 + q * (8 + q * (25 + 32 * q)));
      }
    }

    double wendland_slope(KernelShape shape, bool line, double q)
    {
      const double p = 1 - q;
      switch(shape)
      {
      case KernelShape::wendland_c2:
        return line ? -12 * power(p, 2) : -20 * power(p, 3);
      case KernelShape::wendland_c4:
        return line ? -14 * power(p, 4) * (1 + 4 * q)
                    : -56. / 3 * power(p, 5) * (1 + 5 * q);
      default:
        return line ? -6 * power(p, 6) * (3 + q * (18 + 35 * q))
                    : -22 * power(p, 7) * (1 + q * (7 + 16 * q));
      }
    }

    bool is_wendland(KernelShape shape)
    {
      return shape != KernelShape::cubic_spline && shape != KernelShape::quintic_spline;
    }
  } // namespace

  const std::vector<std::string> &kernel_names()
  {
    static const std::vector<std::string> names{
        "cubic_spline", "quintic_spline", "wendland_c2", "wendland_c4", "wendland_c6"};
    return names;
  }

  KernelShape kernel_shape(const std::string &name)
  {
    const auto &names = kernel_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if(found == names.end())
      throw cases::InputError(fmt::format("there is no kernel '{}'; there are {}", name,
                                          fmt::join(names, ", ")));
    return static_cast<KernelShape>(found - names.begin());
  }

  SmoothingKernel::SmoothingKernel(KernelShape shape, int dimension,
                                   double smoothing_length)
    : shape(shape)
    , dim(dimension)
    , h(smoothing_length)
    , scale(is_wendland(shape) ? 2 * smoothing_length : smoothing_length)
  {
    norm = norms[static_cast<int>(shape)][dim - 1] / power(scale, dim);
  }

  double SmoothingKernel::value(double distance) const
  {
    if(distance >= support())
      return 0;
    const double q = distance / scale;
    switch(shape)
    {
    case KernelShape::cubic_spline:
      return norm * cubic(q);
    case KernelShape::quintic_spline:
      return norm * quintic(q);
    default:
      return norm * wendland(shape, dim == 1, q);
    }
  }

  double SmoothingKernel::radial_derivative_over_distance(double distance) const
  {
    if(distance >= support())
      return 0;
    const double q = distance / scale;
    const double factor = norm / (scale * scale);
    switch(shape)
    {
    case KernelShape::cubic_spline:
      return factor * cubic_slope(q);
    case KernelShape::quintic_spline:
      return factor * quintic_slope(q);
    default:
      return factor * wendland_slope(shape, dim == 1, q);
    }
  }

  double SmoothingKernel::support() const
  {
    return shape == KernelShape::quintic_spline ? 3 * h : 2 * h;
  }

  double SmoothingKernel::smoothing_length() const
  {
    return h;
  }

  int SmoothingKernel::dimension() const
  {
    return dim;
  }

  double lattice_second_moment(const SmoothingKernel &kernel, double spacing)
  {
    const int d = kernel.dimension();
    const int reach = static_cast<int>(std::ceil(kernel.support() / spacing));
    const int reach_y = d > 1 ? reach : 0, reach_z = d > 2 ? reach : 0;
    double sum = 0;
    for(int i = -reach; i <= reach; ++i)
      for(int j = -reach_y; j <= reach_y; ++j)
        for(int k = -reach_z; k <= reach_z; ++k)
        {
          const double squared = spacing * spacing * (i * i + j * j + k * k);
          sum += kernel.radial_derivative_over_distance(std::sqrt(squared)) * squared;
        }
    return -sum * power(spacing, d) / d;
  }
} // namespace meltfront::particles
