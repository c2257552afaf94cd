#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/fitted/events/timeline.h>
#include <reference_fem/fitted/fitted.h>

#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/planar_neumann.h>
#include <cases/exact/point_sink.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    using cases::Side;
    using namespace test_support;

    Course run(const cases::Method &method, const cases::Scene &scene, const int n,
               const std::string &steps = "0")
    {
      return course_of(method, scene, n,
                       steps != "0" ? OptionTexts{{"steps", steps}} : OptionTexts{});
    }

    Course run(const cases::Scene &scene, const int n, const std::string &steps = "0")
    {
      return run(*make_fem_fitted(), scene, n, steps);
    }

    /** Largest difference of the fronts, over the exact front at the end. */
    double worst_error(const Course &record, const cases::ExactSolution &exact,
                       const double mirror = 0)
    {
      double worst = 0;
      for(std::size_t i = 0; i < record.time.size(); ++i)
        if(record.first_front[i] >= 0)
          worst = std::max(worst, std::abs((mirror > 0 ? mirror - record.first_front[i]
                                                       : record.first_front[i])
                                           - exact.front(record.time[i])));
      return worst / exact.front(record.time.back());
    }

    TEST(ColdStart, FollowsNeumannsSolutionFromEitherWallFreezingOrMelting)
    {
      for(const bool freezes : {true, false})
        for(const Side side : {Side::x_min, Side::x_max})
        {
          const double wall = freezes ? -1 : 1, far = freezes ? 0.5 : -0.5;
          const cases::PlanarNeumann exact(unit_material(), wall, far);
          cases::Scene scene = slab(unit_material(), 4, far, 0, 0.05);
          set_boundary(scene, side, fixed_wall(wall));
          const Course record = run(scene, 32);
          EXPECT_LE(worst_error(record, exact, side == Side::x_max ? 4 : 0), 2e-8)
              << freezes << to_string(side);
          EXPECT_LE(record.worst_budget_defect(), 1e-12);
          EXPECT_EQ(record.time.front(), 0.);
          EXPECT_EQ(record.solid.front(), freezes ? 0. : 4.);
          EXPECT_LE(record.cost.most_iterations, 8);
        }
    }

    TEST(ColdStart, FollowsSinksFromTheMomentTheyAreSwitchedOn)
    {
      const cases::LineSink line(water(), 0.15, 10);
      const cases::PointSink point(water(), 0.15, 10);
      for(const int dimension : {2, 3})
      {
        const cases::ExactSolution &exact
            = dimension == 2 ? static_cast<const cases::ExactSolution &>(line) : point;
        cases::Scene scene = ball(water(), dimension, 0.5, 10, 475000);
        cases::PointSource sink;
        sink.power = [&](const double t)
        { return dimension == 2 ? -line.strength() : -point.strength(t); };
        sink.energy = [&](const double t)
        { return dimension == 2 ? -line.strength() * t : -point.energy(t); };
        scene.sources.push_back(sink);
        set_boundary(scene, Side::outer,
                     exact_wall(std::shared_ptr<const cases::ExactSolution>(
                         std::shared_ptr<void>(), &exact)));
        const Course record = run(scene, 24);
        EXPECT_NEAR(record.first_front.back() / exact.front(475000), 1, 2e-9)
            << dimension;
        EXPECT_LE(worst_error(record, exact), 1e-7) << dimension;
        EXPECT_LE(record.worst_budget_defect(), 1e-12) << dimension;
      }
    }

    // The layers do not meet: Neumann's at one wall, that of a half-space at the other.
    TEST(ColdStart, AWallAtTheOtherEndMayBeHotFromTheSameMoment)
    {
      const double end = 0.05, hot = 2 * std::sqrt(end / std::numbers::pi);
      const cases::PlanarNeumann exact(unit_material(), -1, 0);
      for(const bool mirrored : {false, true})
      {
        cases::Scene scene = slab(unit_material(), 4, 0, 0, end);
        set_boundary(scene, mirrored ? Side::x_max : Side::x_min, fixed_wall(-1));
        set_boundary(scene, mirrored ? Side::x_min : Side::x_max, fixed_wall(1));
        const Course record = run(scene, 32);
        EXPECT_LE(worst_error(record, exact, mirrored ? 4 : 0), 2e-8);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        cases::Scene cold = slab(unit_material(), 4, 0, 0, end);
        set_boundary(cold, Side::x_min, fixed_wall(-1));
        EXPECT_NEAR(record.heat.boundary - run(cold, 32).heat.boundary, hot, 1e-7);
      }
    }

    // Liquid at its melting temperature conducts nothing: what freezes at each wall is
    // what would without the other.
    TEST(ColdStart, AWallAtTheOtherEndMayLeadHeatFromLiquidAboutToFreeze)
    {
      const double end = 0.05;
      const cases::PlanarNeumann exact(unit_material(), -1, 0);
      for(const double warmer : {0., 1e-8, 1e-5})
        for(const bool mirrored : {false, true})
        {
          const Side held = mirrored ? Side::x_max : Side::x_min,
                     other = mirrored ? Side::x_min : Side::x_max;
          cases::Scene alone = slab(unit_material(), 2, 0, 0, end);
          set_boundary(alone, other, flux_wall(-2));
          const double by_flux = run(alone, 32).solid.back();
          cases::Scene scene = slab(unit_material(), 2, warmer, 0, end);
          set_boundary(scene, held, fixed_wall(-1));
          set_boundary(scene, other, flux_wall(-2));
          const Course record = run(scene, 32);
          EXPECT_NEAR(record.solid.back(), exact.front(end) + by_flux, 2e-8 + 2 * warmer);
          EXPECT_LE(record.worst_budget_defect(), 1e-12);
        }
    }

    // What a jump leaves in the first cell is not resolved, and must not be taken for
    // liquid below its melting point.
    TEST(Jump, OfAWallHeatsLiquidAtItsMeltingPoint)
    {
      for(const int n : {8, 16, 32, 64})
      {
        cases::Scene scene = slab(unit_material(), 1, 0, 0, 0.15);
        cases::Boundary wall = varying_wall([](double t) { return t < 0.1 ? 0. : 1.; });
        wall.value.breakpoints = {0.1};
        set_boundary(scene, Side::x_min, wall);
        const Course record = run(scene, n);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        EXPECT_NEAR(record.heat.boundary, 2 * std::sqrt(0.05 / std::numbers::pi), 1e-8);
      }
    }

    /** A slab 0 < x < 1 in contact with itself at another temperature. */
    cases::Scene slab_in_contact(double at, double below, double above, double end)
    {
      cases::Scene scene = slab(unit_material(), 1, 0, 0, end);
      scene.initial.temperature = step_along_x(at, below, above);
      return scene;
    }

    TEST(Jump, BetweenBodiesThatTouchMovesTheFrontAsBetweenHalfSpaces)
    {
      constexpr double end = 0.006, at = 0.417;
      for(const auto &[solid, liquid] : {std::pair(-0.9, 0.3), std::pair(-0.2, 0.8)})
        for(const int n : {8, 16, 32})
        {
          cases::Scene scene = slab_in_contact(at, solid, liquid, end);
          scene.initial.front = cases::Field{
              "x - at", [](const cases::Position &p, double) { return p[0] - at; }};
          const Course record = run(scene, n);
          const double way = 2 * speed_of_contact(solid, liquid) * std::sqrt(end);
          EXPECT_NEAR(record.solid.back(), at + way, 2e-4 * std::abs(way)) << n;
          EXPECT_LE(record.worst_budget_defect(), 1e-12);
        }
    }

    TEST(Jump, WithinAPhaseSpreadsAsBetweenHalfSpaces)
    {
      constexpr double end = 0.004, at = 0.537, cold = 0.1, warm = 0.8;
      for(const int n : {8, 16, 32})
      {
        const Course record = run(slab_in_contact(at, cold, warm, end), n);
        for(std::size_t i = 0; i < record.temperature.size(); ++i)
          EXPECT_NEAR(
              record.temperature[i],
              (cold + warm) / 2
                  + (warm - cold) / 2
                        * std::erf((record.positions[0][i] - at) / (2 * std::sqrt(end))),
              2e-4);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
      }
    }

    cases::Scene cooled_bar(const double end)
    {
      cases::Scene scene = slab(unit_material(), 1, 0, 0, end);
      scene.initial.temperature.constant = false;
      scene.initial.temperature.value = [](const cases::Position &p, double)
      { return 0.6 - (1 - p[0]) * (1 - p[0]) / 2; };
      set_boundary(scene, Side::x_min, flux_wall(-1));
      return scene;
    }

    TEST(LateStart, BehindAFluxFollowsTheLawOfEarlyTimesAndConverges)
    {
      const Course coarse = run(cooled_bar(0.9), 32), fine = run(cooled_bar(0.9), 64);
      // The wall is at 0.1 - t until it freezes; then s = 4/3 tau^(3/2)/sqrt(pi).
      int early = 0;
      for(std::size_t i = 0; i < fine.time.size(); ++i)
      {
        const double since = fine.time[i] - 0.1;
        EXPECT_EQ(fine.first_front[i] >= 0, since > 1e-12);
        if(since <= 1e-12 || since > 1e-4)
          continue;
        ++early;
        EXPECT_NEAR(fine.first_front[i]
                        / (4. / 3 * std::pow(since, 1.5) / std::sqrt(std::numbers::pi)),
                    1, 2e-2);
      }
      EXPECT_GE(early, 3);
      EXPECT_NEAR(coarse.first_front.back(), fine.first_front.back(), 5e-8);
      EXPECT_LE(fine.worst_budget_defect(), 1e-12);
    }

    std::vector<Event> events_of(const cases::Scene &scene, const int n)
    {
      cases::Resolution resolution;
      resolution.n = n;
      resolution.options = cases::Options(cases::options_of(RunOptions()));
      const cases::EffectSet effects = cases::effects_called_for(scene);
      const RunOptions options = options_for(scene, resolution);
      const EventScene setting{scene, effects, options, rays_of(scene, options)};
      Timeline timeline(setting, {},
                        {[](const RunSegment &) {},
                         [](long, double, const dealii::Vector<double> &, bool) {},
                         [](double, const dealii::Vector<double> &) {}});
      timeline.run(one_phase_stretch(setting));
      return timeline.events();
    }

    /** The times at which walls pass the melting temperature. */
    std::vector<double> passings_of(const cases::Scene &scene, const int n)
    {
      std::vector<double> result;
      for(const Event &event : events_of(scene, n))
        if(event.text.find("passes the melting") != std::string::npos)
          result.push_back(event.time);
      return result;
    }

    TEST(LateStart, IsFoundToRoundOff)
    {
      const std::vector<Event> events = events_of(cooled_bar(0.2), 16);
      ASSERT_EQ(events.size(), 1u);
      EXPECT_NEAR(events[0].time, 0.1, 1e-13);
      EXPECT_NE(events[0].text.find("x_min"), std::string::npos);
    }

    /** Liquid at 0.5 that surroundings at -1 cool until it freezes at 0. */
    cases::Scene cooled_by_transfer(double end)
    {
      cases::Scene scene = slab(unit_material(), 10, 0.5, 0, end);
      cases::Boundary wall;
      wall.kind = cases::BoundaryKind::heat_transfer;
      wall.value = cases::Field::uniform(-1);
      wall.heat_transfer_coefficient = 1;
      set_boundary(scene, Side::x_min, wall);
      return scene;
    }

    /** The wall of a half space is at the melting temperature when exp(tau^2) erfc(tau) =
     * 2/3, tau^2 = h^2 alpha t/k^2. */
    TEST(LateStart, AtAWallThatTransfersHeatIsThatOfTheHalfSpace)
    {
      const double onset = 0.165649071093950;
      const std::vector<double> passings = passings_of(cooled_by_transfer(0.2), 160);
      ASSERT_EQ(passings.size(), 1u);
      EXPECT_NEAR(passings[0], onset, 1e-8);
      // A time of one after it, by second-order meshes that were extrapolated.
      EXPECT_NEAR(run(cooled_by_transfer(onset + 1), 80).first_front.back(), 0.33844,
                  1e-5);
    }

    /** The surface temperature's integral equation, summed as a series in the root of the
     * time. */
    TEST(LateStart, AtAWallThatRadiatesIsThatOfTheHalfSpace)
    {
      cases::Material material = unit_material();
      material.melting_temperature = 1;
      cases::Scene scene = slab(material, 3, 1.2, 0, 0.05);
      cases::Boundary wall;
      wall.kind = cases::BoundaryKind::radiation;
      wall.value = cases::Field::uniform(0.5);
      wall.emission_coefficient = 1;
      set_boundary(scene, Side::x_min, wall);
      const std::vector<double> passings = passings_of(scene, 160);
      ASSERT_EQ(passings.size(), 1u);
      EXPECT_NEAR(passings[0], 0.0272189375434, 1e-8);
    }

    TEST(LateStart, AgreesWithTheEnthalpyMethod)
    {
      const auto enthalpy = make_fem_enthalpy();
      EXPECT_NEAR(run(cooled_bar(0.9), 16).solid.back(),
                  run(*enthalpy, cooled_bar(0.9), 256).solid.back(), 1e-3);
      // A wall that cools through the melting temperature at t = 0.3.
      cases::Scene ramp = slab(unit_material(), 1, 0.3, 0, 1);
      set_boundary(ramp, Side::x_max, varying_wall([](double t) { return 0.3 - t; }));
      const Course record = run(ramp, 16);
      EXPECT_NEAR(record.solid.back(), run(*enthalpy, ramp, 256).solid.back(), 1e-3);
      EXPECT_NEAR(record.solid.back(), run(ramp, 32).solid.back(), 1e-5);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
    }

    // Less beyond the melting temperature than elements may overshoot, and yet no
    // overshoot.
    TEST(HeatReleased, ThatMeltsSolidAwayFromTheFrontIsRefused)
    {
      cases::Scene scene = slab(unit_material(), 1, 0, 0, 1);
      scene.initial.temperature
          = field_of([](const cases::Position &p) { return std::min(p[0] - 0.7, 0.); });
      scene.initial.front = field_of([](const cases::Position &p) { return p[0] - 0.7; });
      scene.volumetric_source = cases::Field::uniform(1);
      for(const int n : {16, 32})
        EXPECT_THROW(run(scene, n), cases::Refusal) << n;
    }

    TEST(Vanishing, LiquidFreezesToTheLastDropAndTheRestCools)
    {
      cases::Scene scene = slab(unit_material(), 1, 0.3, 0, 7);
      set_boundary(scene, Side::x_min, fixed_wall(-1));
      double arrival[2];
      int which = 0;
      for(const int n : {16, 32})
      {
        const Course record = run(scene, n, "200");
        for(std::size_t i = 0; i < record.time.size(); ++i)
          if(record.first_front[i] >= 0)
            arrival[which] = record.time[i];
        ++which;
        EXPECT_EQ(record.first_front.back(), -1);
        EXPECT_NEAR(record.solid.back(), 1, 1e-12);
        EXPECT_LE(record.worst_budget_defect(), 1e-12);
        // All is at -1 in the end: 0.3 + 1 of sensible heat and 1 of latent heat left.
        EXPECT_NEAR(record.heat.boundary, -2.3, 1e-6);
      }
      EXPECT_NEAR(arrival[0] / arrival[1], 1, 1e-5);
    }

    TEST(Vanishing, ALiquidCoreFreezesToItsCentre)
    {
      cases::Scene scene = ball(unit_material(), 3, 1, 0.2, 0.6);
      set_boundary(scene, Side::outer, fixed_wall(-1));
      const Course record = run(scene, 32);
      EXPECT_EQ(record.first_front.back(), -1);
      EXPECT_NEAR(record.solid.back(), 4 * std::numbers::pi / 3, 1e-8);
      EXPECT_LE(record.worst_budget_defect(), 1e-12);
    }

    TEST(RunSegment, StepsLengthenAndCellsWiden)
    {
      const auto steps = lengthening_steps(0.001, 2, 10, 3);
      ASSERT_EQ(steps.size(), 10u);
      EXPECT_EQ(steps.back().end, 2);
      double last = 0.001;
      for(const StepRange &range : steps)
      {
        EXPECT_NEAR(range.end - range.step, last, 1e-15);
        last = range.end;
      }
      EXPECT_NEAR(std::cbrt(steps[1].end) - std::cbrt(steps[0].end),
                  std::cbrt(steps[9].end) - std::cbrt(steps[8].end), 1e-12);
      const auto forward = widening_shares(1e-4, 1.5, 0.1, true),
                 backward = widening_shares(1e-4, 1.5, 0.1, false);
      EXPECT_EQ(forward.front(), 0.);
      EXPECT_NEAR(forward.back(), 1, 1e-15);
      EXPECT_NEAR(forward[2] - forward[1], 1.5 * forward[1], 1e-15);
      EXPECT_NEAR(1 - backward[backward.size() - 2], forward[1], 1e-15);
    }

    TEST(RunSegment, CellsDrawnToAnEndLeaveTheOthersAsTheyWere)
    {
      const std::vector<double> equal = graded_shares(10, 1, true);
      for(const bool to_lower : {true, false})
      {
        std::vector<double> drawn = drawn_shares(equal, 1e-3, 1.5, to_lower);
        EXPECT_EQ(drawn.front(), 0.);
        EXPECT_EQ(drawn.back(), 1.);
        // Far from that end they are those of before.
        for(const int k : {4, 5, 6})
          EXPECT_LT(std::abs(*std::ranges::min_element(drawn, {},
                                                       [&](double x)
                                                       { return std::abs(x - equal[k]); })
                             - equal[k]),
                    1e-15);
        if(!to_lower)
          std::ranges::reverse(drawn);
        const auto width
            = [&](std::size_t k) { return std::abs(drawn[k + 1] - drawn[k]); };
        EXPECT_NEAR(width(0), 1e-3, 1e-15);
        for(std::size_t k = 0; k + 2 < drawn.size(); ++k)
        {
          EXPECT_LE(width(k + 1) / width(k), 3.01) << k;
          EXPECT_GE(width(k + 1) / width(k), 0.49) << k;
        }
      }
      // Nothing to do where cells are as fine already.
      EXPECT_EQ(drawn_shares(equal, 0.2, 1.5, true), equal);
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted
