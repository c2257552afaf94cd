#include <cases/exact/frank.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>
#include <cases/exact/tests/materials.h>
#include <cases/exact/wall_layer.h>

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

namespace meltfront::cases
{
  namespace
  {
    /** What the forty-digit values are met to. */
    constexpr double round_off = 1e-12;

    struct PlanarRow
    {
      Material material;
      double wall, far, time;
      double lambda, front, temperature_half, temperature_double;
    };

    /** Values computed independently with forty digits. */
    const PlanarRow planar_rows[]
        = {{unit_material(), unit_wall, 1.2, 0.0568, 0.5, 0.2383275057562597,
            0.6203007190908762, 1.134390337031466},
           {water(), -10, 10, 86400, 0.156854025686043, 0.09460644723343456,
            -4.969277918804942, 5.858338843792701},
           {water(917), -10, 10, 86400, 0.1563920174825836, 0.0985042522429317,
            -4.969458445252306, 5.976742404195143},
           {water(), -10, 0, 86400, 0.1752092843764274, 0.1056774146832831,
            -4.961676941022189, 0},
           {{{1, 1, 1}, {0.1, 2, 1}, 1, 0},
            -1,
            0.5,
            0.1,
            0.4548427685532543,
            0.2876678251770185,
            -0.4743843036647956,
            0.4999989115209127}};
  } // namespace

  TEST(PlanarNeumann, IndependentValues)
  {
    for(const PlanarRow &row : planar_rows)
    {
      const PlanarNeumann solution(row.material, row.wall, row.far);
      expect_relative(solution.lambda(), row.lambda, round_off);
      const double front = solution.front(row.time);
      expect_relative(front, row.front, round_off);
      expect_relative(solution.temperature(front / 2, row.time), row.temperature_half,
                      round_off);
      expect_relative(solution.temperature(2 * front, row.time), row.temperature_double,
                      round_off);
    }
  }

  TEST(PlanarNeumann, OnePhaseByStefanNumber)
  {
    const std::pair<double, double> rows[] = {
        {0.01, 0.07059327656042931}, {0.1, 0.2200162727429379}, {0.5, 0.4647859206462444},
        {1, 0.6200626333135955},     {2, 0.8006013628056083},   {5, 1.059687014281902}};
    for(const auto &[stefan, lambda] : rows)
      expect_relative(PlanarNeumann(Material{}, -stefan, 0).lambda(), lambda, round_off);
  }

  TEST(PlanarNeumann, MoreIndependentValues)
  {
    // The wall temperature as rounded in print floors the front at 1.4e-6.
    expect_relative(PlanarNeumann(unit_material(), 0.1906, 1.2).lambda(), 0.500000684,
                    1e-9);

    Material ice_water = water();
    ice_water.solid.specific_heat_capacity = 2093;
    const PlanarNeumann ice(ice_water, -10, 5);
    expect_relative(ice.lambda(), 0.165690022880237, 1e-13);
    expect_relative(ice.front(3600), 20.3847e-3, 3e-6);
  }

  /** Poorly conducting liquid: a bracket that is too narrow gives 0.158 and 0.500 here.
   */
  TEST(PlanarNeumann, LowLiquidConductivity)
  {
    const std::pair<double, double> rows[] = {{1e-3, 0.528186}, {1e-2, 0.527613}};
    for(const auto &[conductivity, lambda] : rows)
    {
      Material material = unit_material();
      material.liquid.conductivity = conductivity;
      EXPECT_NEAR(PlanarNeumann(material, 0.1906, 1.2).lambda(), lambda, 1e-6);
    }
  }

  TEST(LineSink, IndependentValues)
  {
    struct Row
    {
      double lambda, reduced, strength, front, earlier_front, half, outside;
    };
    const Row rows[] = {{0.15, 0.03365121389440404, 148.4508990290751, 0.2121320343559643,
                         0.1732050807568877, -7.354009418253346, 6.659059742736796},
                        {0.20, 0.05592822298089015, 246.7249772523774, 0.282842712474619,
                         0.2309401076758503, -12.10747212496311, 4.973272630809257}};
    for(const Row &row : rows)
    {
      const LineSink sink(water(), row.lambda, 10);
      expect_relative(sink.strength(), row.strength, round_off);
      expect_relative(sink.strength()
                          / (4 * std::numbers::pi * 333500 * 1000 * 2.2 / 2090e3),
                      row.reduced, round_off);
      expect_relative(sink.front(475000), row.front, round_off);
      expect_relative(sink.front(316666.66666666667), row.earlier_front, round_off);
      expect_relative(sink.temperature(row.front / 2, 475000), row.half, round_off);
      expect_relative(sink.temperature(0.4, 475000), row.outside, round_off);
    }
    expect_relative(LineSink(unit_material(), 0.5, 1.2).strength(), 6.44058396053121,
                    round_off);
  }

  TEST(PointSink, IndependentValues)
  {
    const PointSink sink(water(), 0.15, 10);
    expect_relative(sink.amplitude(), 3.79757108298628, round_off);
    expect_relative(sink.strength(1), 0.107715116113955, round_off);
    expect_relative(sink.strength(400) / 20, 0.107715116113955, round_off);
  }

  TEST(FrankGrowth, IndependentValues)
  {
    const double rows[][4]
        = {{0.1, 0.1206278004534685, 0.3692469731451025, 0.56526101298242},
           {0.25, 0.3379980849240049, 0.7605428274360679, 1.077742254305175},
           {0.5, 0.8655031987326159, 1.562123928291061, 2.076033848107866}};
    for(const auto &row : rows)
    {
      expect_relative(
          FrankGrowth(Material{}, Symmetry::planar, -row[0]).growth_constant(), row[1],
          round_off);
      expect_relative(
          FrankGrowth(Material{}, Symmetry::cylindrical, -row[0]).growth_constant(),
          row[2], round_off);
      expect_relative(
          FrankGrowth(Material{}, Symmetry::spherical, -row[0]).growth_constant(), row[3],
          round_off);
    }
  }

  /** erfc(1/2) and ierfc(1/2) with fifteen digits (Carslaw & Jaeger 1959, appendix II).
   */
  TEST(WallLayer, IndependentValuesSlopeAndFarAway)
  {
    const double thickness = 0.4;
    const WallLayer jumps{3, 0}, draws{0, 2}, both{3, 2};
    expect_relative(jumps.temperature(0.2, thickness), 3 * 0.479500122186953, round_off);
    expect_relative(draws.temperature(0.2, thickness), 2 * thickness * 0.1996412283742457,
                    round_off);
    EXPECT_EQ(both.temperature(0, thickness), 3 + draws.temperature(0, thickness));
    const double step = 1e-7;
    EXPECT_NEAR((draws.temperature(0, thickness) - draws.temperature(step, thickness))
                    / step,
                2, 1e-6);
    EXPECT_EQ(both.temperature(100, thickness), 0);
  }
} // namespace meltfront::cases
