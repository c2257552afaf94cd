#include <cases/error.h>
#include <cases/exact/manufactured/manufactured_solution.h>
#include <reference_fem/cut/tests/cut_support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double round_off = 1e-11;

    Course run_conservative(const Scene &scene, int n, OptionTexts options = {})
    {
      options.emplace_back("scheme", "conservative");
      return run_cut(scene, n, options);
    }

    /** A manufactured front in a disk of radius 1, or in a box that is shifted against
     * its lattice. */
    struct Manufactured
    {
      explicit Manufactured(const std::string &family)
        : Manufactured(family, ball(unit_material(), 2, 1, 0, 0.3))
      {
      }

      Manufactured(const std::string &family, int n, const std::array<double, 2> &shift)
        : Manufactured(family,
                       box(unit_material(), 2,
                           {-1 + 2 * shift[0] / n, -1 + 2 * shift[1] / n, 0},
                           {1 + 2 * shift[0] / n, 1 + 2 * shift[1] / n, 0}, 0, 0.3))
      {
      }

      Manufactured(const std::string &family, const Scene &empty)
        : exact(std::make_shared<ManufacturedSolution>(
            unit_material(), make_front_family({family, 2, 1}), 1))
        , scene(empty)
      {
        for(const Side side : scene.sides())
          set_boundary(scene, side, exact_wall(exact));
        start_from(scene, exact);
        scene.volumetric_source
            = Field{"exact", [exact = exact](const Position &p, double time)
                    { return exact->volumetric_source(p, time); }};
      }

      double area_error(const Course &course) const
      {
        double most = 0;
        for(std::size_t i = 0; i < course.time.size(); ++i)
          most = std::max(
              most, std::abs(course.solid[i] - exact->solid_volume(course.time[i])));
        return most;
      }

      double temperature_error(const Course &course) const
      {
        double sum = 0;
        for(std::size_t i = 0; i < course.weights.size(); ++i)
          sum += course.weights[i]
                 * std::pow(course.temperature[i]
                                - exact->temperature(course.place(i), course.time.back()),
                            2);
        return std::sqrt(sum);
      }

      std::shared_ptr<const ManufacturedSolution> exact;
      Scene scene;
    };

    const OptionTexts steps_of_half_a_cell{{"fewest_steps", "10"}, {"cfl", "0.5"}};

    TEST(ConservativeCut, CurvedFrontsConvergeAtSecondOrder)
    {
      const std::vector<int> n{20, 24, 32, 40};
      // Of the ellipse's area 1.7 is reached where 1.8 is wanted: red in the matrix
      // `manufactured`, a guard here.
      const std::vector<std::pair<const char *, double>> families{{"star-3", 1.8},
                                                                  {"ellipse", 1.6}};
      for(const auto &[family, order_of_area] : families)
      {
        const Manufactured front(family);
        std::vector<double> area, temperature;
        for(const int cells : n)
        {
          const Course course
              = run_conservative(front.scene, cells, steps_of_half_a_cell);
          EXPECT_LE(course.worst_budget_defect(), round_off) << family << cells;
          area.push_back(front.area_error(course));
          temperature.push_back(front.temperature_error(course));
        }
        EXPECT_GE(fitted_order(n, area), order_of_area) << family;
        EXPECT_GE(fitted_order(n, temperature), 1.8) << family;
      }
    }

    TEST(ConservativeCut, FrontsStartAnywhereInTheLattice)
    {
      // A single step: that no start is refused, with the exact area.
      // At n = 16 the ellipse is 2 cells across, and refused for that.
      for(const int n : {20, 24, 32, 48, 64})
        for(int shift = 0; shift < 10; ++shift)
        {
          Manufactured front(shift % 2 == 0 ? "star-3" : "ellipse", n,
                             {0.1 * shift, std::fmod(0.37 * shift, 1)});
          front.scene.end_time = 1e-6;
          const Course course = run_conservative(front.scene, n, {{"fewest_steps", "1"}});
          EXPECT_LE(std::abs(course.solid.front() - front.exact->solid_volume(0)),
                    0.02 / n / n)
              << n << ' ' << shift;
        }
    }

    TEST(ConservativeCut, StepsMayBeShort)
    {
      // A twentieth of a cell, until the front has crossed two or three.
      for(const int shift : {0, 3, 7})
      {
        Manufactured front("star-3", 24, {0.1 * shift, 0.04 * shift});
        front.scene.end_time = 0.1;
        const Course course = run_conservative(front.scene, 24, {{"cfl", "0.05"}});
        EXPECT_LE(course.worst_budget_defect(), round_off);
        EXPECT_LE(front.area_error(course), 3e-3);
      }
    }

    /** Ice about a sink in water, from the exact state with a radius of a fifth of the
     * disk's. */
    Scene started_sink(const std::shared_ptr<const LineSink> &exact)
    {
      Scene scene = sink_in_disk(exact);
      scene.start_time = end_of_sink / 4;
      start_from(scene, exact);
      return scene;
    }

    double area_error(const Course &course, const LineSink &exact)
    {
      double most = 0;
      for(std::size_t i = 0; i < course.time.size(); ++i)
        most = std::max(most, std::abs(std::sqrt(course.solid[i] / std::numbers::pi)
                                       - exact.front(course.time[i])));
      return most;
    }

    TEST(ConservativeCut, SinksOfAnyStrengthConvergeAtSecondOrder)
    {
      const std::vector<int> n{24, 32, 48};
      for(const double lambda : {0.05, 0.4})
      {
        const auto exact = std::make_shared<LineSink>(water(), lambda, 10);
        Scene scene = started_sink(exact);
        scene.end_time = 0.0225 / std::pow(exact->front(1), 2);
        scene.start_time = scene.end_time / 2.5;
        start_from(scene, exact);
        std::vector<double> errors;
        for(const int cells : n)
        {
          const Course course
              = run_conservative(scene, cells, {{"fewest_steps", "10"}, {"cfl", "0.5"}});
          EXPECT_LE(course.worst_budget_defect(), round_off);
          EXPECT_TRUE(grows(course));
          errors.push_back(area_error(course, *exact));
        }
        EXPECT_GE(fitted_order(n, errors), 1.8) << lambda;
      }
    }

    TEST(ConservativeCut, MorePassesChangeNothing)
    {
      const Manufactured front("star-3");
      std::vector<double> solid, error;
      for(const char *passes : {"6", "30"})
      {
        OptionTexts options = steps_of_half_a_cell;
        options.emplace_back("passes", passes);
        const Course course = run_conservative(front.scene, 24, options);
        solid.push_back(course.solid.back());
        error.push_back(front.area_error(course));
      }
      EXPECT_LE(std::abs(solid[0] - solid[1]), 0.01 * error[1]);
    }

    TEST(ConservativeCut, SinksSeedFrontsInWater)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      const std::vector<int> n{24, 48};
      std::vector<double> errors;
      for(const int cells : n)
      {
        const Course course
            = run_conservative(sink_in_disk(exact), cells, {{"fewest_steps", "50"}});
        EXPECT_TRUE(grows(course));
        errors.push_back(front_error(course, *exact));
      }
      // About 2.8e-4 at last: the seed's error is of first order where it is largest, see
      // README.md.
      EXPECT_GE(fitted_order(n, errors), 1);
      EXPECT_LE(errors.back(), 4e-4);
    }

    TEST(ConservativeCut, WhateverPassesLeaveOverNoHeatIsLost)
    {
      const Manufactured front("star-3");
      OptionTexts options = steps_of_half_a_cell;
      options.emplace_back("passes", "2");
      EXPECT_LE(run_conservative(front.scene, 24, options).worst_budget_defect(),
                round_off);
    }

    TEST(ConservativeCut, DisksMerge)
    {
      const Course course = run_conservative(disks({{-0.36, 0, 0}, {0.36, 0, 0}}, 0.3),
                                             36, {{"fewest_steps", "40"}});
      EXPECT_TRUE(grows(course));
      EXPECT_GT(course.solid.back(), 0.95);
      EXPECT_LE(course.worst_budget_defect(), round_off);
    }

    /** Disks of ice in warm liquid, without sinks. */
    Scene melting(const std::vector<Position> &places)
    {
      Scene scene = disks(places, 0.1);
      scene.sources.clear();
      scene.initial.temperature
          = {"warm", [front = scene.initial.front->value](const Position &p, double time)
             { return std::max(0., 1.5 * (1 - std::exp(-8 * front(p, time)))); }};
      return scene;
    }

    TEST(ConservativeCut, BodiesVanish)
    {
      const Course course = run_conservative(melting({{-0.5, 0.03, 0}, {0.38, -0.01, 0}}),
                                             40, {{"fewest_steps", "40"}});
      EXPECT_EQ(course.solid.back(), 0);
      EXPECT_TRUE(std::ranges::is_sorted(course.solid, std::greater()));
      EXPECT_LE(course.worst_budget_defect(), round_off);
    }

    TEST(ConservativeCut, ABridgeOfSolidPartsInTwo)
    {
      Scene scene = disks({{-0.36, 0, 0}, {0.36, 0, 0}}, 0.065);
      const auto dumbbell = [](const Position &p)
      {
        const double ends
            = std::min(std::hypot(p[0] + 0.4, p[1]), std::hypot(p[0] - 0.4, p[1])) - 0.3;
        return std::min(ends, std::max(std::abs(p[1]) - 0.11, std::abs(p[0]) - 0.4));
      };
      scene.sources.clear();
      scene.initial.front = field_of(dumbbell);
      scene.initial.temperature
          = field_of([dumbbell](const Position &p)
                     { return std::max(0., 1.5 * (1 - std::exp(-8 * dumbbell(p)))); });
      const Course course = run_conservative(scene, 48, {{"fewest_steps", "40"}});
      EXPECT_GT(course.solid.back(), 0.03);
      EXPECT_LE(course.worst_budget_defect(), round_off);
      double nearest = 1;
      for(std::size_t i = 0; i < course.weights.size(); ++i)
        if(course.solid_fraction[i] > 0.5 && course.weights[i] > 0)
          nearest = std::min(nearest, std::abs(course.positions[0][i]));
      EXPECT_GT(nearest, 0.02);
    }

    TEST(ConservativeCut, WhatItDoesNotKnowIsRefused)
    {
      const Scene scene = disks({{0.03, 0.01, 0}}, 0.1);
      EXPECT_THROW(run_conservative(scene, 36, {{"degree", "2"}}), Refusal);
      EXPECT_THROW(run_conservative(scene, 36, {{"refinement", "1"}}), Refusal);
      EXPECT_THROW(run_conservative(scene, 36, {{"speed_smoothing", "1"}}), Refusal);
      EXPECT_THROW(run_conservative(scene, 8), Refusal);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
