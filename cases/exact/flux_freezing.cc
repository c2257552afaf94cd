#include <cases/error.h>
#include <cases/exact/check_material.h>
#include <cases/exact/flux_freezing.h>
#include <cases/exact/heat_quadrature.h>

#include <boost/math/special_functions/factorials.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    constexpr int highest = 24;                  ///< power of tau that is kept
    constexpr int derivatives = highest / 2 + 1; ///< in the front's Taylor series

    using Series = std::vector<double>; ///< coefficients of the powers of tau

    Series power(int n, double factor = 1)
    {
      Series result(highest + 1);
      if(n <= highest)
        result[n] = factor;
      return result;
    }

    void add(Series &sum, const Series &term, double factor, int shift = 0)
    {
      for(int n = 0; n + shift <= highest; ++n)
        sum[n + shift] += factor * term[n];
    }

    Series product(const Series &a, const Series &b)
    {
      Series result(highest + 1);
      for(int n = 0; n <= highest; ++n)
        add(result, b, a[n], n);
      return result;
    }

    double value(const Series &series, double tau)
    {
      double result = 0;
      for(int n = highest; n >= 0; --n)
        result = result * tau + series[n];
      return result;
    }

    /** Gamma(n/2 + 1)/Gamma((n - j)/2 + 1): what j derivatives of W_n leave at x = 0, and
     * j/2 derivatives in time of tau^n. */
    double falling(int n, int j)
    {
      const int twice = n - j + 2; // of the argument of the lower function
      if(twice <= 0 && twice % 2 == 0)
        return 0; // a pole of it
      return boost::math::tgamma(n / 2. + 1) / boost::math::tgamma(twice / 2.);
    }

    double inverse_factorial(int n)
    {
      return 1 / boost::math::factorial<double>(n);
    }

    /** Values and slopes at the front of the sums over n. */
    struct AtFront
    {
      Series value, slope;
    };

    /**
     * Taylor's series at the front s = tau sigma of sum_n c_n P_n, where the derivative j
     * of P_n at x = 0 is factor^(j/step) falling(n, j) tau^(n - j) for multiples j of
     * step, 0 for others; the value without c_n P_n(0).
     */
    AtFront sum_at_front(const Series &coefficients, const Series &sigma, int step,
                         double factor)
    {
      AtFront sum{power(0, 0), power(0, 0)};
      Series before = power(0, 0), now = power(0); // powers j - 1 and j of sigma
      double scale = 1;
      for(int j = 1; j <= derivatives; ++j)
      {
        before = now;
        now = product(now, sigma);
        if(j % step != 0)
          continue;
        scale *= factor;
        Series weighted = coefficients;
        for(int n = 0; n <= highest; ++n)
          weighted[n] *= falling(n, j) * scale;
        add(sum.value, product(weighted, now), inverse_factorial(j));
        const Series slope = product(weighted, before);
        for(int n = 1; n <= highest; ++n)
          sum.slope[n - 1] += inverse_factorial(j - 1) * slope[n];
      }
      return sum;
    }

    const Material &checked(const Material &material)
    {
      check_material(material, "freezing under a flux");
      require_equal_densities(material, "freezing under a flux");
      return material;
    }
  } // namespace

  FluxFreezing::FluxFreezing(const Material &material, double length, double flux,
                             double far_temperature, double start_time)
    : material(checked(material))
    , length(length)
    , flux(flux)
    , far_temperature(far_temperature)
    , start(start_time)
    , time_scale(length * length / material.liquid.diffusivity())
  {
    if(!(length > 0 && flux > 0 && std::isfinite(flux)))
      throw InputError("freezing under a flux: needs a length and a flux greater than 0");
    if(!(onset() > start))
      throw InputError(fmt::format(
          "freezing under a flux: the wall starts at {:.6g}, not above the melting "
          "temperature",
          far_temperature - flux * length / (2 * material.liquid.conductivity)));
    find_coefficients();
  }

  double FluxFreezing::onset() const
  {
    const double drop = far_temperature - material.melting_temperature;
    return start
           + time_scale * (drop * material.liquid.conductivity / (flux * length) - 0.5);
  }

  double FluxFreezing::end_time() const
  {
    return onset() + time_scale * last_clock * last_clock;
  }

  void FluxFreezing::find_coefficients()
  {
    const double stefan = material.solid.density * material.latent_heat
                          * material.liquid.diffusivity() / (flux * length);
    const double slowness = material.liquid.diffusivity() / material.solid.diffusivity();
    front_series = layer_series = wall_series = power(0, 0);
    // Each round sets at least one more coefficient of each series right.
    for(int round = 0; round <= highest; ++round)
    {
      Series sigma(front_series.begin() + 1, front_series.end());
      sigma.push_back(0);
      const AtFront layer = sum_at_front(layer_series, sigma, 1, -1);
      const AtFront ice = sum_at_front(wall_series, sigma, 2, slowness);
      Series speed = ice.slope;
      add(speed, layer.slope, -1);
      add(speed, front_series, 1);

      layer_series = power(2);
      add(layer_series, front_series, -1);
      add(layer_series, product(front_series, front_series), 0.5);
      add(layer_series, layer.value, -1);
      wall_series = power(0, 0);
      add(wall_series, front_series, -1);
      add(wall_series, ice.value, -1);
      for(int n = 3; n <= highest; ++n)
        front_series[n] = 2 * speed[n - 2] / (n * stefan);
    }
    // The layer's tail is 1e-17 at the insulated wall; the last terms are round-off.
    last_clock = 0.08;
    const auto unresolved = [this]
    {
      double tail = 0;
      for(int n = highest - 2; n <= highest; ++n)
        tail = std::max(tail, std::abs(front_series[n]) * std::pow(last_clock, n - 3));
      return tail > 1e-16 * front_series[3];
    };
    while(unresolved())
      last_clock *= 0.9;
  }

  std::string FluxFreezing::description() const
  {
    return fmt::format("freezing under the flux {:.12g} from t = {:.12g} on", flux,
                       onset());
  }

  Symmetry FluxFreezing::symmetry() const
  {
    return Symmetry::planar;
  }

  double FluxFreezing::start_time() const
  {
    return start;
  }

  double FluxFreezing::clock(double time) const
  {
    const double slack = 1e-9 * (end_time() - start);
    if(!(time >= start - slack && time <= end_time() + slack))
      throw InputError(fmt::format("freezing under a flux: time {} is outside {} ... {}",
                                   time, start, end_time()));
    return std::sqrt(std::max(time - onset(), 0.) / time_scale);
  }

  double FluxFreezing::front(double time) const
  {
    return length * value(front_series, clock(time));
  }

  double FluxFreezing::scaled_solid(double x, double tau) const
  {
    const double slowness = material.liquid.diffusivity() / material.solid.diffusivity();
    double sum = x, scale = 1;
    for(int j = 0; j <= derivatives; j += 2)
    {
      double derivative = 0;
      for(int n = 3; n <= highest; ++n)
        derivative += wall_series[n] * falling(n, j) * std::pow(tau, n - j);
      sum += scale * derivative * std::pow(x, j) * inverse_factorial(j);
      scale *= slowness;
    }
    return sum;
  }

  double FluxFreezing::scaled_liquid(double x, double tau) const
  {
    // Integrals of erfc by their recurrence forwards: its absolute error is round-off.
    const double eta = x / (2 * tau);
    double before = 2 / std::sqrt(std::numbers::pi) * std::exp(-eta * eta);
    double now = std::erfc(eta), scale = 1, sum = x - x * x / 2 - tau * tau;
    for(int n = 1; n <= highest; ++n)
    {
      const double next = (before / 2 - eta * now) / n;
      before = now;
      now = next;
      scale *= 2 * tau;
      sum += layer_series[n] * scale * boost::math::tgamma(n / 2. + 1) * now;
    }
    return sum;
  }

  double FluxFreezing::temperature(double coordinate, double time) const
  {
    const double x = std::min(coordinate / length, 1.), tau = clock(time);
    const double liquid_scale = flux * length / material.liquid.conductivity;
    if(tau == 0)
      return far_temperature
             - liquid_scale * ((1 - x) * (1 - x) / 2 + (time - start) / time_scale);
    if(x < value(front_series, tau))
      return material.melting_temperature
             + flux * length / material.solid.conductivity
                   * std::min(scaled_solid(x, tau), 0.);
    return material.melting_temperature
           + liquid_scale * std::max(scaled_liquid(x, tau), 0.);
  }

  double FluxFreezing::heat_content(double lower, double upper, double time) const
  {
    const double split = std::clamp(front(time), lower, upper);
    const double layer = length * std::max(clock(time), 0.01);
    const auto excess
        = [&](double x) { return temperature(x, time) - material.melting_temperature; };
    return material.solid.volumetric_heat_capacity()
               * integrate_panels(Symmetry::planar, lower, split, excess,
                                  [&](double) { return length; })
           + material.liquid.density * material.latent_heat * (upper - split)
           + material.liquid.volumetric_heat_capacity()
                 * integrate_panels(Symmetry::planar, split, upper, excess,
                                    [&](double) { return layer; });
  }
} // namespace meltfront::cases
