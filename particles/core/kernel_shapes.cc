#include <cases/error.h>
#include <particles/core/kernel_formulas.h>
#include <particles/core/kernel_shapes.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    using kernel_formulas::pi;
    using kernel_formulas::with_formula;

    constexpr int infinitely = std::numeric_limits<int>::max();

    /** What is known of a shape besides its formula. */
    struct ShapeFacts
    {
      const char *name;
      int smoothness;  ///< k of C^k
      double norms[3]; ///< for a unit integral in 1D, 2D, 3D
    };

    /** In the order of the enumeration. The norms of the lowered Gaussians and of the
     * bump are computed with 30 digits. */
    constexpr ShapeFacts facts[]
        = {{"hat", 0, {1, 3 / pi, 3 / pi}},
           {"epanechnikov", 0, {3. / 4, 2 / pi, 15 / (8 * pi)}},
           {"biweight", 1, {15. / 16, 3 / pi, 105 / (32 * pi)}},
           {"triweight", 2, {35. / 32, 4 / pi, 315 / (64 * pi)}},
           {"cubic_spline", 2, {2, 60 / (7 * pi), 12 / pi}},
           {"efg_quartic", 2, {5. / 4, 5 / pi, 105 / (16 * pi)}},
           {"quartic_spline", 3, {2.5 / 24, 600 / (1199 * pi), 15.625 / (20 * pi)}},
           {"quintic_spline", 4, {1. / 40, 63 / (478 * pi), 9 / (40 * pi)}},
           {"wendland_c2", 2, {3. / 2, 7 / pi, 21 / (2 * pi)}},
           {"wendland_c4", 4, {27. / 16, 9 / pi, 495 / (32 * pi)}},
           {"wendland_c6", 6, {15. / 8, 78 / (7 * pi), 1365 / (64 * pi)}},
           {"cosine", 1, {1, 2 * pi / (pi * pi - 4), 3 * pi / (2 * (pi * pi - 6))}},
           {"half_cosine", 0, {pi / 4, pi / (4 * pi - 8), pi *pi / (8 * (pi * pi - 8))}},
           {"gaussian_3",
            0,
            {1.693104582528193596, 2.867974794683254845, 4.862581032530620215}},
           {"gaussian_2",
            0,
            {1.161138127529870109, 1.375923983076859971, 1.671536509569744555}},
           {"bump",
            infinitely,
            {0.8285688398691051517, 0.788573779712677226, 0.8340256392375334536}},
           {"wendland_c4_line", 4, {3. / 2, 36 / (5 * pi), 45 / (4 * pi)}},
           {"wendland_c6_line", 6, {55. / 32, 66 / (7 * pi), 2145 / (128 * pi)}}};

    const ShapeFacts &facts_of(KernelShape shape)
    {
      return facts[static_cast<int>(shape)];
    }
  } // namespace

  const std::vector<std::string> &kernel_names()
  {
    static const std::vector<std::string> names = []
    {
      std::vector<std::string> words;
      for(const ShapeFacts &shape : facts)
        words.emplace_back(shape.name);
      return words;
    }();
    return names;
  }

  const std::string &kernel_name(KernelShape shape)
  {
    return kernel_names()[static_cast<std::size_t>(shape)];
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

  int kernel_smoothness(KernelShape shape)
  {
    return facts_of(shape).smoothness;
  }

  double kernel_norm(KernelShape shape, int dimension)
  {
    if(dimension < 1 || dimension > 3)
      throw cases::InputError(
          fmt::format("a kernel has 1, 2 or 3 dimensions, not {}", dimension));
    return facts_of(shape).norms[dimension - 1];
  }

  Kernel::Kernel(KernelShape shape, int dimension, double dilation)
    : kernel_shape(shape)
    , dim(dimension)
    , support(dilation)
    , norm(kernel_norm(shape, dimension))
  {
    if(!(dilation > 0))
      throw cases::InputError(
          fmt::format("a kernel's dilation must be positive, not {:.6g} m", dilation));
    for(int d = 0; d < dim; ++d)
      norm /= support;
  }

  double Kernel::value(double distance) const
  {
    const double q = std::abs(distance) / support;
    if(q >= 1)
      return 0;
    return norm * with_formula(kernel_shape, [q](auto psi) { return psi.value(q); });
  }

  double Kernel::derivative(double distance) const
  {
    if(distance == 0 && kernel_shape != KernelShape::hat)
      return 0;
    return distance * derivative_over_distance(distance);
  }

  double Kernel::second_derivative(double distance) const
  {
    const double q = std::abs(distance) / support;
    if(q >= 1)
      return 0;
    return norm / (support * support)
           * with_formula(kernel_shape, [q](auto psi) { return psi.second(q); });
  }

  double Kernel::derivative_over_distance(double distance) const
  {
    const double q = std::abs(distance) / support;
    if(q >= 1)
      return 0;
    if(q == 0 && kernel_shape == KernelShape::hat)
      throw cases::Refusal("the kernel 'hat' has a kink at its centre, where W'(r)/r has "
                           "no limit; any other kernel has one");
    return norm / (support * support)
           * with_formula(kernel_shape, [q](auto psi) { return psi.slope_over_q(q); });
  }

  std::array<double, 3> Kernel::gradient(const std::array<double, 3> &x) const
  {
    const double distance = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    const double factor = derivative_over_distance(distance);
    return {factor * x[0], factor * x[1], factor * x[2]};
  }

  std::array<std::array<double, 3>, 3>
  Kernel::hessian(const std::array<double, 3> &x) const
  {
    const double squared = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const double distance = std::sqrt(squared);
    const double isotropic = derivative_over_distance(distance);
    const double radial
        = squared > 0 ? (second_derivative(distance) - isotropic) / squared : 0;
    std::array<std::array<double, 3>, 3> result{};
    for(int i = 0; i < dim; ++i)
      for(int j = 0; j < dim; ++j)
        result[i][j] = radial * x[i] * x[j] + (i == j ? isotropic : 0);
    return result;
  }

  void evaluate_shape(KernelShape shape, std::span<const double> q,
                      std::span<double> value)
  {
    with_formula(shape,
                 [&](auto psi)
                 {
                   for(std::size_t i = 0; i < q.size(); ++i)
                     value[i] = q[i] < 1 ? psi.value(q[i]) : 0;
                 });
  }

  void evaluate_shape(KernelShape shape, std::span<const double> q,
                      std::span<KernelProfile> profile)
  {
    with_formula(shape,
                 [&](auto psi)
                 {
                   for(std::size_t i = 0; i < q.size(); ++i)
                     profile[i] = q[i] < 1 ? KernelProfile{psi.value(q[i]),
                                                           psi.slope_over_q(q[i]),
                                                           psi.second(q[i])}
                                           : KernelProfile{};
                 });
  }
} // namespace meltfront::particles
