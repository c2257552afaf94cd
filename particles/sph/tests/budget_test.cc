#include <cases/error.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>
#include <particles/sph/time/time_stepping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();
    constexpr double pi = std::numbers::pi;

    TEST(Budget, SinkRemovesExactlyItsHeat)
    {
      for(const auto &m : {make_sph(), make_sph_2005()})
      {
        const Problem problem = line_sink();
        const Outcome outcome = run(*m, problem, 20);
        const double removed = problem.scene.sources[0].energy(475000);
        EXPECT_NEAR(outcome.heat.sources, removed, 1e-14 * std::abs(removed));
        const double change
            = outcome.heat.stored + outcome.heat.latent - outcome.heat.initial;
        EXPECT_NEAR(change, removed, 1e-12 * outcome.heat.initial);
        EXPECT_EQ(outcome.heat.boundary, 0);
      }
    }

    // A flux into one wall and out of the other: the steady gradient is -q/k.
    TEST(Budget, FluxThroughASlab)
    {
      for(const char *layout : {"cell", "edge"})
        for(const char *dimension : {"1", "2"})
        {
          Problem problem;
          cases::Material material = unit_material(100);
          material.solid.conductivity = 2;
          problem.scene = slab(material, 1, 1, 3, flux_wall(6), fixed_wall(1));
          const Outcome outcome
              = run(*method, problem, 20, {{"layout", layout}, {"dimension", dimension}});
          EXPECT_LE(outcome.largest_defect, 1e-12);
          const bool cell = std::string(layout) == "cell";
          for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
            EXPECT_NEAR(outcome.temperature[i], 1 + 3 * (1 - outcome.position_x[i]),
                        cell ? 2e-3 : 0.3);
        }
    }

    TEST(Budget, FluxIntoBoxAndBall)
    {
      for(int dimension = 2; dimension <= 3; ++dimension)
      {
        Problem box;
        box.scene = unit_box(dimension, unit_material(100), 1, 0.5);
        for(int side = 0; side < 2 * dimension; ++side)
          box.scene.boundaries[side] = flux_wall(0.25);
        const Outcome in_box = run(*method, box, 10);
        EXPECT_NEAR(in_box.heat.boundary, 0.5 * 0.25 * 2 * dimension, 1e-12);
        EXPECT_LE(in_box.largest_defect, 1e-12);

        Problem ball;
        ball.scene = box.scene;
        ball.scene.symmetry
            = dimension == 2 ? cases::Symmetry::cylindrical : cases::Symmetry::spherical;
        ball.scene.domain.shape = cases::DomainShape::ball;
        ball.scene.domain.radius = 0.5;
        ball.scene.boundaries = {};
        ball.scene.boundaries[static_cast<int>(cases::Side::outer)] = flux_wall(0.25);
        const Outcome in_ball = run(*method, ball, 12);
        EXPECT_NEAR(in_ball.heat.boundary, 0.5 * 0.25 * pi, 1e-12);
        EXPECT_LE(in_ball.largest_defect, 1e-12);
      }
    }

    // The lattice's cells miss the volume by up to some per cent, the particles do not.
    TEST(Budget, ARoundDomainHoldsWhatItsVolumeHolds)
    {
      for(const char *scheme : {"rkl2", "euler", "crank-nicolson"})
        for(const int dimension : {2, 3})
          for(const int n : {12, 17})
          {
            Problem problem;
            cases::Scene &scene = problem.scene;
            scene.symmetry = dimension == 2 ? cases::Symmetry::cylindrical
                                            : cases::Symmetry::spherical;
            scene.domain = {cases::DomainShape::ball, dimension, {}, {}, 0.5, 0};
            scene.material = unit_material(100);
            scene.initial.temperature = cases::Field::uniform(1);
            scene.boundaries[static_cast<int>(cases::Side::outer)] = flux_wall(0.25);
            scene.volumetric_source = cases::Field::uniform(0.7);
            scene.end_time = 0.3;
            const Outcome outcome = run(*method, problem, n, {{"time_scheme", scheme}});
            double volume = 0, heat = 0;
            for(std::size_t i = 0; i < outcome.weights.size(); ++i)
            {
              volume += outcome.weights[i];
              heat += outcome.weights[i] * (outcome.temperature[i] - 1);
            }
            const double exact = dimension == 2 ? pi / 4 : pi / 6;
            EXPECT_NEAR(volume, exact, 1e-13);
            // Heat comes in through d/R of wall for each volume.
            EXPECT_NEAR(heat / volume, 0.3 * (0.25 * dimension / 0.5 + 0.7), 1e-10);
            EXPECT_NEAR(outcome.heat.sources, 0.3 * 0.7 * exact, 1e-12);
            EXPECT_LE(outcome.largest_defect, 1e-12);
          }
    }

    // A mode cos(pi x) cos(pi y) decays with exp(-2 pi^2 t) between insulated walls.
    TEST(Budget, InsulatedBoxKeepsItsHeat)
    {
      Problem problem;
      problem.scene = unit_box(2, unit_material(100), 0, 0.05);
      problem.scene.domain.lower = {0, 0, 0};
      problem.scene.domain.upper = {1, 1, 0};
      problem.scene.initial.temperature
          = {"cos(pi x) cos(pi y)",
             [](const cases::Position &p, double)
             { return std::cos(pi * p[0]) * std::cos(pi * p[1]); },
             false};
      const Outcome outcome = run(*method, problem, 32);
      const double amplitude
          = std::cos(pi / 64) * std::cos(pi / 64) * std::exp(-2 * pi * pi * 0.05);
      EXPECT_NEAR(outcome.highest, std::pow(std::cos(pi / 64), 2), 1e-12);
      double largest = 0;
      for(const double t : outcome.temperature)
        largest = std::max(largest, t);
      EXPECT_NEAR(largest, amplitude, 2e-3);
      EXPECT_EQ(outcome.heat.boundary, 0);
      EXPECT_LE(outcome.largest_defect, 1e-13);
    }

    // A wave over the period of a box decays alike; the temperature of the walls across
    // does not matter for it.
    TEST(Budget, PeriodicBox)
    {
      Problem problem;
      problem.scene = unit_box(2, unit_material(100), 0, 0.02);
      problem.scene.boundaries[0] = problem.scene.boundaries[1] = periodic_wall();
      problem.scene.initial.temperature
          = {"sin(2 pi x)",
             [](const cases::Position &p, double) { return std::sin(2 * pi * p[0]); },
             false};
      const Outcome outcome = run(*method, problem, 40);
      const double decay = std::exp(-4 * pi * pi * 0.02);
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        EXPECT_NEAR(outcome.temperature[i],
                    decay * std::sin(2 * pi * outcome.position_x[i]), 3e-3);
      EXPECT_LE(outcome.largest_defect, 1e-13);
    }

    // A disk whose rim is held: J0 decays with its first zero, 2.404825557695773.
    TEST(Budget, DiskWithARimAtATemperature)
    {
      std::vector<double> spacing, errors;
      for(const int n : {20, 30, 40, 60, 80})
      {
        Problem problem;
        problem.scene = unit_box(2, unit_material(100), 0, 0.02);
        problem.scene.domain.shape = cases::DomainShape::ball;
        problem.scene.domain.radius = 0.5;
        problem.scene.symmetry = cases::Symmetry::cylindrical;
        problem.scene.boundaries = {};
        problem.scene.boundaries[static_cast<int>(cases::Side::outer)] = fixed_wall(0);
        const double zero = 2 * 2.404825557695773;
        const auto mode = [zero](double r) { return std::cyl_bessel_j(0, zero * r); };
        problem.scene.initial.temperature = {"J0",
                                             [mode](const cases::Position &p, double)
                                             { return mode(std::hypot(p[0], p[1])); },
                                             false};
        const Outcome outcome = run(*method, problem, n);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        double kept = 0, whole = 0;
        for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        {
          kept += outcome.weights[i] * outcome.temperature[i];
          whole += outcome.weights[i];
        }
        EXPECT_NEAR(whole, pi / 4, 0.03);
        // Integral of J0(a r) over the disk: 2 pi R J1(a R)/a.
        const double exact = 2 * pi * 0.5 * std::cyl_bessel_j(1, zero / 2) / zero
                             * std::exp(-zero * zero * 0.02);
        spacing.push_back(outcome.description.spacing);
        errors.push_back(std::abs(kept - exact) / exact);
      }
      EXPECT_LE(errors.back(), 1e-3);
      EXPECT_GE(fitted_order(spacing, errors), 1.8);
    }

    // The mirror image of a sink scene about the axes is the scene itself.
    TEST(Budget, KeepsTheSymmetryOfTheScene)
    {
      const Outcome outcome = run(*method, line_sink(100000), 20);
      const std::size_t n = outcome.temperature.size();
      ASSERT_EQ(n, 400u);
      double worst = 0;
      for(std::size_t i = 0; i < n; ++i)
      {
        // Some particle has the opposite x and the same temperature.
        double nearest = 1e300;
        for(std::size_t j = 0; j < n; ++j)
          if(outcome.position_x[j] == -outcome.position_x[i])
            nearest = std::min(nearest,
                               std::abs(outcome.temperature[i] - outcome.temperature[j]));
        worst = std::max(worst, nearest);
      }
      EXPECT_LE(worst, 1e-10);
    }

    TEST(Budget, SameBitsForOneAndTwoThreads)
    {
      Problem short_disk = line_sink_in_disk();
      short_disk.scene.end_time = 5000;
      // Large enough for passes to be shared.
      const std::vector<std::pair<Problem, int>> problems{{line_sink(5000), 96},
                                                          {short_disk, 108}};
      for(const auto &[problem, n] : problems)
        for(const auto &m : {make_sph(), make_sph_2005()})
        {
          const Outcome one = run(*m, problem, n);
          const Outcome two = run(*m, problem, n, {}, 1, 2);
          ASSERT_EQ(one.temperature.size(), two.temperature.size());
          EXPECT_GT(one.temperature.size(), 8192u);
          EXPECT_EQ(std::memcmp(one.temperature.data(), two.temperature.data(),
                                one.temperature.size() * sizeof(double)),
                    0);
          EXPECT_EQ(one.heat.boundary, two.heat.boundary);
          EXPECT_EQ(one.cost.work, two.cost.work);
        }
    }

    TEST(Budget, ReachesTheEndExactlyAndDescribesTheRun)
    {
      const Outcome outcome = run(*method, plane_freezing(), 50);
      EXPECT_DOUBLE_EQ(outcome.description.spacing, 0.02);
      EXPECT_DOUBLE_EQ(outcome.description.smoothing_length, 0.02);
      EXPECT_NEAR(outcome.description.time_step * outcome.cost.steps, 0.0568, 1e-15);
      EXPECT_EQ(outcome.description.unknowns, 50);
      EXPECT_EQ(outcome.cost.unknowns, 50);
      EXPECT_GE(outcome.cost.steps, 200);
      EXPECT_GT(outcome.cost.work, outcome.cost.steps * 50);
    }

    TEST(Budget, RefusesADimensionThatABoxDoesNotHave)
    {
      EXPECT_THROW(run(*method, line_sink(), 20, {{"dimension", "3"}}), cases::Refusal);
    }

    /** y' = -y over unit time in so many super steps of s stages. */
    double decay(int stages, int steps)
    {
      const SuperStep super(stages);
      double y = 1;
      const double step = 1. / steps;
      for(int i = 0; i < steps; ++i)
      {
        const double first = y;
        double before = y;
        y += super.first_rate * step * -first;
        for(const SuperStage &stage : super.stages)
        {
          const double next = stage.previous * y + stage.before * before
                              + stage.start * first
                              - step * (stage.rate * y + stage.start_rate * first);
          before = y;
          y = next;
        }
      }
      return y;
    }

    TEST(TimeStepping, SuperStepsAreOfSecondOrder)
    {
      for(const int stages : {3, 4, 5, 8, 16})
      {
        std::vector<double> step, error;
        for(const int steps : {4, 8, 16, 32, 64})
        {
          step.push_back(1. / steps);
          error.push_back(std::abs(decay(stages, steps) - std::exp(-1)));
        }
        EXPECT_NEAR(fitted_order(step, error), 2, 0.1) << stages;
      }
    }

    TEST(TimeStepping, SuperStepsAreStableUpToTheirReach)
    {
      for(const int stages : {3, 4, 5, 8, 16, 33})
      {
        const SuperStep super(stages);
        // |R(z)| <= 1 for all -2 reach <= z <= 0.
        for(int i = 0; i <= 1000; ++i)
        {
          const double z = -2 * super_step_reach(stages) * i / 1000.;
          double before = 1, y = 1 + super.first_rate * z;
          for(const SuperStage &stage : super.stages)
          {
            const double next = stage.previous * y + stage.before * before + stage.start
                                + z * (stage.rate * y + stage.start_rate);
            before = y;
            y = next;
          }
          ASSERT_LE(std::abs(y), 1 + 1e-12) << stages << ' ' << z;
        }
      }
    }

    // Solid up to 0.2529, which is in a cell of every resolution, with and without words
    // about the front; the temperature has a kink there.
    TEST(Start, CellsThatAFrontCutsHoldTheHeatOfBothSides)
    {
      constexpr double front = 0.2529;
      const cases::Field excess{"", [](const cases::Position &p, double)
                                { return p[0] - front; }};
      for(const bool stated : {false, true})
        for(const int n : {20, 32, 40, 52})
        {
          Problem problem;
          const cases::Material material = unit_material();
          problem.scene = slab(material, 1, 0, 1e-3, {}, {});
          problem.scene.initial.temperature
              = {"", [&](const cases::Position &p, double)
                 {
                   const double beyond = p[0] - front;
                   return material.melting_temperature
                          + (beyond < 0 ? 3 * beyond : 2 * beyond);
                 }};
          if(stated)
            problem.scene.initial.front = excess;
          const double expected = -3 * front * front / 2 + (1 - front) * (1 - front)
                                  + material.latent_heat * (1 - front);
          EXPECT_NEAR(run(*make_sph(), problem, n).heat.initial, expected, 1e-12) << n;
        }
    }
  } // namespace
} // namespace meltfront::particles::testing
