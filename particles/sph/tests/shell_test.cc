#include <cases/error.h>
#include <cases/exact/formula_solution.h>
#include <particles/sph/conduction_rows.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    using namespace cases;
    constexpr double pi = std::numbers::pi;
    constexpr double inner = 0.2, outer = 0.5; // m
    const std::unique_ptr<Method> method = make_sph();

    /** Heat conduction alone in an annulus or a hollow ball. */
    Problem shell(int dimension, double start, double end_time, const Boundary &at_inner,
                  const Boundary &at_outer)
    {
      Problem problem;
      Scene &scene = problem.scene;
      scene.symmetry = dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical;
      scene.domain = {DomainShape::shell, dimension, {}, {}, outer, inner};
      scene.material = unit_material(100);
      scene.material.solid.conductivity = 2;
      scene.initial.temperature = Field::uniform(start);
      scene.boundaries[static_cast<std::size_t>(Side::inner)] = at_inner;
      scene.boundaries[static_cast<std::size_t>(Side::outer)] = at_outer;
      scene.end_time = end_time;
      return problem;
    }

    using Profile = std::function<double(double)>;

    Boundary profile_wall(const Profile &profile)
    {
      return exact_wall(std::make_shared<FormulaSolution>(
          Symmetry::none, "",
          [profile](const Position &p, double)
          { return profile(std::hypot(p[0], p[1], p[2])); }));
    }

    /** Root mean square of what the temperature differs at the end. */
    double error(const Outcome &outcome, const Profile &profile)
    {
      double sum = 0;
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        sum += std::pow(outcome.temperature[i] - profile(outcome.distance[i]), 2);
      return std::sqrt(sum / double(outcome.temperature.size()));
    }

    struct Study
    {
      double finest;
      double order;
    };

    Study refine(const Problem &problem, const Profile &profile,
                 const std::vector<int> &levels)
    {
      std::vector<double> spacing, errors;
      for(const int n : levels)
      {
        const Outcome outcome = run(*method, problem, n);
        EXPECT_LE(outcome.largest_defect, 1e-12) << n;
        spacing.push_back(outcome.description.spacing);
        errors.push_back(error(outcome, profile));
      }
      return {errors.back(), fitted_order(spacing, errors)};
    }

    double logarithm(double r)
    {
      return std::log(outer / r) / std::log(outer / inner);
    }

    // Long after its walls were set to 1 and 0 the temperature is that of the steady
    // annulus. From the start it was -1.
    TEST(Shell, SteadyLogarithmicProfile)
    {
      const Study fixed_walls = refine(shell(2, -1, 0.1, fixed_wall(1), fixed_wall(0)),
                                       logarithm, {20, 30, 40, 60});
      EXPECT_GE(fixed_walls.order, 1.8);
      EXPECT_LE(fixed_walls.finest, 2e-6);
      const Boundary exact = profile_wall(logarithm);
      const Study exact_walls
          = refine(shell(2, -1, 0.1, exact, exact), logarithm, {20, 30, 40, 60});
      EXPECT_GE(exact_walls.order, 1.8);
      EXPECT_LE(exact_walls.finest, 2e-6);
    }

    /** Heat flow from a wall into the particles at the end of a run (W/m). */
    double power(const Scene &scene, int n, Side side, const Outcome &outcome)
    {
      Resolution resolution;
      resolution.n = n;
      resolution.options = Options(method->option_declarations());
      const Discretisation dis(scene,
                               resolve_parameters(corrected_policy(), scene, resolution));
      const ConductionRows rows(dis, true);
      double sum = 0;
      for(const WallLink &link : rows.temperature_links)
      {
        const auto &[boundary, place] = rows.temperature_points[link.point];
        if(boundary == &scene.boundary(side))
          sum += link.strength * scene.material.solid.conductivity
                 * (boundary->value(place, 0) - outcome.temperature[link.row]);
      }
      return sum;
    }

    TEST(Shell, SteadyPowerThroughBothWalls)
    {
      const Problem problem = shell(2, -1, 0.1, fixed_wall(1), fixed_wall(0));
      const double exact = 2 * pi * 2 / std::log(outer / inner);
      for(const int n : {20, 40, 80})
      {
        const Outcome outcome = run(*method, problem, n);
        EXPECT_NEAR(power(problem.scene, n, Side::inner, outcome), exact, 1e-5 * exact);
        EXPECT_NEAR(power(problem.scene, n, Side::outer, outcome), -exact, 1e-5 * exact);
      }
    }

    TEST(Shell, FluxThroughOneWall)
    {
      const double rise = 3 * inner / 2; // q r_inner/k
      const Study in = refine(shell(2, 0, 0.4, flux_wall(3), fixed_wall(0)),
                              [rise](double r) { return rise * std::log(outer / r); },
                              {20, 30, 40, 60});
      EXPECT_GE(in.order, 1.8);
      EXPECT_LE(in.finest, 1e-5 * rise);
      const double fall = 3 * outer / 2;
      const Study out = refine(shell(2, 0, 0.4, fixed_wall(0), flux_wall(-3)),
                               [fall](double r) { return -fall * std::log(r / inner); },
                               {20, 30, 40, 60});
      EXPECT_GE(out.order, 1.8);
      EXPECT_LE(out.finest, 1e-5 * fall);
    }

    TEST(Shell, HeatThroughAnInnerWallIsItsAreaTimesTheFlux)
    {
      for(const int dimension : {2, 3})
      {
        const Problem problem = shell(dimension, 1, 0.05, flux_wall(0.25), {});
        const Outcome outcome = run(*method, problem, 20);
        const double area = dimension == 2 ? 2 * pi * inner : 4 * pi * inner * inner;
        EXPECT_NEAR(outcome.heat.boundary, 0.05 * 0.25 * area, 1e-13);
        EXPECT_LE(outcome.largest_defect, 1e-12);
      }
    }

    /** J0(a r) Y_k(a r_0) - Y0(a r) J_k(a r_0): its value (k = 0) or slope (1) vanishes
     * at r_0. */
    double mode(double a, int k, double r0, double r)
    {
      return std::cyl_bessel_j(0, a * r) * std::cyl_neumann(k, a * r0)
             - std::cyl_neumann(0, a * r) * std::cyl_bessel_j(k, a * r0);
    }

    /** The least a at which a mode vanishes at the outer wall. */
    double wave_number(int k)
    {
      double lower = 1, upper = 1;
      while(mode(lower, k, inner, outer) * mode(upper, k, inner, outer) > 0)
        upper += 0.5;
      lower = upper - 0.5;
      for(int i = 0; i < 60; ++i)
      {
        const double middle = 0.5 * (lower + upper);
        (mode(lower, k, inner, outer) * mode(middle, k, inner, outer) > 0 ? lower : upper)
            = middle;
      }
      return lower;
    }

    // Modes of the annulus decay with exp(-a^2 k/(rho c) t). Nothing is done at an
    // insulated wall, which then has the lattice's steps.
    TEST(Shell, DecayingModes)
    {
      for(const int k : {0, 1})
      {
        const double a = wave_number(k), end = 0.01;
        const double scale = 1 / mode(a, k, inner, k == 0 ? 0.35 : inner);
        const double decay = std::exp(-2 * a * a * end);
        Problem problem
            = shell(2, 0, end, k == 0 ? fixed_wall(0) : cases::Boundary{}, fixed_wall(0));
        problem.scene.initial.temperature
            = {"mode",
               [=](const Position &p, double)
               { return scale * mode(a, k, inner, std::hypot(p[0], p[1])); },
               false};
        const Study study = refine(
            problem, [=](double r) { return decay * scale * mode(a, k, inner, r); },
            {20, 40, 80, 160});
        EXPECT_GE(study.order, k == 0 ? 1.6 : 0.8);
        EXPECT_LE(study.finest, 1e-3 * decay);
      }
    }

    TEST(Shell, SteadyHollowBall)
    {
      const Study study
          = refine(shell(3, 0, 0.08, fixed_wall(1), fixed_wall(0)),
                   [](double r) { return (1 / r - 1 / outer) / (1 / inner - 1 / outer); },
                   {16, 20, 26, 32});
      EXPECT_GE(study.order, 1.7);
      EXPECT_LE(study.finest, 1e-3);
    }

    TEST(Shell, SharesAddUpToTheDomain)
    {
      for(const int dimension : {2, 3})
        for(const char *layout : {"cell", "edge"})
        {
          const Outcome outcome
              = run(*method, shell(dimension, 1, 1e-6, fixed_wall(1), fixed_wall(1)), 30,
                    {{"layout", layout}});
          double volume = 0;
          for(const double share : outcome.weights)
            volume += share;
          const double exact
              = dimension == 2 ? pi * (outer * outer - inner * inner)
                               : 4 * pi / 3 * (std::pow(outer, 3) - std::pow(inner, 3));
          EXPECT_NEAR(volume, exact, 1e-12);
        }
    }

    TEST(Shell, LineSinkInAnAnnulus)
    {
      const Problem problem = line_sink_in_annulus();
      const Convergence found = converge(*method, problem, {20, 30, 40, 60, 80});
      EXPECT_GE(found.order, 1.1);
      EXPECT_LE(found.errors.back(), 6.5e-4);
      for(const auto &m : {make_sph(), make_sph_2005()})
      {
        const Outcome outcome = run(*m, problem, 40, {{"step_factor", "1"}});
        EXPECT_LE(outcome.largest_defect, 1e-12);
        EXPECT_LE(outcome.front_rms, 0.05);
        EXPECT_GE(outcome.lowest,
                  problem.exact->temperature(0.2, problem.scene.end_time) - 1e-9);
      }
    }

    // What the particles at the inner wall stand for makes the front's place exact.
    TEST(Shell, ReadsTheFrontOfTheExactState)
    {
      Problem problem = line_sink_in_annulus();
      const double start = problem.scene.start_time;
      problem.scene.end_time = start * 1.00001;
      for(const int n : {20, 30, 40, 60})
      {
        const Outcome outcome = run(*method, problem, n);
        EXPECT_NEAR(outcome.front_end, problem.exact->front(start),
                    0.01 * outcome.description.spacing);
      }
    }

    TEST(Shell, RefusesWhatTheSpacingDoesNotResolve)
    {
      const auto refusal = [](const Scene &scene, int n) -> std::string
      {
        try
        {
          run(*method, {scene, nullptr}, n);
        }
        catch(const Refusal &error)
        {
          return error.what();
        }
        return "runs";
      };
      Scene scene = shell(2, 0, 1e-6, fixed_wall(1), fixed_wall(0)).scene;
      EXPECT_EQ(refusal(scene, 20), "runs");
      scene.domain.inner_radius = 0.1;
      EXPECT_EQ(refusal(scene, 10),
                "an inner wall of radius 0.1 m is too narrow for particles that act over "
                "0.2 m: take n at least 2 times as large");
      scene.domain.inner_radius = 0.45;
      EXPECT_EQ(
          refusal(scene, 40),
          "a shell 0.05 m thick holds fewer than four particle spacings of 0.025 m: "
          "take n at least 2 times as large");
    }
  } // namespace
} // namespace meltfront::particles::testing
