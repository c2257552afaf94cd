#include <cases/error.h>
#include <particles/moab_integral/integral_moments.h>

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    constexpr int most_degree = 4;
    /** A centre nearer to a wall lies on it: what is between is lost in rounding. */
    constexpr double on_wall = 1e-12;
    constexpr int n_points = 20;
    using Rule = boost::math::quadrature::gauss<double, n_points>;

    /** Points and weights of Gauss's rule on [from, to]. */
    struct GaussRule
    {
      std::array<double, n_points> points, weights;

      GaussRule(double from, double to)
      {
        const double middle = (from + to) / 2, half = (to - from) / 2;
        for(int i = 0; i < n_points / 2; ++i)
        {
          const auto j = static_cast<std::size_t>(i);
          points[2 * j] = middle - half * Rule::abscissa()[j];
          points[2 * j + 1] = middle + half * Rule::abscissa()[j];
          weights[2 * j] = weights[2 * j + 1] = half * Rule::weights()[j];
        }
      }
    };

    /** Between these the shape is smooth enough for Gauss's rule. */
    std::vector<double> smooth_pieces(KernelShape shape)
    {
      switch(shape)
      {
      case KernelShape::cubic_spline:
        return {0, 0.5, 1};
      case KernelShape::quartic_spline:
        return {0, 0.2, 0.6, 1};
      case KernelShape::quintic_spline:
        return {0, 1. / 3, 2. / 3, 1};
      case KernelShape::bump: // an essential singularity at the edge
        return {0, 0.5, 0.75, 0.875, 0.9375, 0.96875, 1};
      default:
        return {0, 0.5, 1};
      }
    }

    double integer_power(double base, int exponent)
    {
      double result = 1;
      for(int i = 0; i < exponent; ++i)
        result *= base;
      return result;
    }

    /** Integrals of psi(r) r^p over a piece without a knot, p = first ... */
    void add_piece(KernelShape shape, int first, int degree, double from, double to,
                   std::array<double, most_degree + 1> &sums)
    {
      const GaussRule rule(from, to);
      std::array<double, n_points> psi;
      evaluate_shape(shape, rule.points, psi);
      for(int i = 0; i < n_points; ++i)
      {
        double term = rule.weights[i] * psi[i] * integer_power(rule.points[i], first);
        for(int p = 0; p <= degree; ++p, term *= rule.points[i])
          sums[static_cast<std::size_t>(p)] += term;
      }
    }
  } // namespace

  std::vector<Exponents> monomials(int dimension, int degree)
  {
    std::vector<Exponents> result;
    for(int total = 0; total <= degree; ++total)
      for(int second = 0; second <= (dimension > 1 ? total : 0); ++second)
        result.push_back({total - second, second});
    return result;
  }

  void evaluate_monomials(std::span<const Exponents> exponents,
                          const std::array<double, 2> &z, std::span<double> result)
  {
    for(std::size_t a = 0; a < exponents.size(); ++a)
      result[a]
          = integer_power(z[0], exponents[a][0]) * integer_power(z[1], exponents[a][1]);
  }

  KernelMoments::KernelMoments(KernelShape shape, int dimension, int degree)
    : shape(shape)
    , dim(dimension)
    , degree(degree)
    , powers(monomials(dimension, degree))
    , knots(smooth_pieces(shape))
  {
    if(dimension < 1 || dimension > 2 || degree < 0 || degree > most_degree)
      throw cases::InputError(fmt::format(
          "moments of a kernel up to degree {} in {} dimensions are not computed: the "
          "degree is at most {} and the dimension 1 or 2",
          degree, dimension, most_degree));
    at_knots.assign(knots.size(), {});
    for(std::size_t k = 1; k < knots.size(); ++k)
    {
      at_knots[k] = at_knots[k - 1];
      add_piece(shape, dim - 1, degree, knots[k - 1], knots[k], at_knots[k]);
    }
    whole.assign(powers.size(), 0);
    if(dim == 1)
      on_line({}, whole);
    else
      add_sector(0, 2 * std::numbers::pi, 0, 2, whole);
  }

  std::array<double, 5> KernelMoments::radial_integrals(int first, double end) const
  {
    std::size_t k = 0;
    while(k + 1 < knots.size() && knots[k + 1] <= end)
      ++k;
    std::array<double, 5> sums = at_knots[k];
    if(k + 1 < knots.size() && end > knots[k])
      add_piece(shape, first, degree, knots[k], end, sums);
    return sums;
  }

  void KernelMoments::evaluate(const ScaledBox &box, std::span<double> moments) const
  {
    bool cut = false;
    for(int d = 0; d < dim; ++d)
      cut = cut || box.lower[d] > -1 || box.upper[d] < 1;
    if(!cut)
      std::ranges::copy(whole, moments.begin());
    else if(dim == 1)
      on_line(box, moments);
    else
      in_plane(box, moments);
  }

  void KernelMoments::on_line(const ScaledBox &box, std::span<double> moments) const
  {
    const auto below = radial_integrals(0, std::clamp(-box.lower[0], 0., 1.));
    const auto above = radial_integrals(0, std::clamp(box.upper[0], 0., 1.));
    for(int a = 0; a <= degree; ++a)
      moments[a] = above[a] + (a % 2 == 0 ? 1 : -1) * below[a];
  }

  void KernelMoments::add_sector(double from, double to, double wall_angle,
                                 double wall_distance, std::span<double> moments) const
  {
    // Angles at which the ray's end passes a knot of the shape or doubles its length.
    std::vector<double> breaks{from, to};
    std::vector<double> radii = knots;
    for(double r = 2 * wall_distance; r > 0 && r < 1; r *= 2)
      radii.push_back(r);
    for(const double radius : radii)
      if(radius > wall_distance)
        for(const double sign : {-1., 1.})
          breaks.push_back(wall_angle + sign * std::acos(wall_distance / radius));
    std::erase_if(breaks, [&](double angle) { return angle < from || angle > to; });
    for(int quarter = 1; quarter < 4; ++quarter)
      breaks.push_back(from + (to - from) * quarter / 4);
    std::ranges::sort(breaks);
    for(std::size_t b = 1; b < breaks.size(); ++b)
    {
      const GaussRule rule(breaks[b - 1], breaks[b]);
      for(int i = 0; i < n_points; ++i)
      {
        const double across = std::cos(rule.points[i] - wall_angle);
        const double end
            = across > wall_distance ? std::min(1., wall_distance / across) : 1;
        const auto radial = radial_integrals(1, end);
        const std::array<double, 2> direction{std::cos(rule.points[i]),
                                              std::sin(rule.points[i])};
        for(std::size_t a = 0; a < powers.size(); ++a)
          moments[a] += rule.weights[i]
                        * radial[static_cast<std::size_t>(powers[a][0] + powers[a][1])]
                        * integer_power(direction[0], powers[a][0])
                        * integer_power(direction[1], powers[a][1]);
      }
    }
  }

  void KernelMoments::in_plane(const ScaledBox &box, std::span<double> moments) const
  {
    std::ranges::fill(moments, 0.);
    // Each wall is seen between two corners of the box; a box far beyond the support in
    // one direction is cut to twice the support, so that angles keep their precision.
    const double x0 = std::max(box.lower[0], -2.), x1 = std::min(box.upper[0], 2.);
    // The sign of a zero tells atan2 on which side of the cut the corner is.
    const double y0 = -std::abs(std::max(box.lower[1], -2.));
    const double y1 = std::min(box.upper[1], 2.);
    constexpr double pi = std::numbers::pi;
    const double corner[4] = {std::atan2(y0, x1), std::atan2(y1, x1), std::atan2(y1, x0),
                              std::atan2(y0, x0) + 2 * pi};
    const double angle[4] = {0, pi / 2, pi, 3 * pi / 2};
    const double distance[4] = {x1, y1, -x0, -y0};
    for(std::size_t wall = 0; wall < 4; ++wall)
    {
      const double to = wall < 3 ? corner[wall + 1] : corner[0] + 2 * pi;
      if(distance[wall] > on_wall && to > corner[wall])
        add_sector(corner[wall], to, angle[wall], distance[wall], moments);
    }
  }
} // namespace meltfront::particles
