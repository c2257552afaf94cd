#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/fitted/fitted.h>
#include <verification/app/tests/random_slabs.h>

#include <cases/error.h>
#include <cases/exact/planar_neumann.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

/** Several fronts along a ray: how they start, meet and vanish. */
namespace meltfront::verification::tests
{
  namespace
  {
    using namespace reference_fem;
    using cases::BoundaryKind;
    using cases::Side;
    using namespace test_support;

    Course run(const cases::Scene &scene, const int n)
    {
      return course_of(*make_fem_fitted(), scene, n);
    }

    cases::Boundary wall_of(BoundaryKind kind, std::function<double(double)> value,
                            std::vector<double> breakpoints = {})
    {
      cases::Boundary wall = varying_wall(std::move(value));
      wall.kind = kind;
      wall.value.breakpoints = std::move(breakpoints);
      wall.heat_transfer_coefficient = 3;
      return wall;
    }

    cases::Material unlike(double solid_conductivity, double liquid_conductivity)
    {
      cases::Material material = unit_material();
      material.solid.conductivity = solid_conductivity;
      material.liquid.conductivity = liquid_conductivity;
      material.solid.specific_heat_capacity = 1.3;
      return material;
    }

    cases::Scene start_of(cases::Scene scene, std::function<double(double x)> temperature)
    {
      scene.initial.temperature
          = field_of([temperature = std::move(temperature)](const cases::Position &p)
                     { return temperature(p[0]); });
      scene.initial.temperature.constant = false;
      return scene;
    }

    /** The times at which a run says that something happens with these words in it. */
    std::vector<double> times_of(const cases::Scene &scene, const int n,
                                 const std::string &words)
    {
      struct Times : NoObserver
      {
        void note(double time, const std::string &event) override
        {
          if(event.find(words) != std::string::npos)
            times.push_back(time);
        }

        std::string words;
        std::vector<double> times;
      } observer;
      observer.words = words;
      const auto method = make_fem_fitted();
      solve(*method, scene, resolution_of(*method, n), observer);
      return observer.times;
    }

    /** Solid and heat at the end against two methods that know nothing of this one. */
    void expect_agreement(const cases::Scene &scene, const Course &course,
                          const double tolerance)
    {
      const Course enthalpy = course_of(*make_fem_enthalpy(), scene, 500),
                   tracked = course_of(*particles::make_rkpm_tracked(), scene, 160);
      for(const Course *other : {&enthalpy, &tracked})
      {
        EXPECT_NEAR(course.solid.back(), other->solid.back(), tolerance);
        // rkpm-tracked does not conserve heat.
        EXPECT_NEAR(course.heat.boundary, other->heat.boundary,
                    other == &tracked ? 10 * tolerance : tolerance);
      }
      EXPECT_LE(course.worst_budget_defect(), 1e-12);
    }

    TEST(TwoWalls, FreezeASlabAsOneWallFreezesHalfOfIt)
    {
      for(const double end : {0.05, 0.15})
      {
        cases::Scene whole = slab(unlike(2, 1), 2, 0.3, 0, end),
                     half = slab(unlike(2, 1), 1, 0.3, 0, end);
        for(cases::Scene *scene : {&whole, &half})
          set_boundary(*scene, Side::x_min, fixed_wall(-2));
        set_boundary(whole, Side::x_max, fixed_wall(-2));
        const Course both = run(whole, 16), one = run(half, 16);
        EXPECT_NEAR(both.solid.back(), 2 * one.solid.back(), 1e-12);
        EXPECT_NEAR(both.heat.boundary, 2 * one.heat.boundary, 1e-11);
        ASSERT_EQ(both.front_points[0].size(), 2 * one.front_points[0].size());
        if(!one.front_points[0].empty())
        {
          EXPECT_NEAR(both.front_points[0][0], one.front_points[0][0], 1e-12);
          EXPECT_NEAR(both.front_points[0][1], 2 - one.front_points[0][0], 1e-12);
        }
      }
      // Frozen through by then: the latter of the two compared a merger with an arrival.
      cases::Scene through = slab(unlike(2, 1), 2, 0.3, 0, 1);
      set_boundary(through, Side::x_min, fixed_wall(-2));
      set_boundary(through, Side::x_max, fixed_wall(-2));
      cases::Scene half = slab(unlike(2, 1), 1, 0.3, 0, 1);
      set_boundary(half, Side::x_min, fixed_wall(-2));
      const std::vector<double> met = times_of(through, 16, "two fronts meet at 1"),
                                arrived = times_of(half, 16, "reaches the wall x_max");
      ASSERT_EQ(met.size(), 1u);
      ASSERT_EQ(arrived.size(), 1u);
      EXPECT_NEAR(met[0], arrived[0], 1e-11);
      const Course both = run(through, 16), one = run(half, 16);
      EXPECT_NEAR(both.heat.boundary, 2 * one.heat.boundary, 1e-9);
      EXPECT_NEAR(both.solid.back(), 2, 1e-12);
    }

    TEST(TwoWalls, EachFollowNeumannsSolutionUntilTheirLayersMeet)
    {
      const double end = 0.05;
      const cases::Material material = unlike(2, 1);
      const cases::PlanarNeumann cold(material, -1, 0.5), cool(material, -0.3, 0.5);
      cases::Scene scene = slab(material, 4, 0.5, 0, end);
      set_boundary(scene, Side::x_min, fixed_wall(-1));
      set_boundary(scene, Side::x_max, fixed_wall(-0.3));
      const Course course = run(scene, 32);
      ASSERT_EQ(course.front_points[0].size(), 2u);
      EXPECT_NEAR(course.front_points[0][0] / cold.front(end), 1, 2e-8);
      EXPECT_NEAR((4 - course.front_points[0][1]) / cool.front(end), 1, 2e-8);
      EXPECT_LE(course.worst_budget_defect(), 1e-12);
    }

    TEST(TwoWalls, OfFluxesStartOneAfterTheOtherAndMelt)
    {
      cases::Scene scene = slab(unlike(1, 1.5), 3, -1, 0, 0.2);
      set_boundary(scene, Side::x_min, flux_wall(4));
      set_boundary(scene, Side::x_max, flux_wall(3));
      // The walls of half spaces are at -1 + 2 q sqrt(t/(pi k rho c)).
      const double c = 1.3;
      const std::vector<double> starts = times_of(scene, 32, "passes the melting");
      ASSERT_EQ(starts.size(), 2u);
      EXPECT_NEAR(starts[0], std::numbers::pi * c / 4 / 16, 1e-6);
      EXPECT_NEAR(starts[1], std::numbers::pi * c / 4 / 9, 1e-6);
      const Course course = run(scene, 16), finer = run(scene, 32);
      expect_agreement(scene, course, 1e-3); // on a slab of three, whose cells are larger
      for(std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(course.front_points[0][k], finer.front_points[0][k], 2e-6);
    }

    TEST(Layer, OfLiquidBetweenTwoSolidsCloses)
    {
      cases::Scene scene = start_of(slab(unlike(2, 1), 1, 0, 0, 0.1),
                                    [](double x)
                                    {
                                      const double solid = std::abs(x - 0.5) - 0.1;
                                      return solid > 0 ? -0.5 * solid / 0.4
                                                       : 0.4 * (x - 0.4) * (0.6 - x);
                                    });
      for(const Side side : {Side::x_min, Side::x_max})
        set_boundary(scene, side, fixed_wall(-0.5));
      const std::vector<double> coarse = times_of(scene, 16, "two fronts meet at 0.5"),
                                fine = times_of(scene, 32, "two fronts meet at 0.5");
      ASSERT_EQ(coarse.size(), 1u);
      EXPECT_NEAR(coarse[0], fine[0], 1e-8);
      const Course course = run(scene, 16);
      EXPECT_TRUE(course.front_points[0].empty());
      EXPECT_NEAR(course.solid.back(), 1, 1e-12);
      expect_agreement(scene, course, 1e-5);
    }

    TEST(Layers, AreBornBehindEachOtherAtAWallThatSwings)
    {
      cases::Scene scene = slab(unlike(1, 2), 1, -0.2, 0, 2.3);
      set_boundary(scene, Side::x_min,
                   varying_wall([](double t)
                                { return std::sin(2 * std::numbers::pi * t) - 0.2; }));
      set_boundary(scene, Side::x_max, fixed_wall(-0.2));
      const std::vector<double> births = times_of(scene, 16, "passes the melting"),
                                ends = times_of(scene, 16, "two fronts meet"),
                                finer = times_of(scene, 32, "two fronts meet");
      const double first = std::asin(0.2) / (2 * std::numbers::pi);
      ASSERT_EQ(births.size(), 5u);
      for(int k = 0; k < 5; ++k)
        EXPECT_NEAR(births[k], k / 2 + (k % 2 == 0 ? first : 0.5 - first), 1e-11);
      ASSERT_EQ(ends.size(), finer.size());
      for(std::size_t k = 0; k < ends.size(); ++k)
        EXPECT_NEAR(ends[k], finer[k], 1e-6);
      expect_agreement(scene, run(scene, 16), 1e-3);
    }

    TEST(Layers, AJumpOfTheWallOfADiskAsksNothingOfItsCentre)
    {
      cases::Scene scene = ball(unlike(1, 0.9), 2, 1, 0, 0.2);
      set_boundary(scene, Side::outer,
                   wall_of(BoundaryKind::fixed_temperature,
                           [](double t) { return t < 0.1 ? -0.7 : -0.3; }, {0.1}));
      expect_agreement(scene, run(scene, 16), 2e-3);
    }

    TEST(Layers, ThreeFrontsOfTheStartMoveApartAsTheyShould)
    {
      cases::Scene scene = start_of(slab(unit_material(), 1, 0, 0, 0.05), [](double x)
                                    { return std::cos(3 * std::numbers::pi * x); });
      // Odd about the middle, and so it stays.
      const Course odd = run(scene, 16);
      ASSERT_EQ(odd.front_points[0].size(), 3u);
      EXPECT_NEAR(odd.front_points[0][1], 0.5, 1e-12);
      EXPECT_NEAR(odd.front_points[0][0] + odd.front_points[0][2], 1, 1e-12);
      scene.material = unlike(2, 0.7);
      expect_agreement(scene, run(scene, 16), 1e-4);
    }

    TEST(AtOnce, AFrontStartsAtAWallThatIsAtTheMeltingTemperature)
    {
      // s = t - t^2/2 + 5/6 t^3 - ... (Evans, Isaacson and MacDonald 1950).
      cases::Scene scene = slab(unit_material(), 1, 0, 0, 0.01);
      set_boundary(scene, Side::x_min, flux_wall(-1));
      const double t = 0.01;
      EXPECT_NEAR(run(scene, 16).front_points[0][0],
                  t - t * t / 2 + 5 * std::pow(t, 3) / 6 - 51 * std::pow(t, 4) / 24,
                  2e-9);
      scene.end_time = 0.5;
      expect_agreement(scene, run(scene, 16), 5e-5);
    }

    TEST(Jump, OfAFluxThatTurnsMeltsBehindTheSolid)
    {
      cases::Scene scene = slab(unit_material(), 1, 0.1, 0, 1.6);
      set_boundary(
          scene, Side::x_min,
          wall_of(BoundaryKind::flux, [](double t) { return t < 1 ? -1. : 1.; }, {1}));
      const std::vector<double> coarse = times_of(scene, 16, "passes the melting"),
                                fine = times_of(scene, 32, "passes the melting");
      ASSERT_EQ(coarse.size(), 2u);
      EXPECT_NEAR(coarse[1], fine[1], 1e-7);
      const Course course = run(scene, 16);
      EXPECT_EQ(course.front_points[0].size(), 2u);
      EXPECT_NEAR(course.heat.boundary, -0.4, 1e-12);
      expect_agreement(scene, course, 1e-4);
    }

    TEST(Jump, OfAWallAcrossTheMeltingTemperatureStartsLayerBehindLayer)
    {
      cases::Scene scene = slab(unit_material(), 1, 0.3, 0, 0.6);
      set_boundary(scene, Side::x_min,
                   wall_of(BoundaryKind::fixed_temperature,
                           [](double t) { return t < 0.2 || t >= 0.35 ? -1. : 1.; },
                           {0.2, 0.35}));
      const Course course = run(scene, 16);
      EXPECT_EQ(course.front_points[0].size(), 1u);
      EXPECT_NEAR(course.front_points[0][0], run(scene, 32).front_points[0][0], 1e-7);
      expect_agreement(scene, course, 5e-5);
    }

    TEST(Layers, ThatDisplaceLiquidAreRefused)
    {
      cases::Material material = unit_material();
      material.solid.density = 0.9;
      cases::Scene scene = slab(material, 1, 0.3, 0, 0.1);
      set_boundary(scene, Side::x_min, fixed_wall(-1));
      set_boundary(scene, Side::x_max, fixed_wall(-1));
      try
      {
        run(scene, 8);
        FAIL() << "not refused";
      }
      catch(const cases::Refusal &refusal)
      {
        EXPECT_NE(std::string(refusal.what()).find("densities"), std::string::npos);
      }
    }

    TEST(Start, MayJumpAtSeveralFronts)
    {
      constexpr double end = 5e-4, solid = -0.1, liquid = 0.3;
      const cases::Scene scene
          = start_of(slab(unit_material(), 1, 0, 0, end),
                     [](double x) { return x > 0.4 && x < 0.6 ? liquid : solid; });
      const double way = 2 * speed_of_contact(solid, liquid) * std::sqrt(end);
      for(const int n : {8, 16})
        EXPECT_NEAR(run(scene, n).solid.back(), 0.8 + 2 * way, 1e-3 * std::abs(way)) << n;
    }

    TEST(Start, CellsAreHalvedUntilTheyResolveIt)
    {
      // A layer of heat 0.01 thick beside a front, on cells of 1/16.
      cases::Scene scene
          = start_of(slab(unit_material(), 1, 0, 0, 1e-3), [](double x)
                     { return x < 0.5 ? 0 : 1 - std::exp((0.5 - x) / 0.01); });
      scene.initial.front = cases::Field{
          "x - 0.5", [](const cases::Position &p, double) { return p[0] - 0.5; }, false};
      const Course coarse = run(scene, 16), fine = run(scene, 64);
      ASSERT_EQ(coarse.front_points[0].size(), 1u);
      EXPECT_NEAR(coarse.front_points[0][0], fine.front_points[0][0], 1e-6);
      EXPECT_GT(coarse.description.unknowns, 16 * 4 + 2);
      EXPECT_LT(coarse.cost.evidence.at(
                    "highest mode of a cell at the end, of the temperature scale"),
                1e-3);
    }

    /** MELTFRONT_RANDOM_SLABS=FROM:TO runs others than the first thirty. */
    TEST(RandomSlabs, AreAsTheEnthalpyMethodSaysOrRefused)
    {
      std::uint64_t from = 0, to = 30;
      if(const char *range = std::getenv("MELTFRONT_RANDOM_SLABS"))
      {
        char *colon = nullptr;
        from = std::strtoull(range, &colon, 10);
        to = std::strtoull(colon + 1, nullptr, 10);
      }
      std::uint64_t refused = 0;
      for(std::uint64_t number = from; number < to; ++number)
      {
        const cases::Scene scene = random_slab(number);
        const auto enthalpy = make_fem_enthalpy();
        const Course coarse = course_of(*enthalpy, scene, 200),
                     fine = course_of(*enthalpy, scene, 400);
        try
        {
          const Course course = run(scene, 12);
          // Three times what halved cells change, and what one cell of a coarse front is.
          EXPECT_NEAR(course.solid.back(), fine.solid.back(),
                      3 * std::abs(fine.solid.back() - coarse.solid.back()) + 2e-3)
              << number;
          EXPECT_NEAR(course.heat.boundary, fine.heat.boundary,
                      3 * std::abs(fine.heat.boundary - coarse.heat.boundary) + 2e-3)
              << number;
          EXPECT_LE(course.worst_budget_defect(), 1e-11) << number;
        }
        catch(const cases::Refusal &)
        {
          ++refused;
        }
      }
      EXPECT_LE(refused, (to - from) / 10);
    }

    // One wall jumps as the other is about to pass the melting temperature: steps to that
    // are short, and cells at the jump are to hold them.
    TEST(RandomSlabs, AJumpHasCellsForTheStepsOfTheOtherWall)
    {
      const cases::Scene scene = random_slab(270);
      EXPECT_NEAR(run(scene, 40).solid.back(),
                  course_of(*make_fem_enthalpy(), scene, 400).solid.back(), 2e-3);
    }

    // A layer as thick as rounding would balance the heat.
    TEST(RandomSlabs, ASeedThatItsWallHidesIsRefused)
    {
      EXPECT_THROW(run(random_slab(885), 12), cases::Refusal);
    }
  } // namespace
} // namespace meltfront::verification::tests
