#include <cases/error.h>
#include <cases/exact/frank.h>
#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <cases/scene.h>
#include <particles/rkpm_tracked/line/tests/cases.h>
#include <particles/rkpm_tracked/tests/tracked_run.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    void start_from(cases::Scene &scene,
                    const std::shared_ptr<const cases::ExactSolution> &exact)
    {
      const auto temperature = [exact](const cases::Position &p, double time)
      { return exact->temperature(p, time); };
      scene.initial.temperature = {"exact", temperature};
      scene.initial.exact = exact;
      const double sign = exact->solid_at_origin() ? 1 : -1;
      scene.initial.front
          = cases::Field{"exact", [exact, sign](const cases::Position &p, double time)
                         { return sign * exact->signed_distance(p, time); }};
      const cases::Boundary wall{
          BoundaryKind::fixed_temperature, {"exact", temperature}, true};
      if(scene.domain.round())
        set_boundary(scene, Side::outer, wall);
      else
        for(const Side side : {Side::x_min, Side::x_max})
          set_boundary(scene, side, wall);
    }

    TEST(RkpmTracked, BarFromTheExactState)
    {
      const auto exact
          = std::make_shared<const cases::PlanarNeumann>(bar_material(), hot, cold);
      const ExactLine line = neumann(bar_material());
      cases::Scene scene = slab(bar_material(), line.time_of(0.06), line.time_of(0.18));
      start_from(scene, exact);
      std::vector<double> errors, defects;
      for(const int n : {40, 80, 160, 320})
      {
        const Course recorder = run(scene, n);
        ASSERT_EQ(recorder.front_points[0].size(), 1U);
        errors.push_back(recorder.front_points[0][0] - 0.18);
        EXPECT_NEAR(recorder.solid.back(), 1 - recorder.front_points[0][0], 1e-12);
        EXPECT_NEAR(recorder.volume.back(), 1, 1e-12);
        EXPECT_EQ(recorder.time.front(), scene.start_time);
        EXPECT_EQ(recorder.time.back(), scene.end_time);
        EXPECT_TRUE(std::ranges::is_sorted(recorder.step));
        defects.push_back(recorder.worst_budget_defect());
        RecordProperty("exact_start_" + std::to_string(n),
                       std::to_string(errors.back() * 1e6) + "e-6");
        RecordProperty("budget_defect_" + std::to_string(n),
                       std::to_string(recorder.worst_budget_defect() * 1e6) + "e-6");
      }
      EXPECT_GE(fitted_order(errors), 1.8);
      EXPECT_LE(std::abs(errors[3]), 1e-5);
      EXPECT_LE(std::ranges::max(defects), 1e-9);
    }

    cases::Scene cold_bar(double end)
    {
      cases::Scene scene = slab(bar_material(), 0, end);
      scene.initial.temperature = cases::Field::uniform(cold);
      set_boundary(scene, Side::x_min, fixed_wall(hot));
      const auto exact
          = std::make_shared<const cases::PlanarNeumann>(bar_material(), hot, cold);
      set_boundary(scene, Side::x_max,
                   {BoundaryKind::fixed_temperature,
                    {"exact", [exact](const cases::Position &p, double time)
                     { return exact->temperature(p[0], time); }},
                    true});
      return scene;
    }

    TEST(RkpmTracked, StartsFromNothing)
    {
      const double end = neumann(bar_material()).time_of(0.18);
      std::vector<double> similar, steady;
      for(const int n : {40, 80, 160, 320})
      {
        const std::pair<std::string, std::string> steps{"steps", std::to_string(n / 2)};
        const Course recorder = run(cold_bar(end), n, {steps});
        similar.push_back(recorder.front_points[0].at(0) - 0.18);
        EXPECT_LE(recorder.worst_budget_defect(), 2e-2);
        steady.push_back(run(cold_bar(end), n, {steps, {"start", "quasi-steady"}})
                             .front_points[0]
                             .at(0)
                         - 0.18);
        RecordProperty("start_" + std::to_string(n),
                       std::to_string(similar.back() * 1e6) + "e-6 similar, "
                           + std::to_string(steady.back() * 1e6) + "e-6 quasi-steady");
      }
      EXPECT_GE(fitted_order(similar), 1.8);
      EXPECT_LE(std::abs(similar[0]), 2.6e-4);
      EXPECT_LE(std::abs(similar[3]), 5e-6);
      EXPECT_GE(fitted_order(steady), 1.8);
      EXPECT_LE(std::abs(steady[0]), 2.8e-4);
      EXPECT_LE(std::abs(steady[3]), 5e-6);
    }

    TEST(RkpmTracked, FreezesFromTheUpperWallAlike)
    {
      // The same slab from the other end.
      cases::Scene scene = cold_bar(0.02), mirrored = scene;
      set_boundary(scene, Side::x_max, fixed_wall(cold));
      set_boundary(mirrored, Side::x_max, fixed_wall(hot));
      set_boundary(mirrored, Side::x_min, fixed_wall(cold));
      EXPECT_NEAR(run(scene, 40).front_points[0].at(0),
                  1 - run(mirrored, 40).front_points[0].at(0), 1e-9);
    }

    TEST(RkpmTracked, BarOfTheReport)
    {
      cases::Scene scene = slab(bar_material(), 0, 1);
      scene.initial.temperature = {"straight", [](const cases::Position &p, double) {
                                     return p[0] < 0.06 ? hot - 70 * p[0] / 0.06
                                                        : 430 - 50 * (p[0] - 0.06) / 0.94;
                                   }};
      set_boundary(scene, Side::x_min, fixed_wall(hot));
      set_boundary(scene, Side::x_max, fixed_wall(cold));
      for(const auto &[mark, front] : {std::pair{0.05, 0.1986270}, {0.2, 0.3204786}})
      {
        scene.end_time = mark;
        EXPECT_NEAR(run(scene, 160).front_points[0].at(0), front, 1e-4) << mark;
      }
    }

    TEST(RkpmTracked, LighterIcePushesTheWater)
    {
      cases::Material material;
      material.latent_heat = 333500;
      material.solid = {2.2, 2090, 917};
      material.liquid = {0.591, 4190, 1000};
      const auto exact = std::make_shared<const cases::PlanarNeumann>(material, -10, 10);
      cases::Scene scene = slab(material, 3600, 86400);
      scene.domain.upper[0] = 0.5;
      start_from(scene, exact);
      std::vector<double> errors;
      for(const int n : {40, 80, 160, 320})
      {
        const Course recorder = run(scene, n);
        errors.push_back(recorder.front_points[0].at(0) - exact->front(86400));
        RecordProperty("lighter_ice_" + std::to_string(n),
                       std::to_string(errors.back() * 1e6) + "e-6, budget "
                           + std::to_string(recorder.worst_budget_defect()));
        EXPECT_LE(recorder.worst_budget_defect(), 1e-2);
      }
      EXPECT_GE(fitted_order(errors), 1.5);
      EXPECT_LE(std::abs(errors[3]) / exact->front(86400), 1e-4);
    }

    TEST(RkpmTracked, DiskAndSphereGrowIntoUndercooledMelt)
    {
      for(const auto symmetry :
          {cases::Symmetry::cylindrical, cases::Symmetry::spherical})
      {
        const auto exact = std::make_shared<const cases::FrankGrowth>(cases::Material{},
                                                                      symmetry, -0.3);
        cases::Scene scene;
        scene.symmetry = symmetry;
        scene.domain.shape = cases::DomainShape::ball;
        scene.domain.dimension = symmetry == cases::Symmetry::cylindrical ? 2 : 3;
        scene.domain.radius = 1;
        const double unit = exact->front(1.);
        scene.start_time = 0.04 / (unit * unit);
        scene.end_time = 0.25 / (unit * unit);
        start_from(scene, exact);
        std::vector<double> errors;
        for(const int n : {80, 160, 320, 640})
        {
          const Course recorder = run(scene, n);
          errors.push_back(recorder.front_points[0].at(0) - 0.5);
          RecordProperty("growth_" + std::to_string(scene.domain.dimension) + "d_"
                             + std::to_string(n),
                         std::to_string(errors.back() * 1e6) + "e-6, budget "
                             + std::to_string(recorder.worst_budget_defect()));
          EXPECT_LE(recorder.worst_budget_defect(), 3e-2);
        }
        EXPECT_GE(fitted_order(errors), 1.7);
        EXPECT_LE(std::abs(errors[3]), scene.domain.dimension == 2 ? 4e-5 : 1.3e-4);
      }
    }

    /** The front at rest in a shell whose walls are held, where what the solid conducts
     * is what the liquid does. */
    double front_at_rest(const cases::Scene &scene, double inner, double outer)
    {
      const bool sphere = scene.symmetry == cases::Symmetry::spherical;
      const double lower = scene.domain.inner_radius, upper = scene.domain.radius;
      const auto resistance = [sphere](double from, double to)
      { return sphere ? 1 / from - 1 / to : std::log(to / from); };
      const double solid = -inner * scene.material.solid.conductivity,
                   liquid = outer * scene.material.liquid.conductivity;
      double below = lower, above = upper;
      for(int i = 0; i < 100; ++i)
      {
        const double middle = (below + above) / 2;
        (solid * resistance(middle, upper) > liquid * resistance(lower, middle) ? below
                                                                                : above)
            = middle;
      }
      return below;
    }

    // Collocated, nodes beside a narrow wall lost the heat that it takes: a front stood
    // at a tenth of its way.
    TEST(RkpmTracked, InnerWallsThatAreHeldHoweverNarrow)
    {
      for(const auto symmetry :
          {cases::Symmetry::cylindrical, cases::Symmetry::spherical})
        for(const double inner_radius : {0.3, 0.1, 0.03, 0.01})
        {
          const double inner = symmetry == cases::Symmetry::spherical ? -4 : -1;
          cases::Scene scene;
          scene.symmetry = symmetry;
          scene.domain.shape = cases::DomainShape::shell;
          scene.domain.dimension = symmetry == cases::Symmetry::cylindrical ? 2 : 3;
          scene.domain.inner_radius = inner_radius;
          scene.domain.radius = 1;
          scene.material.latent_heat = 0.5;
          scene.material.solid.conductivity = 1.5;
          scene.initial.temperature = cases::Field::uniform(0.2);
          scene.end_time = 20;
          set_boundary(scene, Side::inner, fixed_wall(inner));
          set_boundary(scene, Side::outer, fixed_wall(0.2));
          const double exact = front_at_rest(scene, inner, 0.2);
          std::vector<double> errors;
          for(const int n : {20, 40, 80, 160})
          {
            const Course recorder = run(scene, n);
            errors.push_back(recorder.front_points[0].at(0) - exact);
            EXPECT_LE(recorder.worst_budget_defect(), 2e-2) << inner_radius;
            RecordProperty("front_" + std::to_string(scene.domain.dimension) + "d_"
                               + std::to_string(inner_radius) + "_" + std::to_string(n),
                           std::to_string(errors.back() / exact));
          }
          EXPECT_LE(std::abs(errors[0]), 0.05 * exact) << inner_radius;
          EXPECT_LE(std::abs(errors[3]), 0.003 * exact) << inner_radius;
          if(inner_radius < 0.1)
          {
            EXPECT_THROW(run(scene, 20, {{"form", "collocation"}}), cases::Refusal);
          }
        }
    }

    TEST(RkpmTracked, RefusesWhatItCannotFollow)
    {
      cases::Scene scene = cold_bar(0.01);
      EXPECT_THROW(run(scene, 1, {{"wall_spacing", "1"}}), cases::Refusal);
      cases::Scene conduction = scene;
      conduction.material.latent_heat = 0;
      EXPECT_THROW(run(conduction, 20), cases::Refusal);
      cases::Scene periodic = scene;
      set_boundary(periodic, Side::x_max, {BoundaryKind::periodic, {}});
      EXPECT_THROW(run(periodic, 20), cases::Refusal);
      EXPECT_THROW(run(scene, 20, {{"dimension", "2"}}), cases::Refusal);
      cases::Scene two_fronts = scene;
      two_fronts.material.solid.density = 0.9;
      two_fronts.initial.temperature = {"", [](const cases::Position &p, double) {
                                          return p[0] > 0.4 && p[0] < 0.6 ? 440. : 400.;
                                        }};
      EXPECT_THROW(run(two_fronts, 20), cases::Refusal);
    }

    /** By the cubic through the four sites about a place. */
    double temperature_at(const Course &course, double place)
    {
      std::vector<double> x = course.positions[0];
      const auto above
          = static_cast<std::size_t>(std::ranges::upper_bound(x, place) - x.begin());
      double sum = 0;
      for(std::size_t i = above - 2; i < above + 2; ++i)
      {
        double weight = 1;
        for(std::size_t j = above - 2; j < above + 2; ++j)
          if(j != i)
            weight *= (place - x[j]) / (x[i] - x[j]);
        sum += weight * course.temperature[i];
      }
      return sum;
    }

    TEST(RkpmTracked, AWallWithoutAFrontHasItsLayerFromTheFirstMomentOn)
    {
      // Far from the front the liquid is a half-space before the other wall.
      const double end = 0.05, jump = 0.5, flux = 1, distance = 0.2,
                   width = 2 * std::sqrt(end), x = distance / width;
      const double by_jump
          = jump * std::erfc(x),
          by_flux = flux * width
                    * (std::exp(-x * x) / std::sqrt(std::numbers::pi) - x * std::erfc(x));
      for(const bool held : {true, false})
      {
        cases::Scene scene
            = test_support::slab(unit_material(), 4, 0.5, end, fixed_wall(-1),
                                 held ? fixed_wall(0.5 + jump) : flux_wall(flux));
        std::vector<double> errors;
        for(const int n : {40, 80, 160, 320})
        {
          const Course course = run(scene, n);
          const double temperature = temperature_at(course, 4 - distance);
          errors.push_back(temperature - 0.5 - (held ? by_jump : by_flux));
        }
        EXPECT_GE(fitted_order(errors), 1.6) << held;
        EXPECT_LE(std::abs(errors[3]), 1e-4) << held;
      }
    }

    TEST(RkpmTracked, TheLastLiquidAtAnInsulatedWallStaysLiquid)
    {
      // A pipe freezes from inside and drives liquid out; what is left is nearly at the
      // melting temperature, and no second front begins in it.
      cases::Scene scene = slab({}, 0, 0.4);
      scene.symmetry = cases::Symmetry::cylindrical;
      scene.domain.shape = cases::DomainShape::shell;
      scene.domain.dimension = 2;
      scene.domain.inner_radius = 0.5;
      scene.domain.radius = 1.5;
      scene.material.latent_heat = 1;
      scene.material.melting_temperature = 0;
      scene.material.solid = {2, 1, 0.9};
      scene.material.liquid = {1, 1, 1};
      scene.initial.temperature = cases::Field::uniform(0.3);
      set_boundary(scene, Side::inner, fixed_wall(-1));
      set_boundary(scene, Side::outer, {});
      const double finest = run(scene, 160).front_points[0].at(0);
      for(const int n : {20, 30, 40, 50, 60, 80})
        EXPECT_NEAR(run(scene, n).front_points[0].at(0), finest, 8. / (n * n)) << n;
    }

    TEST(RkpmTracked, BodiesVanishAtTheCentreAtAnyResolution)
    {
      // The last of a ball is smaller than round-off of the heat of all.
      for(const int dimension : {2, 3})
        for(const bool melts : {true, false})
        {
          cases::Scene scene = test_support::ball({}, dimension, 1, 0, 0.2);
          scene.material.latent_heat = 0.8;
          const double sign = melts ? 1 : -1;
          const auto level = [](const cases::Position &p)
          { return std::hypot(p[0], p[1], p[2]) - 0.25; };
          scene.initial.temperature
              = {"", [=](const cases::Position &p, double) { return sign * level(p); }};
          scene.initial.front = cases::Field{"", [=](const cases::Position &p, double)
                                             { return sign * level(p); }};
          set_boundary(scene, Side::outer, fixed_wall(sign * 1.2));
          const double all = dimension == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
          for(const int n : {20, 33, 40, 60, 80, 120, 160, 320})
          {
            const Course course = run(scene, n);
            EXPECT_NEAR(course.solid.back(), melts ? 0 : all, 1e-12 * all) << n;
            EXPECT_LE(course.worst_budget_defect(), 1e-4) << n;
          }
        }
    }

    TEST(RkpmTracked, WhatGivesWayMustNotLieAtTheCentre)
    {
      cases::Scene core = slab(bar_material(), 0, 0.01);
      core.symmetry = cases::Symmetry::cylindrical;
      core.domain.shape = cases::DomainShape::ball;
      core.domain.dimension = 2;
      core.domain.radius = 1;
      core.material.solid.density = 0.9;
      core.initial.temperature = cases::Field::uniform(440);
      set_boundary(core, Side::outer,
                   {BoundaryKind::fixed_temperature, cases::Field::uniform(400)});
      EXPECT_THROW(run(core, 20), cases::Refusal);
      EXPECT_NO_THROW(run(core, 20, {{"displaced", "solid"}}));
    }

    // Within a planned step of 0.1 s, and over the end of one.
    TEST(RkpmTracked, APulseOfFluxBringsItsEnergy)
    {
      for(const double begin : {0.523, 0.496})
      {
        cases::Scene scene = slab(bar_material(), 0, 1);
        scene.initial.temperature = cases::Field::uniform(440);
        set_boundary(scene, Side::x_min,
                     {BoundaryKind::flux,
                      {"",
                       [begin](const cases::Position &, double t)
                       { return t >= begin && t < begin + 0.01 ? 100. : 0.; },
                       false,
                       {begin, begin + 0.01}}});
        set_boundary(scene, Side::x_max, {});
        const Course recorder = run(scene, 80, {{"steps", "10"}});
        EXPECT_NEAR(recorder.heat.boundary, 1, 1e-9);
        EXPECT_NEAR(recorder.heat.stored + recorder.heat.latent - recorder.heat.initial,
                    1, 0.03);
      }
    }

    TEST(RkpmTracked, AWallThatIsSwitchedInMidRunFreezesFromThenOn)
    {
      const auto solid_at_end = [](double time)
      {
        cases::Scene scene = slab(bar_material(), 0, 1);
        scene.initial.temperature = cases::Field::uniform(440);
        set_boundary(scene, Side::x_min,
                     {BoundaryKind::fixed_temperature,
                      {"",
                       [time](const cases::Position &, double t)
                       { return t < time ? 440. : cold; },
                       false,
                       {time}}});
        set_boundary(scene, Side::x_max, {});
        return run(scene, 40, {{"steps", "10"}}).solid.back();
      };
      const double one = solid_at_end(0.501), other = solid_at_end(0.499);
      EXPECT_GT(one, 0.1);
      EXPECT_NEAR(one / other, std::sqrt(0.499 / 0.501), 2e-3);
    }
  } // namespace
} // namespace meltfront::particles::rkpm_tracked
