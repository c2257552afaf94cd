#include <verification/measure/checks/site_heat.h>
#include <verification/measure/tests/fixtures.h>
#include <verification/studies/crosscheck/state_course.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** Cells of a slab with the temperature x t and solid up to x = t/2. */
    tests::State slab_at(double time)
    {
      constexpr int n = 64;
      tests::State state;
      for(int i = 0; i < n; ++i)
      {
        const double x = (i + 0.5) / n;
        state.positions[0].push_back(x);
        state.weights.push_back(1. / n);
        state.temperature.push_back(x * time);
        state.solid_fraction.push_back(std::clamp(time / 2 * n - i, 0., 1.));
      }
      return state;
    }

    StateCourse course_of_slab(const cases::Scene &scene)
    {
      CourseObserver observer(scene);
      constexpr int steps = 2000;
      for(int step = 0; step <= steps; ++step)
      {
        const double time = static_cast<double>(step) / steps;
        if(step < steps && !observer.wants(step, time))
          continue;
        tests::State state = slab_at(time);
        state.snapshot.step = step;
        observer.observe(state.view(1, time));
      }
      return observer.course();
    }

    TEST(CourseObserver, ReadsMeansAtTheTimesOfTheCourse)
    {
      cases::Scene scene
          = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
      scene.material.latent_heat = 3;
      scene.material.liquid.specific_heat_capacity = 2;
      const StateCourse course = course_of_slab(scene);
      EXPECT_EQ(course.lowest, 0);
      EXPECT_NEAR(course.highest, 1 - 0.5 / 64, 1e-12);
      for(const int k : {6, 12, 18, 24})
      {
        const double time = k / 24.;
        EXPECT_NEAR(course.quantities.at("solid fraction")[k], time / 2, 1e-9);
        // The mean of x weighted with 1, 3, 3, 1 times x^k (1-x)^(3-k) is (k + 1)/5.
        for(int b = 0; b <= 3; ++b)
          EXPECT_NEAR(
              course.quantities.at("temperature near x = " + std::to_string(b) + "/3")[k],
              time * (b + 1) / 5, 1e-3);
        // Solid and liquid hold x t and 2 x t, the liquid 3 besides.
        const double front = time / 2;
        const double heat
            = time * (front * front / 2 + (1 - front * front)) + 3 * (1 - front);
        EXPECT_NEAR(course.quantities.at("heat")[k], heat, 0.02);
      }
    }

    TEST(CourseObserver, ASiteAtAWallIsReadInTheMiddleOfItsVolume)
    {
      const cases::Scene scene
          = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
      CourseObserver observer(scene);
      for(int k = 0; k <= course_intervals; ++k)
      {
        tests::State state;
        state.positions[0] = {1, 0.5};
        state.weights = {0.1, 0.9};
        state.temperature = {0, 0};
        state.solid_fraction = {1, 0};
        const double time = k / double(course_intervals);
        observer.wants(k, time);
        observer.observe(state.view(1, time));
      }
      const auto weight = [](double x) { return 3 * x * x * (1 - x); };
      const double solid = 0.1 * weight(0.95), liquid = 0.9 * weight(0.45);
      EXPECT_NEAR(observer.course().quantities.at("solid fraction near x = 2/3").back(),
                  solid / (solid + liquid), 1e-12);
    }

    cases::Scene slab_scene()
    {
      return tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
    }

    /** Of slab_at() as @p change leaves it, at the times of the course. */
    template <typename Change>
    StateCourse course_of(const cases::Scene &scene, const Change &change)
    {
      CourseObserver observer(scene);
      cases::RunDescription description;
      description.spacing = 1. / 64;
      observer.begin(description);
      for(int step = 0; step <= course_intervals; ++step)
      {
        const double time = step / double(course_intervals);
        tests::State state = slab_at(time);
        state.snapshot.step = step;
        change(step, state);
        observer.observe(state.view(1, time));
      }
      return observer.course();
    }

    /** The same beside a wall of given temperature. */
    template <typename Change>
    StateCourse course_beside(cases::Side side, double (*temperature)(double time),
                              const Change &change)
    {
      cases::Scene scene = slab_scene();
      scene.boundaries[static_cast<std::size_t>(side)]
          = {cases::BoundaryKind::fixed_temperature,
             {"", [temperature](const cases::Position &, double time)
              { return temperature(time); }}};
      return course_of(scene, change);
    }

    // Half of the last cell may hold matter as cold as the wall, 2 K below the site.
    TEST(CourseObserver, ASiteBesideAWallOfGivenTemperatureMayHideALayer)
    {
      const StateCourse course = course_beside(
          cases::Side::x_max, [](double time) { return (1 - 0.5 / 64) * time - 2; },
          [](int, tests::State &) {});
      const double share = std::pow(1 - 0.5 / 64, 3) / 64 / 0.25;
      EXPECT_NEAR(course.misreadings.at("temperature near x = 3/3")[12], share, 1e-4);
      EXPECT_LT(course.misreadings.at("temperature near x = 0/3")[12], 1e-6);
    }

    // Solid beside a wall 3 K below melting, seen by a site that is hardly below it.
    TEST(CourseObserver, ASiteBesideAWallOfGivenTemperatureMayHideHeat)
    {
      const StateCourse course = course_beside(
          cases::Side::x_min, [](double) { return -3.; },
          [](int step, tests::State &state)
          {
            if(step != 6)
              return;
            // Both phases, at the wall's temperature: a layer of either.
            state.temperature[0] = -3;
            state.solid_fraction[0] = 0.5;
          });
      const std::vector<double> misread = course.misreadings.at("heat");
      EXPECT_NEAR(misread[12], (3 + 0.5 * 0.5 / 64) / 2 / 64, 1e-12);
      EXPECT_NEAR(misread[6], 0.5 * 3. / 2 / 64, 1e-12);
      // At the start all is liquid: half of the first cell may be solid.
      EXPECT_NEAR(misread[0], 0.5 / 64, 1e-12);
      EXPECT_NEAR(course.misreadings.at("solid fraction")[0], 0.5 / 64, 1e-12);
    }

    // Up to 0.49 K of sensible and 1 of latent heat per volume; 0.15 are not accounted
    // for.
    TEST(CourseObserver, WhatTheMethodsBookLacksMayBeAnywhere)
    {
      const cases::Scene scene = slab_scene();
      const auto course = course_of(scene,
                                    [&scene](int step, tests::State &state)
                                    {
                                      const SiteHeat held = heat_of_sites(
                                          scene.material, state.view(1, 0));
                                      cases::HeatBudget &heat = state.snapshot.heat;
                                      heat.stored = held.stored + (step == 18 ? 0.05 : 0);
                                      heat.latent = held.latent;
                                      heat.initial = heat.stored + heat.latent - 0.15;
                                      heat.conservative = step != 6;
                                    });
      const auto &misreadings = course.misreadings;
      const double span = (1 - 0.5 / 64) / 2, share = 0.15 / (span + 1);
      EXPECT_NEAR(misreadings.at("solid fraction")[12], share, 1e-12);
      EXPECT_NEAR(misreadings.at("temperature near x = 1/3")[12], share * span, 1e-12);
      EXPECT_NEAR(misreadings.at("heat")[12], 0.15, 1e-12);
      EXPECT_EQ(misreadings.at("solid fraction")[6], 0);
      EXPECT_NEAR(misreadings.at("heat")[18], 0.15 + 0.05, 1e-12); // not seen at sites
    }

    // At t = 1/4 the front of slab_at stands on the edge of a cell; the last one is
    // melting.
    TEST(CourseObserver, AFrontAtAnInsulatedWallIsHalfACellOff)
    {
      cases::Scene scene = slab_scene();
      scene.material.melting_temperature = 0.25;
      const auto course = course_of(scene,
                                    [](int step, tests::State &state)
                                    {
                                      state.snapshot.heat.conservative = false;
                                      if(step != 6)
                                        return;
                                      state.temperature.back() = 0.25;
                                      state.solid_fraction.back() = 0.5;
                                    });
      const auto misread = course.misreadings.at("temperature near x = 0/3");
      EXPECT_NEAR(misread[6], (0.25 - 0.25 * (1 - 1.5 / 64)) / 2, 1e-12);
      EXPECT_EQ(misread[12], 0);
    }

    TEST(CourseObserver, IsKeptAsJson)
    {
      cases::Scene scene
          = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
      scene.material.liquid.density = 2;
      const StateCourse course = course_of_slab(scene);
      EXPECT_FALSE(course.quantities.contains("heat"));
      const auto read
          = nlohmann::json::parse(nlohmann::json(course).dump()).get<StateCourse>();
      EXPECT_EQ(read.highest, course.highest);
      EXPECT_EQ(read.quantities.at("solid fraction"),
                course.quantities.at("solid fraction"));
    }

    TEST(CourseObserver, WithoutChangeOfPhaseThereAreTemperaturesOnly)
    {
      cases::Scene scene
          = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
      scene.material.latent_heat = 0;
      for(const auto &[name, values] : course_of_slab(scene).quantities)
        EXPECT_TRUE(name.starts_with("temperature")) << name;
    }
  } // namespace
} // namespace meltfront::verification
