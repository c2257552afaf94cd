#include <verification/measure/checks/given_heat.h>
#include <verification/measure/checks/scene_quadrature.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    using cases::BoundaryKind, cases::DomainShape, cases::Side, cases::Symmetry;

    cases::Field field(std::function<double(const cases::Position &, double)> value,
                       std::vector<double> breakpoints = {})
    {
      return {"", std::move(value), false, std::move(breakpoints)};
    }

    void set_wall(cases::Scene &scene, Side side, BoundaryKind kind, cases::Field value)
    {
      scene.boundaries[static_cast<std::size_t>(side)]
          = cases::Boundary{kind, std::move(value), false, 0};
    }

    TEST(HeatOverTime, MeetsAPulseBetweenItsBreakpoints)
    {
      const HeatOverTime heat([](double t) { return t > 0.3001 && t < 0.3002 ? 5. : 0.; },
                              0, 1, {0.3001, 0.3002});
      EXPECT_EQ(heat(0.3), 0);
      EXPECT_NEAR(heat(0.30015), 2.5e-4, 1e-12);
      EXPECT_NEAR(heat(1), 5e-4, 1e-12);
    }

    TEST(HeatOverTime, CountsWhatLeavesInItsGross)
    {
      const HeatOverTime heat([](double t) { return t < 1 ? 2. : -2.; }, 0, 2, {1});
      EXPECT_NEAR(heat(2), 0, 1e-13);
      EXPECT_NEAR(heat.gross(), 4, 1e-13);
    }

    TEST(SceneQuadrature, WeighsDomainsAndWalls)
    {
      const auto sum = [](const std::vector<QuadraturePoint> &points)
      {
        double total = 0;
        for(const QuadraturePoint &point : points)
          total += point.weight;
        return total;
      };
      const cases::Domain box
          = tests::scene_of(DomainShape::box, 3, Symmetry::none).domain;
      EXPECT_NEAR(sum(points_over(box)), volume_of(box), 1e-12);
      EXPECT_NEAR(sum(points_on(box, Side::y_max)), area_of(box, Side::y_max), 1e-12);
      cases::Domain ring = tests::scene_of(DomainShape::ball, 2, Symmetry::none).domain;
      ring.shape = DomainShape::shell;
      ring.inner_radius = 0.2;
      EXPECT_NEAR(sum(points_over(ring)), std::numbers::pi * (0.25 - 0.04), 1e-12);
      EXPECT_NEAR(sum(points_on(ring, Side::inner)), 0.4 * std::numbers::pi, 1e-12);
      const cases::Domain ball
          = tests::scene_of(DomainShape::ball, 3, Symmetry::none).domain;
      EXPECT_TRUE(points_over(ball).empty());
      EXPECT_NEAR(area_of(ball, Side::outer), std::numbers::pi, 1e-12);
    }

    TEST(GivenHeat, IntegratesFluxesAlongWallsAndInTime)
    {
      cases::Scene scene = tests::scene_of(DomainShape::box, 2, Symmetry::none);
      for(const Side side : {Side::x_min, Side::x_max, Side::y_min, Side::y_max})
        set_wall(scene, side, BoundaryKind::insulated, {});
      set_wall(scene, Side::x_max, BoundaryKind::flux,
               field([](const cases::Position &p, double t)
                     { return (1 + p[1] * p[1]) * t * t; }));
      const GivenHeat heat(scene);
      EXPECT_EQ(heat.unknown_walls, "");
      EXPECT_NEAR(heat.through_walls(0.7), (1 + 1. / 12) * 0.343 / 3, 1e-9);
      set_wall(scene, Side::y_min, BoundaryKind::fixed_temperature,
               cases::Field::uniform(1));
      EXPECT_EQ(GivenHeat(scene).unknown_walls,
                "the heat through y_min depends on the solution");
    }

    TEST(GivenHeat, AddsWhatIsReleasedToWhatSourcesGive)
    {
      cases::Scene scene = tests::scene_of(DomainShape::ball, 2, Symmetry::none);
      scene.volumetric_source = field([](const cases::Position &p, double t)
                                      { return (p[0] * p[0] + p[1] * p[1]) * 2 * t; });
      scene.sources.push_back({.expression = {},
                               .power = [](double) { return -3.; },
                               .energy = [](double t) { return -3 * t; }});
      const GivenHeat heat(scene);
      EXPECT_EQ(heat.unknown_sources, "");
      const double released = std::numbers::pi / 32 * 0.25;
      EXPECT_NEAR(heat.from_sources(0.5), released - 1.5, 1e-9);
      EXPECT_NEAR(heat.gross_sources(), 4 * released + 3, 1e-9);
    }

    /** A spot between the points of the coarsest quadrature, which saw five times its
     * heat. */
    TEST(GivenHeat, ResolvesANarrowSpotOrSaysThatItDoesNot)
    {
      cases::Scene scene = tests::scene_of(DomainShape::box, 2, Symmetry::none);
      const auto spot = [&scene](double width)
      {
        const cases::Domain &box = scene.domain;
        const double at_x = box.lower[0] + 0.513 * (box.upper[0] - box.lower[0]),
                     at_y = box.lower[1] + 0.487 * (box.upper[1] - box.lower[1]);
        return field(
            [width, at_x, at_y](const cases::Position &p, double)
            {
              const double x = p[0] - at_x, y = p[1] - at_y;
              return std::exp(-(x * x + y * y) / (width * width));
            });
      };
      constexpr double width = 0.008;
      scene.volumetric_source = spot(width);
      const double duration = scene.end_time - scene.start_time,
                   exact = std::numbers::pi * width * width * duration;
      const GivenHeat heat(scene);
      EXPECT_EQ(heat.unknown_sources, "");
      EXPECT_NEAR(heat.from_sources(scene.end_time), exact, 0.02 * exact);
      scene.volumetric_source = spot(0.002);
      EXPECT_NE(GivenHeat(scene).unknown_sources, "");
    }
  } // namespace
} // namespace meltfront::verification
