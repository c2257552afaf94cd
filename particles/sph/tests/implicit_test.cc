#include <cases/error.h>
#include <particles/sph/heat_flow.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>
#include <particles/sph/time/banded_solver.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();

    /** Time step as in the published rule, 0.15 c rho h^2/k, times a factor: what the
     * option step_factor has to be, given the largest step that keeps the maximum
     * principle in one dimension and the cell layout. */
    std::string factor_of_published(double factor, const Problem &problem, int n,
                                    const OptionTexts &options)
    {
      OptionTexts published = options;
      published.push_back({"time_scheme", "backward-euler"});
      published.push_back({"step_factor", "1"});
      Problem brief = problem;
      brief.scene.end_time = 1e-3 * problem.scene.end_time;
      const Outcome outcome = run(*method, brief, n, published);
      const double monotone = brief.scene.end_time / outcome.cost.steps;
      const double h = outcome.description.smoothing_length;
      return std::to_string(factor * 0.15 * h * h / monotone);
    }

    // On a line of particles with h = dp the corrected rows are the three-point
    // differences, so that cos(pi x) decays with lambda = 2 (1 - cos(pi dp))/dp^2.
    struct DecayingMode
    {
      explicit DecayingMode(int n)
        : dp(1. / n)
        , lambda(2 * (1 - std::cos(std::numbers::pi * dp)) / (dp * dp))
      {
        problem.scene = slab(unit_material(100), 1, 0, end, {}, {});
        problem.scene.initial.temperature = {"cos(pi x)",
                                             [](const cases::Position &p, double) {
                                               return std::cos(std::numbers::pi * p[0]);
                                             },
                                             false};
      }

      /** Amplitude at the end, over that at the start, and the number of steps. */
      std::pair<double, long> amplitude(const char *scheme, double factor) const
      {
        const Outcome outcome
            = run(*method, problem, static_cast<int>(std::lround(1 / dp)),
                  {{"time_scheme", scheme}, {"step_factor", std::to_string(factor)}});
        double product = 0, square = 0;
        for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        {
          const double mode = std::cos(std::numbers::pi * outcome.position_x[i]);
          product += mode * outcome.temperature[i];
          square += mode * mode;
        }
        EXPECT_LE(outcome.largest_defect, 1e-13);
        return {product / square, outcome.cost.steps};
      }

      static constexpr double end = 0.1;
      double dp, lambda;
      Problem problem;
    };

    TEST(Implicit, AModeDecaysByTheSchemesOwnFactors)
    {
      const DecayingMode mode(32);
      for(const double factor : {4., 16., 60.})
      {
        const auto [euler, steps] = mode.amplitude("backward-euler", factor);
        const double z = mode.lambda * mode.end / steps;
        EXPECT_NEAR(euler, std::pow(1 + z, -steps), 1e-9);
        const auto [trapezoidal, same] = mode.amplitude("crank-nicolson", factor);
        ASSERT_EQ(same, steps);
        ASSERT_GT(steps, 2);
        EXPECT_NEAR(trapezoidal,
                    std::pow(1 + z / 2, -4)
                        * std::pow((1 - z / 2) / (1 + z / 2), steps - 2),
                    1e-9);
      }
    }

    TEST(Implicit, OrdersInTime)
    {
      const DecayingMode mode(32);
      const double exact = std::exp(-mode.lambda * mode.end);
      for(const auto &[scheme, low, high] : {std::tuple{"backward-euler", 0.95, 1.05},
                                             std::tuple{"crank-nicolson", 1.9, 2.3}})
      {
        std::vector<double> step, error;
        for(const double factor : {40., 20., 10., 5.})
        {
          const auto [amplitude, steps] = mode.amplitude(scheme, factor);
          step.push_back(mode.end / steps);
          error.push_back(std::abs(amplitude - exact));
        }
        const double order = fitted_order(step, error);
        EXPECT_GE(order, low) << scheme;
        EXPECT_LE(order, high) << scheme;
      }
    }

    // Errors that an independent code found for steps of 4, 16 and 60 published ones,
    // with a margin of 30 per cent above them; below them is better.
    TEST(Implicit, PlaneFreezingWithLongSteps)
    {
      const OptionTexts options{{"smoothing_length", "1.3"}, {"front", "partner"}};
      for(const auto &[scheme, factor, known] :
          {std::tuple{"backward-euler", 4., 1.642e-3},
           std::tuple{"backward-euler", 16., 1.833e-3},
           std::tuple{"backward-euler", 60., 2.304e-3},
           std::tuple{"crank-nicolson", 4., 1.568e-3},
           std::tuple{"crank-nicolson", 16., 1.478e-3}})
      {
        OptionTexts all = options;
        all.push_back({"time_scheme", scheme});
        all.push_back(
            {"step_factor", factor_of_published(factor, plane_freezing(), 80, options)});
        const Outcome outcome = run(*method, plane_freezing(), 80, all);
        EXPECT_LE(outcome.front_rms, 1.3 * known) << scheme << " " << factor;
        EXPECT_LE(outcome.largest_defect, 1e-13);
      }
    }

    // The front converges to that of tiny explicit steps, which have the same particles.
    TEST(Implicit, TheFrontConvergesInTime)
    {
      const Problem problem = plane_freezing_water();
      const Outcome fine = run(*method, problem, 40,
                               {{"time_scheme", "euler"}, {"step_factor", "0.25"}});
      for(const auto &[scheme, order] :
          {std::pair{"backward-euler", 0.7}, std::pair{"crank-nicolson", 0.7}})
      {
        std::vector<double> step, error;
        for(const char *factor : {"128", "32", "8", "2"})
        {
          const Outcome outcome = run(*method, problem, 40,
                                      {{"time_scheme", scheme}, {"step_factor", factor}});
          double sum = 0;
          for(std::size_t i = 0; i < fine.temperature.size(); ++i)
            sum += std::abs(outcome.temperature[i] - fine.temperature[i]);
          step.push_back(1. / outcome.cost.steps);
          error.push_back(sum);
        }
        EXPECT_GE(fitted_order(step, error), order) << scheme;
      }
    }

    TEST(Implicit, HoldsForEveryStefanNumberAndConductivity)
    {
      cases::Material contrast = unit_material(0);
      contrast.liquid.conductivity = 1e5;
      // The last factor makes steps that the front crosses several particles in.
      const std::tuple<Problem, std::vector<const char *>> scenes[]
          = {{freezing_slab(unit_material(1), 0.99, 1.01, 1, 0.5), {"60", "1000"}},
             {freezing_slab(unit_material(0), -100, 20, 1, 0.01), {"4", "60"}},
             {freezing_slab(contrast, -1, 1, 1, 0.05), {"1e5", "1e6"}},
             {plane_contrast(), {"16", "200"}}};
      for(const auto &[problem, factors] : scenes)
        for(const char *factor : factors)
          for(const char *scheme : {"backward-euler", "crank-nicolson"})
            for(const char *rule : {"sub_particle", "partner"})
            {
              Outcome outcome;
              ASSERT_NO_THROW(outcome = run(*method, problem, 40,
                                            {{"time_scheme", scheme},
                                             {"front", rule},
                                             {"step_factor", factor}}))
                  << scheme << " " << rule << " " << factor;
              EXPECT_LE(outcome.largest_defect, 1e-13);
            }
    }

    TEST(Implicit, TheEdgeLayoutBooksTheHeatOfItsWalls)
    {
      for(const char *scheme : {"backward-euler", "crank-nicolson"})
        for(const auto &problem : {plane_freezing(), line_sink(100000)})
        {
          const Outcome outcome
              = run(*method, problem, 20,
                    {{"time_scheme", scheme}, {"layout", "edge"}, {"step_factor", "30"}});
          EXPECT_LE(outcome.largest_defect, 1e-13) << scheme;
          EXPECT_EQ(outcome.cost.capped_steps, 0);
        }
    }

    TEST(Implicit, TheSameBitsForAnyNumberOfThreads)
    {
      const Problem problem = line_sink(2000);
      const OptionTexts options{{"time_scheme", "crank-nicolson"}, {"step_factor", "60"}};
      const Outcome one = run(*method, problem, 96, options, 1, 1);
      ASSERT_GT(one.temperature.size(), 8192u); // shared among threads from here on
      for(const int threads : {2, 3})
        EXPECT_EQ(run(*method, problem, 96, options, 1, threads).temperature,
                  one.temperature);
    }

    TEST(Implicit, StepsFollowTheWantedError)
    {
      for(const char *scheme : {"backward-euler", "crank-nicolson"})
      {
        const Problem problem = plane_freezing_water();
        const Outcome fine = run(*method, problem, 40,
                                 {{"time_scheme", "euler"}, {"step_factor", "0.25"}});
        std::vector<double> error;
        std::vector<long> steps;
        for(const char *wanted : {"1e-2", "1e-3", "1e-4", "1e-5"})
        {
          const Outcome outcome = run(*method, problem, 40,
                                      {{"time_scheme", scheme}, {"step_error", wanted}});
          double sum = 0;
          for(std::size_t i = 0; i < fine.temperature.size(); ++i)
            sum += std::abs(outcome.temperature[i] - fine.temperature[i]);
          error.push_back(sum);
          steps.push_back(outcome.cost.steps);
          EXPECT_LE(outcome.largest_defect, 1e-13);
        }
        EXPECT_LT(steps.front(), fine.cost.steps / 20);
        for(std::size_t i = 1; i < steps.size(); ++i)
          EXPECT_GT(steps[i], steps[i - 1]) << scheme;
        EXPECT_LT(error.back(), 0.2 * error.front()) << scheme;
      }
    }

    TEST(Implicit, ErrorsOfStepsAreForImplicitSchemes)
    {
      EXPECT_THROW(run(*method, plane_freezing(), 20, {{"step_error", "1e-3"}}),
                   cases::Refusal);
    }

    // n counts steps: as many are made, on the particles that the option says.
    TEST(Implicit, RefinesInTime)
    {
      const Problem problem = plane_freezing();
      const auto in_time = [&](const char *scheme, int n, const char *stages)
      {
        return run(*method, problem, n,
                   {{"refine", "time"},
                    {"cells", "40"},
                    {"time_scheme", scheme},
                    {"stages", stages}});
      };
      for(const char *scheme : {"rkl2", "backward-euler", "crank-nicolson"})
        for(const int steps : {20, 100})
        {
          const Outcome outcome = in_time(scheme, steps, "64");
          EXPECT_EQ(outcome.cost.steps, steps) << scheme;
          EXPECT_EQ(outcome.cost.unknowns, 40);
          EXPECT_NEAR(outcome.description.time_step, problem.scene.end_time / steps,
                      1e-12);
        }
      EXPECT_THROW(in_time("euler", 20, "8"), cases::Refusal);
      EXPECT_THROW(in_time("rkl2", 5, "8"), cases::Refusal);
    }

    // Of little sensible heat: automatic makes many fewer evaluations than super steps,
    // and its front ends within the wanted error, a hundredth of a particle, of theirs.
    TEST(Automatic, TakesLongStepsAlongALine)
    {
      cases::Material material = unit_material();
      material.latent_heat = 100;
      const Problem problem = freezing_slab(material, -1, 0.1, 1, 15);
      const auto by = [&](const char *scheme) {
        return run(*method, problem, 40, {{"time_scheme", scheme}});
      };
      const Outcome super = by("rkl2"), chosen = by("automatic");
      EXPECT_LT(chosen.cost.work, 0.25 * super.cost.work);
      // A mean over all steps would tell of where most are: those of one are not equal.
      EXPECT_NEAR(chosen.front_end, super.front_end, 0.01 / 40);
      EXPECT_LT(chosen.largest_defect, 1e-12);
    }

    TEST(Automatic, IsEqualSuperStepsWhereThoseCostLess)
    {
      const auto by = [&](const char *scheme) {
        return run(*method, plane_freezing(), 20, {{"time_scheme", scheme}});
      };
      EXPECT_EQ(by("automatic").temperature, by("rkl2").temperature);
      EXPECT_THROW(run(*method, line_sink(), 20,
                       {{"time_scheme", "automatic"}, {"step_error", "1e-3"}}),
                   cases::Refusal);
    }

    TEST(Implicit, TheBandedSolver)
    {
      constexpr std::size_t n = 13, half = 2;
      std::mt19937_64 generator(3);
      std::uniform_real_distribution<double> uniform(-1, 1);
      std::vector<std::vector<double>> matrix(n, std::vector<double>(n, 0.));
      for(std::size_t i = 0; i < n; ++i)
        for(std::size_t j = i - std::min(i, half); j <= std::min(i + half, n - 1); ++j)
          matrix[i][j] = i == j ? 5. : uniform(generator);
      const auto product = [&](std::span<const double> x, std::span<double> y)
      {
        for(std::size_t i = 0; i < n; ++i)
        {
          y[i] = 0;
          for(std::size_t j = 0; j < n; ++j)
            y[i] += matrix[i][j] * x[j];
        }
      };
      std::vector<double> expected(n), found(n);
      for(double &value : expected)
        value = uniform(generator);
      product(expected, found);
      BandedSolver solver(n, half);
      ASSERT_TRUE(solver.factorise(product));
      solver.solve(found);
      for(std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-14);
      BandedSolver singular(n, half);
      EXPECT_FALSE(singular.factorise([](std::span<const double>, std::span<double> y)
                                      { std::ranges::fill(y, 0.); }));
    }

    // A source that is not a number from some time on ends the run at that step.
    TEST(Implicit, StopsWhereTheEquationsCannotBeSolved)
    {
      Problem problem = line_sink(20000);
      cases::PointSource &sink = problem.scene.sources[0];
      sink.energy = [](double time)
      { return time > 10000 ? std::numeric_limits<double>::quiet_NaN() : -100 * time; };
      for(const char *wanted : {"0", "1e-3"})
        try
        {
          run(*method, problem, 20,
              {{"time_scheme", "backward-euler"},
               {"step_factor", "2"},
               {"step_error", wanted}});
          FAIL() << "the run went on";
        }
        catch(const cases::NumericalError &error)
        {
          EXPECT_GT(error.time, 9999);
          EXPECT_GT(error.step, 1);
          EXPECT_EQ(error.method, "sph");
        }
    }

    // Products with the derivative against differences of the flows, at states that mix
    // solid, melting and liquid particles away from the kinks.
    TEST(Implicit, TheDerivativeOfTheFlows)
    {
      for(const char *rule : {"sub_particle", "partner", "liquid"})
        for(const double scale : {0.5, 5.})
        {
          Problem problem = line_sink_in_disk();
          const cases::EffectSet effects = cases::effects_called_for(problem.scene);
          cases::Resolution resolution;
          resolution.n = 12;
          resolution.options = cases::Options(method->option_declarations());
          resolution.options.set("front", rule);
          const SphParameters parameters
              = resolve_parameters(corrected_policy(), problem.scene, resolution);
          const Discretisation dis(problem.scene, parameters);
          HeatFlow heat_flow(dis, effects, parameters);
          heat_flow.prepare_step(1000, 2000);
          const std::size_t n = dis.particles.size(), size = heat_flow.padded_size();
          const double latent = problem.scene.material.latent_heat;
          std::mt19937_64 generator(5);
          std::uniform_real_distribution<double> uniform(-1, 1);
          std::vector<double> state(size, 0.), change(size, 0.), moved, low(size),
              high(size), product(size);
          for(std::size_t a = 0; a < n; ++a)
          {
            state[a] = latent * (0.5 + scale * uniform(generator));
            change[a] = latent * uniform(generator);
          }
          const auto flow = [&](double along, std::vector<double> &result)
          {
            moved = state;
            for(std::size_t a = 0; a < n; ++a)
              moved[a] += along * change[a];
            heat_flow.follow(moved);
            heat_flow.evaluate(moved, 1, result);
          };
          constexpr double step = 1e-7;
          flow(step, high);
          flow(-step, low);
          flow(0, product);
          heat_flow.linearise(moved, 1);
          heat_flow.apply_derivative(change, product);
          double largest = 0;
          for(std::size_t a = 0; a < n; ++a)
            largest = std::max(largest, std::abs(product[a]));
          for(std::size_t a = 0; a < n; ++a)
            EXPECT_NEAR(product[a], (high[a] - low[a]) / (2 * step), 1e-6 * largest)
                << rule << " " << a;
          // The diagonal is the product with a unit vector.
          for(const std::size_t a : {std::size_t(0), n / 3, n / 2, n - 1})
          {
            std::vector<double> unit(size, 0.);
            unit[a] = 1;
            heat_flow.apply_derivative(unit, product);
            EXPECT_NEAR(product[a], heat_flow.derivative_diagonal()[a],
                        1e-12 * std::abs(product[a]))
                << rule;
          }
        }
    }
  } // namespace
} // namespace meltfront::particles::testing
