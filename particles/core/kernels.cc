#include <cases/error.h>
#include <particles/core/kernels.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** The shape that a name means in a dimension: on a line Wendland's functions are
     * others. */
    KernelShape shape_in(KernelShape shape, int dimension)
    {
      const auto &names = smoothing_kernel_names();
      if(std::find(names.begin(), names.end(), kernel_name(shape)) == names.end())
        throw cases::Refusal(fmt::format(
            "'{}' is no smoothing kernel: its support has no settled relation "
            "to a smoothing length; {} have one",
            kernel_name(shape), fmt::join(names, ", ")));
      if(dimension > 1)
        return shape;
      switch(shape)
      {
      case KernelShape::wendland_c2:
        return KernelShape::efg_quartic;
      case KernelShape::wendland_c4:
        return KernelShape::wendland_c4_line;
      case KernelShape::wendland_c6:
        return KernelShape::wendland_c6_line;
      default:
        return shape;
      }
    }

    double power(double base, int exponent)
    {
      double result = 1;
      for(int i = 0; i < exponent; ++i)
        result *= base;
      return result;
    }
  } // namespace

  const std::vector<std::string> &smoothing_kernel_names()
  {
    static const std::vector<std::string> names{
        "cubic_spline", "quintic_spline", "wendland_c2", "wendland_c4", "wendland_c6"};
    return names;
  }

  SmoothingKernel::SmoothingKernel(KernelShape shape, int dimension,
                                   double smoothing_length)
    : h(smoothing_length)
    , kernel(shape_in(shape, dimension), dimension,
             (shape == KernelShape::quintic_spline ? 3 : 2) * smoothing_length)
  {
  }

  double SmoothingKernel::value(double distance) const
  {
    return kernel.value(distance);
  }

  double SmoothingKernel::radial_derivative_over_distance(double distance) const
  {
    return kernel.derivative_over_distance(distance);
  }

  double SmoothingKernel::support() const
  {
    return kernel.dilation();
  }

  double SmoothingKernel::smoothing_length() const
  {
    return h;
  }

  int SmoothingKernel::dimension() const
  {
    return kernel.dimension();
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
