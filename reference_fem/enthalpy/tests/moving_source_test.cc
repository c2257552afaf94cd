#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double pi = std::numbers::pi;
    constexpr double diffusivity = 0.2, pulse = 0.02, end = 0.05;

    double energy_until(double t)
    {
      const double within = std::min(t, pulse);
      return within - pulse / (2 * pi) * std::sin(2 * pi * within / pulse);
    }

    Position place(double t)
    {
      return {-0.23 + 20 * t, 0.11 * std::sin(60 * t), 0};
    }

    /** A line whose heat comes in a pulse while it moves through a plate. */
    Scene plate()
    {
      Material material;
      material.latent_heat = 0;
      material.solid.conductivity = material.liquid.conductivity = diffusivity;
      Scene scene = box(material, 2, {-1, -1, 0}, {1, 1, 0}, 0, end);
      scene.sources = {{.position = place(0),
                        .expression = "pulse",
                        .power = [](double t)
                        { return t < pulse ? 1 - std::cos(2 * pi * t / pulse) : 0; },
                        .energy = energy_until,
                        .path = Path{"path", place}}};
      return scene;
    }

    /** The sum of what a line leaves at each moment, in an unbounded plane. */
    double temperature(const Position &p)
    {
      constexpr int parts = 2000;
      double sum = 0;
      for(int i = 0; i < parts; ++i)
      {
        const double t = pulse * (i + 0.5) / parts;
        const Position from = place(t);
        const double heat
            = energy_until(pulse * (i + 1) / parts) - energy_until(pulse * i / parts);
        const double spread = 4 * diffusivity * (end - t);
        sum += heat / (pi * spread)
               * std::exp(-(std::pow(p[0] - from[0], 2) + std::pow(p[1] - from[1], 2))
                          / spread);
      }
      return sum;
    }

    double error(int n, const std::string &steps)
    {
      const RunRecord record = run(plate(), n, {{"steps", steps}});
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
      EXPECT_NEAR(record.heat.sources, energy_until(end), 1e-15);
      double sum = 0, square = 0;
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
      {
        const double exact = temperature(record.place(i));
        sum += record.weights[i] * std::pow(record.temperature[i] - exact, 2);
        square += record.weights[i] * exact * exact;
      }
      return std::sqrt(sum / square);
    }

    TEST(MovingSource, HeatIsLaidAlongThePath)
    {
      const std::vector<int> cells{16, 32, 64};
      std::vector<double> errors;
      for(const int n : cells)
        errors.push_back(error(n, std::to_string(4 * n)));
      EXPECT_LT(errors.back(), 1e-2);
      EXPECT_GT(fitted_order(cells, errors), 1.7);
      // The source crosses three cells in a step of these.
      const double of_long_steps = error(64, "50");
      EXPECT_LT(of_long_steps, 2e-2);
    }

    /** A path that stays repeats the source that does not move. */
    TEST(MovingSource, ThatStaysIsASteadyOne)
    {
      Scene moving = plate(), steady = plate();
      moving.sources[0].path->position = [](double) { return place(0.01); };
      moving.sources[0].position = steady.sources[0].position = place(0.01);
      steady.sources[0].path.reset();
      const RunRecord of_moving = run(moving, 24), of_steady = run(steady, 24);
      for(std::size_t i = 0; i < of_steady.temperature.size(); ++i)
        EXPECT_NEAR(of_moving.temperature[i], of_steady.temperature[i], 1e-11);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
