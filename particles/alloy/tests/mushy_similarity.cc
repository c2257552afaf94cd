#include <particles/alloy/tests/mushy_similarity.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    constexpr int n_steps = 2000;
  }

  MushySimilarity::MushySimilarity(const MushyLayer &layer)
    : layer(layer)
  {
    double low = 0.01, high = 3;
    while(high - low > 1e-15 * high)
    {
      const double middle = 0.5 * (low + high);
      if(middle == low || middle == high)
        break;
      // A thicker mush has a colder wall.
      (shoot(middle, false) > layer.wall ? low : high) = middle;
    }
    front_constant = 0.5 * (low + high);
    shoot(front_constant, true);
  }

  double MushySimilarity::solid_at(double temperature) const
  {
    return temperature < -layer.depression ? 1 + layer.depression / temperature : 0;
  }

  MushySimilarity::Slope MushySimilarity::slope(double eta, double temperature,
                                                double flux) const
  {
    const cases::PhaseProperties &s = layer.material.solid, &l = layer.material.liquid;
    const double solid = 1 + layer.depression / temperature;
    const double theta = std::min(layer.expansion * solid, 1.);
    const double conductivity = theta * s.conductivity + (1 - theta) * l.conductivity;
    const double difference = l.specific_heat_capacity - s.specific_heat_capacity;
    const double heat = layer.material.latent_heat
                        + (layer.constant_heat ? 0. : difference * temperature);
    const double capacity = solid * s.specific_heat_capacity
                            + (1 - solid) * l.specific_heat_capacity
                            + heat * layer.depression / (temperature * temperature);
    const double gradient = flux * l.conductivity / conductivity;
    return {gradient, -2 * eta * capacity / l.specific_heat_capacity * gradient};
  }

  double MushySimilarity::shoot(double lambda, bool keep)
  {
    double temperature = -layer.depression;
    double flux = (layer.far + layer.depression) * 2 / std::sqrt(std::numbers::pi)
                  * std::exp(-lambda * lambda) / std::erfc(lambda);
    const double h = -lambda / n_steps;
    for(int i = 0; i <= n_steps; ++i)
    {
      const double eta = lambda + i * h;
      const Slope k1 = slope(eta, temperature, flux);
      if(keep)
      {
        values.push_back(temperature);
        slopes.push_back(k1.temperature);
      }
      if(i == n_steps)
        break;
      const auto at = [&](double part, const Slope &k)
      {
        return slope(eta + part * h, temperature + part * h * k.temperature,
                     flux + part * h * k.flux);
      };
      const Slope k2 = at(0.5, k1), k3 = at(0.5, k2), k4 = at(1, k3);
      temperature += h / 6
                     * (k1.temperature + 2 * k2.temperature + 2 * k3.temperature
                        + k4.temperature);
      flux += h / 6 * (k1.flux + 2 * k2.flux + 2 * k3.flux + k4.flux);
    }
    return temperature;
  }

  double MushySimilarity::scale(double time) const
  {
    return std::sqrt(4 * layer.material.liquid.diffusivity() * time);
  }

  double MushySimilarity::front(double time) const
  {
    return front_constant * scale(time);
  }

  double MushySimilarity::in_mush(double eta) const
  {
    const double step = front_constant / n_steps;
    const double place = (front_constant - eta) / step;
    const int i = std::clamp(static_cast<int>(place), 0, n_steps - 1);
    const double s = place - i, r = 1 - s;
    return r * r * (1 + 2 * s) * values[i] + s * s * (1 + 2 * r) * values[i + 1]
           - step * s * r * (r * slopes[i] - s * slopes[i + 1]);
  }

  double MushySimilarity::temperature(double y, double time) const
  {
    const double eta = y / scale(time);
    if(eta < front_constant)
      return in_mush(eta);
    return layer.far
           - (layer.far + layer.depression) * std::erfc(eta) / std::erfc(front_constant);
  }

  double MushySimilarity::solid_fraction(double y, double time) const
  {
    return solid_at(temperature(y, time));
  }

  double MushySimilarity::solid_length(double time) const
  {
    double sum = 0;
    for(int i = 0; i <= n_steps; ++i)
      sum += (i == 0 || i == n_steps ? 1 : (i % 2 == 1 ? 4 : 2)) * solid_at(values[i]);
    return sum * front_constant / n_steps / 3 * scale(time);
  }
} // namespace meltfront::particles::testing
