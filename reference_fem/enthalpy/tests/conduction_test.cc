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

    Material without_latent_heat()
    {
      Material material;
      material.latent_heat = 0;
      material.melting_temperature = -10;
      return material;
    }

    Field cosine(int dimension)
    {
      return {"cosine",
              [dimension](const Position &p, double)
              {
                double value = 1;
                for(int d = 0; d < dimension; ++d)
                  value *= std::cos(pi * p[d]);
                return value;
              },
              false};
    }

    /** The slowest mode of the insulated unit box, which falls as exp(-dimension pi^2 t).
     */
    Scene mode(int dimension, double end)
    {
      Scene scene = dimension == 1
                        ? slab(without_latent_heat(), 1, 0, 0, end)
                        : box(without_latent_heat(), dimension, {}, {1, 1, 1}, 0, end);
      scene.initial.temperature = cosine(dimension);
      return scene;
    }

    /** Largest deviation from the mode with the given factor. */
    double deviation(const RunRecord &record, int dimension, double factor)
    {
      double largest = 0;
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
      {
        Position p{};
        for(int d = 0; d < dimension; ++d)
          p[d] = record.positions[d][i];
        largest = std::max(largest, std::abs(record.temperature[i]
                                             - factor * cosine(dimension).value(p, 0)));
      }
      return largest;
    }

    TEST(Conduction, IsOfSecondOrderInSpace)
    {
      const double end = 0.02;
      for(const int dimension : {1, 2})
      {
        std::vector<int> n{8, 16, 32, 64};
        std::vector<double> errors;
        for(const int cells : n)
        {
          const RunRecord record = run(mode(dimension, end), cells, {{"steps", "2000"}});
          errors.push_back(
              deviation(record, dimension, std::exp(-dimension * pi * pi * end)));
          EXPECT_LE(record.worst_budget_defect(), 1e-12);
        }
        EXPECT_NEAR(fitted_order(n, errors), 2, 0.05) << dimension << "D";
      }
    }

    TEST(Conduction, HasTheOrderOfItsTimeScheme)
    {
      const double end = 0.1;
      const int cells = 32;
      // The mode is one of the semi-discrete problem too, so that space adds no error.
      const double rate = 4. * cells * cells * std::pow(std::sin(pi / (2 * cells)), 2);
      for(const auto &[scheme, order] :
          {std::pair{"backward-euler", 1.}, std::pair{"bdf2", 2.}})
      {
        const std::vector<int> steps{20, 40, 80, 160, 320};
        std::vector<double> errors;
        for(const int count : steps)
          errors.push_back(deviation(run(mode(1, end), cells,
                                         {{"steps", std::to_string(count)},
                                          {"time_scheme", scheme},
                                          {"start_halvings", "0"}}),
                                     1, std::exp(-rate * end)));
        EXPECT_NEAR(fitted_order(steps, errors), order, 0.06) << scheme;
      }
    }

    TEST(Conduction, TakesOneIterationWhereThePhasesAreEqual)
    {
      const RunRecord record = run(mode(1, 0.1), 32);
      EXPECT_EQ(record.cost.solver_iterations, record.cost.steps);
      EXPECT_TRUE(record.cost.effects.empty());
    }

    TEST(Conduction, ConvergesWithUnequalPhasesWithoutLatentHeat)
    {
      Material material = without_latent_heat();
      material.melting_temperature = 0;
      material.liquid.conductivity = 5;
      material.liquid.specific_heat_capacity = 0.3;
      Scene scene = slab(material, 1, 0, 0, 0.1);
      scene.initial.temperature = cosine(1);
      std::vector<int> n{16, 32, 64, 128};
      std::vector<double> errors;
      const RunRecord reference = run(scene, 1024, {{"steps", "1600"}});
      for(const int cells : n)
      {
        const RunRecord record = run(scene, cells, {{"steps", "1600"}});
        const std::size_t stride = 1024 / cells;
        double largest = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          largest = std::max(largest, std::abs(record.temperature[i]
                                               - reference.temperature[i * stride]));
        errors.push_back(largest);
        EXPECT_EQ(record.cost.capped_steps, 0);
        EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
      }
      EXPECT_GE(fitted_order(n, errors), 1.6);
    }

    TEST(WallFlux, BringsExactlyItsHeat)
    {
      for(const int dimension : {1, 2})
      {
        Scene scene = slab(without_latent_heat(), 2, 0, 0, 0.5);
        set_boundary(scene, Side::x_max, flux_wall(3));
        const RunRecord record
            = run(scene, 20, {{"dimension", std::to_string(dimension)}});
        EXPECT_NEAR(record.heat.boundary, 1.5, 1e-12);
        EXPECT_NEAR(record.heat.stored - record.heat.initial, 1.5, 1e-11);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
      }
    }

    TEST(WallFlux, DrivesTheSteadyProfile)
    {
      Scene scene = slab(without_latent_heat(), 1, 0, 0, 20);
      set_boundary(scene, Side::x_min, fixed_wall(4));
      set_boundary(scene, Side::x_max, flux_wall(-2));
      const RunRecord record = run(scene, 16);
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
        EXPECT_NEAR(record.temperature[i], 4 - 2 * record.positions[0][i], 1e-10);
    }

    TEST(Periodic, ModeMovesThroughTheSide)
    {
      Scene scene = box(without_latent_heat(), 2, {}, {1, 1, 0}, 0, 0.01);
      for(const Side side : {Side::x_min, Side::x_max})
        set_boundary(scene, side, {BoundaryKind::periodic, {}, false});
      // Not even about the side: an insulated wall would bend it.
      scene.initial.temperature
          = {"sine", [](const Position &p, double) { return std::sin(2 * pi * p[0]); },
             false};
      const RunRecord record = run(scene, 64, {{"steps", "200"}});
      const double factor = std::exp(-4 * pi * pi * 0.01);
      double volume = 0;
      for(std::size_t i = 0; i < record.temperature.size(); ++i)
      {
        EXPECT_NEAR(record.temperature[i],
                    factor * std::sin(2 * pi * record.positions[0][i]), 1e-3);
        volume += record.weights[i];
      }
      EXPECT_NEAR(volume, 1, 1e-12);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
