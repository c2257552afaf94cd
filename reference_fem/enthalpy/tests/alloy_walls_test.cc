// Alloys whose walls exchange heat with their surroundings.

#include <cases/exact/mushy_layer.h>
#include <reference_fem/enthalpy/tests/alloy_support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double absolute_zero = -273.15, coefficient = 30;

    /** Heat transfer with a coefficient at a temperature of the wall, or radiation as
     * strong there. */
    Boundary exchanging(BoundaryKind kind, double strength, double at_wall)
    {
      Boundary boundary;
      boundary.kind = kind;
      boundary.heat_transfer_coefficient = strength;
      boundary.absolute_zero = absolute_zero;
      boundary.emission_coefficient
          = strength / (4 * std::pow(at_wall - absolute_zero, 3));
      boundary.value = Field::uniform(at_wall);
      return boundary;
    }

    /** From 3 h 40 min on surroundings take just the heat that keeps the wall of a mushy
     * layer at its temperature. */
    struct LayerScene
    {
      explicit LayerScene(BoundaryKind kind)
        : scene(melt(0.5, start_temperature, 91800))
        , layer(std::make_shared<const MushyLayer>(scene.material, *scene.alloy,
                                                   std::vector<double>{bulk}, wall,
                                                   start_temperature))
      {
        scene.start_time = 13200;
        Boundary boundary = exchanging(kind, coefficient, wall);
        const double taken = layer->wall_heat(1); // grows as the root of time
        const double absolute = std::pow(wall - absolute_zero, 4);
        boundary.value = {
            "", [=](const Position &, double time)
            {
              const double flux = taken / (2 * std::sqrt(time));
              return kind == BoundaryKind::heat_transfer
                         ? wall + flux / coefficient
                         : absolute_zero
                               + std::pow(absolute + flux / boundary.emission_coefficient,
                                          0.25);
            }};
        set_boundary(scene, Side::x_min, boundary);
        start_from(scene, layer);
        set_boundary(scene, Side::x_max, exact_wall(layer));
      }

      double error(const RunRecord &record) const
      {
        double sum = 0;
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          sum += std::pow(
              record.temperature[i]
                  - layer->temperature(record.positions[0][i], scene.end_time),
              2);
        return std::sqrt(sum / record.temperature.size());
      }

      Scene scene;
      std::shared_ptr<const MushyLayer> layer;
    };

    TEST(AlloyWalls, KeepTheMushyLayer)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::heat_transfer, BoundaryKind::radiation})
      {
        const LayerScene of(kind);
        const std::vector<int> n{30, 60, 120, 240};
        std::vector<double> errors;
        for(const int cells : n)
        {
          const RunRecord record = run(of.scene, cells);
          expect_closed(record);
          errors.push_back(of.error(record));
        }
        EXPECT_LE(errors.back(), 2e-3);
        EXPECT_GE(fitted_order(n, errors), 1.5);
      }
    }

    // Strong exchange holds the wall at the ambient temperature, above and below the
    // eutectic one, while solute spreads.
    TEST(AlloyWalls, HoldTheirTemperatureWhereTheExchangeIsStrong)
    {
      for(const BoundaryKind kind :
          {BoundaryKind::heat_transfer, BoundaryKind::radiation})
        for(const double ambient : {wall, -30.})
        {
          Scene held = melt(0.2, start_temperature, 13200);
          held.alloy->solutes[0].diffusivity = diffusivity;
          held.alloy->eutectic_temperature = -17.7;
          Scene strong = held;
          set_boundary(held, Side::x_min, fixed_wall(ambient));
          set_boundary(strong, Side::x_min, exchanging(kind, 2e4, ambient));
          const RunRecord a = run(held, 60), b = run(strong, 60);
          expect_closed(b);
          for(std::size_t i = 1; i < a.temperature.size(); ++i)
            EXPECT_NEAR(a.temperature[i], b.temperature[i], 0.1) << i;
          EXPECT_NEAR(total_solid(a), total_solid(b), 0.01 * total_solid(a));
        }
    }

    // Surroundings that swing from above the liquidus to below the eutectic temperature
    // freeze and melt a corner of two salts.
    TEST(AlloyWalls, FreezeAndMelt)
    {
      Scene scene = box(solvent(), 2, {}, {0.1, 0.06, 0}, 4, 20000);
      scene.alloy.emplace();
      scene.alloy->solutes = {{"first", slope}, {"second", 30}};
      scene.alloy->eutectic_temperature = -17.7;
      scene.initial.concentration
          = {Field::uniform(0.06), along_x([](double x) { return 0.02 + 0.2 * x; })};
      Boundary wind = exchanging(BoundaryKind::heat_transfer, 300, -10);
      wind.value = {"", [](const Position &, double time)
                    { return -10 - 30 * std::sin(time / 1500); }};
      set_boundary(scene, Side::x_min, wind);
      set_boundary(scene, Side::y_max, exchanging(BoundaryKind::radiation, 10, -60));
      const RunRecord record = run(scene, 24);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
      EXPECT_LE(record.worst_solute_defect, 1e-13);
      EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
      const auto [low, high]
          = std::minmax_element(record.temperature.begin(), record.temperature.end());
      EXPECT_GE(*low, -60);
      EXPECT_LE(*high, 20);
      EXPECT_GT(total_solid(record), 1e-4);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
