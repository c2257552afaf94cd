#include <cases/exact/planar_neumann.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    struct Planar
    {
      Scene scene;
      ExactPointer exact;
    };

    Planar normalised(bool started)
    {
      const Material material = normalised_material();
      const auto exact
          = std::make_shared<PlanarNeumann>(material, normalised_wall, normalised_far);
      Scene scene = started ? slab(material, 1, normalised_far, 0.01, 0.25)
                            : slab(material, 1, normalised_far, 0, 0.0568);
      set_boundary(scene, Side::x_min, fixed_wall(normalised_wall));
      set_boundary(scene, Side::x_max, exact_wall(exact));
      if(started)
        start_from(scene, exact);
      return {scene, exact};
    }

    Planar water_plane(double far)
    {
      const auto exact = std::make_shared<PlanarNeumann>(water(), -10, far);
      Scene scene = slab(water(), 1, far, 0, 86400);
      set_boundary(scene, Side::x_min, fixed_wall(-10));
      set_boundary(scene, Side::x_max, exact_wall(exact));
      return {scene, exact};
    }

    struct Study
    {
      std::vector<int> n;
      std::vector<double> front, front_end, temperature;
    };

    /** Runs over n, each held to the balance, the graph and no capped step. */
    Study study(const Planar &planar, const std::vector<int> &n,
                const OptionTexts &options = {})
    {
      Study result{n, {}, {}, {}};
      const double half = (planar.scene.start_time + planar.scene.end_time) / 2;
      for(const int cells : n)
      {
        const RunRecord record = run(planar.scene, cells, options, planar.exact.get());
        EXPECT_LE(record.worst_budget_defect(), 1e-13);
        EXPECT_LE(record.statistics.balance_defect, 1e-13);
        EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
        EXPECT_EQ(record.cost.capped_steps, 0);
        result.front.push_back(record.worst_front_error(half));
        result.front_end.push_back(record.final_front_error());
        result.temperature.push_back(record.temperature_error);
      }
      return result;
    }

    TEST(PlanarFreezing, StartedReachesItsTargets)
    {
      const Study result = study(normalised(true), {32, 64, 128, 256, 512, 1024});
      EXPECT_LE(result.front[3], 4e-4);
      EXPECT_LE(result.front[5], 8e-5);
      EXPECT_GE(fitted_order(result.n, result.front), 1.3);
      EXPECT_GE(fitted_order(result.n, result.temperature), 1.2);
    }

    TEST(PlanarFreezing, ColdStartReachesItsTargets)
    {
      const Study result = study(normalised(false), {32, 64, 128, 256, 512});
      EXPECT_LE(result.front_end[4], 2.5e-4);
      EXPECT_GE(fitted_order(result.n, result.front), 1.3);
      EXPECT_GE(fitted_order(result.n, result.temperature), 1.2);
    }

    TEST(PlanarFreezing, BackwardEulerIsOfFirstOrder)
    {
      const Study result = study(normalised(true), {64, 128, 256, 512, 1024},
                                 {{"time_scheme", "backward-euler"}});
      EXPECT_LE(result.front[4], 3e-4);
      EXPECT_GE(fitted_order(result.n, result.front), 0.9);
      const Study second = study(normalised(true), {1024});
      EXPECT_LT(second.front[0], result.front[4] / 2);
    }

    TEST(PlanarFreezing, Water)
    {
      const Study result = study(water_plane(10), {64, 128, 256, 512});
      EXPECT_LE(result.front[3], 5e-4);
      EXPECT_GE(fitted_order(result.n, result.front), 1.3);
    }

    TEST(PlanarFreezing, OnePhaseAtTheMeltingPoint)
    {
      const Study result = study(water_plane(0), {64, 128, 256, 512});
      EXPECT_LE(result.front[3], 4e-4);
      EXPECT_GE(fitted_order(result.n, result.front), 1.3);
    }

    TEST(PlanarFreezing, AnExactStartPlacesTheFrontInsideItsCell)
    {
      Planar planar = normalised(true);
      for(const double start : {0.01, 0.0123, 0.0151})
        for(const int n : {32, 64, 128})
        {
          planar.scene.start_time = start;
          const RunRecord record = run(planar.scene, n, {}, planar.exact.get());
          // The front's cell is an average too: the sensible heat of its solid, below
          // (gradient h) h/2, reads as latent heat. A point value would be h/2 off.
          const double h = 1. / n, gradient = 7;
          EXPECT_NEAR(record.front.front(), record.front_exact.front(),
                      gradient * h * h / 2);
        }
    }

    TEST(PlanarFreezing, MeltingIsItsMirrorImage)
    {
      Planar freezing = normalised(false);
      set_boundary(freezing.scene, Side::x_max, {});
      Scene melting = freezing.scene;
      melting.initial.temperature = Field::uniform(0.8);
      set_boundary(melting, Side::x_min, fixed_wall(2 - normalised_wall));
      const RunRecord cold = run(freezing.scene, 50);
      const RunRecord warm = run(melting, 50);
      ASSERT_EQ(cold.temperature.size(), warm.temperature.size());
      for(std::size_t i = 0; i < cold.temperature.size(); ++i)
      {
        EXPECT_NEAR(cold.temperature[i] + warm.temperature[i], 2, 1e-12);
        EXPECT_NEAR(cold.solid_fraction[i] + warm.solid_fraction[i], 1, 1e-11);
      }
    }

    TEST(PlanarFreezing, FromTheOtherSideIsTheSame)
    {
      const Planar left = normalised(false);
      Scene insulated = left.scene;
      set_boundary(insulated, Side::x_max, {});
      Scene right = insulated;
      std::swap(right.boundaries[0], right.boundaries[1]);
      const RunRecord a = run(insulated, 64), b = run(right, 64);
      const std::size_t n = a.temperature.size();
      for(std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(a.temperature[i], b.temperature[n - 1 - i], 1e-12);
    }

    TEST(PlanarFreezing, AStripIsTheSlab)
    {
      for(const bool started : {true, false})
      {
        const Planar planar = normalised(started);
        const RunRecord line = run(planar.scene, 32, {}, planar.exact.get());
        for(const char *dimension : {"2", "3"})
        {
          const RunRecord strip
              = run(planar.scene, 32, {{"dimension", dimension}}, planar.exact.get());
          ASSERT_EQ(strip.front.size(), line.front.size());
          for(std::size_t i = 0; i < line.front.size(); ++i)
            EXPECT_NEAR(strip.front[i], line.front[i], 1e-10);
          EXPECT_NEAR(strip.heat.boundary, line.heat.boundary, 1e-10);
          EXPECT_NEAR(strip.temperature_error, line.temperature_error, 1e-9);
          EXPECT_LE(strip.worst_budget_defect(), 1e-13);
        }
      }
    }

    // Solid up to 0.2529, which is in a cell of every resolution; nobody says that a
    // front is there but the temperature, with a kink.
    TEST(PlanarFreezing, CellsInWhichTheStartPassesTheMeltingPointHoldTheHeatOfBothSides)
    {
      constexpr double front = 0.2529;
      const Material material = normalised_material();
      for(const int n : {20, 32, 40, 52})
      {
        Scene scene = slab(material, 1, 0, 0, 1e-3);
        scene.initial.temperature = {"", [&](const Position &p, double)
                                     {
                                       const double beyond = p[0] - front;
                                       return material.melting_temperature
                                              + (beyond < 0 ? 3 * beyond : 2 * beyond);
                                     }};
        const double expected = -3 * front * front / 2 + (1 - front) * (1 - front)
                                + material.latent_heat * (1 - front);
        EXPECT_NEAR(run(scene, n, {}).heat.initial, expected, 1e-12) << n;
      }
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
