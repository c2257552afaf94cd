// Freezing that displaces liquid in the plane and in space.

#include <cases/error.h>
#include <cases/exact/oracle.h>
#include <cases/exact/planar_neumann.h>
#include <particles/sph/displacement_solver.h>
#include <particles/sph/enclosed_liquid.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();

    cases::Material displacing(double solid_density, double liquid_density)
    {
      cases::Material material = unit_material(0);
      material.solid.density = solid_density;
      material.liquid.density = liquid_density;
      return material;
    }

    /** With the balance of mass at every step. */
    struct Balances : Course
    {
      void observe(const cases::Snapshot &snapshot) override
      {
        Course::observe(snapshot);
        worst_mass_defect = std::max(worst_mass_defect, snapshot.mass.defect());
      }

      double worst_mass_defect = 0;
    };

    Balances balances_of(const cases::Scene &scene, int n,
                         const OptionTexts &options = {})
    {
      Balances balances;
      solve(*method, scene, resolution_of(*method, n, options), balances);
      return balances;
    }

    void expect_balanced(const Balances &of)
    {
      EXPECT_GT(of.mass.now, 0);
      EXPECT_LE(of.worst_mass_defect, 1e-12);
      EXPECT_LE(of.worst_budget_defect(), 1e-12);
    }

    /** From the exact state between exact walls. */
    Problem slab_between_exact_walls(const cases::Material &material)
    {
      const auto exact = std::make_shared<cases::PlanarNeumann>(material, -0.5, 0.5);
      Problem problem{slab(material, 1, 0.5, 0.2, exact_wall(exact), exact_wall(exact)),
                      exact};
      problem.scene.start_time = 0.02;
      start_from(problem.scene, exact);
      return problem;
    }

    TEST(LiquidFlow, ConvergesToNeumannsSolutionWithMotion)
    {
      const OptionTexts in_the_plane{{"dimension", "2"}};
      for(const auto &[solid, liquid] : {std::pair(0.8, 1.), std::pair(1.25, 1.),
                                         std::pair(0.5, 1.), std::pair(2., 1.)})
      {
        const Problem problem = slab_between_exact_walls(displacing(solid, liquid));
        const Convergence found
            = converge(*method, problem, {20, 28, 40, 80}, in_the_plane);
        EXPECT_GE(found.order, 1.6) << solid;
        EXPECT_LE(found.errors.back(), 1.3e-4) << solid;
        const Outcome outcome = run(*method, problem, 80, in_the_plane);
        // Through walls, conducted and carried along.
        const double change = problem.exact->heat_content(0, 1, 0.2)
                              - problem.exact->heat_content(0, 1, 0.02);
        EXPECT_NEAR(outcome.heat.boundary, change, 2e-3 * std::abs(change)) << solid;
        expect_balanced(balances_of(problem.scene, 40, in_the_plane));
      }
    }

    TEST(LiquidFlow, SpaceAndPlaneAgreeOnASlab)
    {
      const Problem problem = slab_between_exact_walls(displacing(0.5, 1));
      const Outcome plane = run(*method, problem, 20, {{"dimension", "2"}});
      const Outcome space = run(*method, problem, 20, {{"dimension", "3"}});
      EXPECT_NEAR(plane.front_end, space.front_end, 1e-5);
    }

    /** Solid from the inner wall to 0.5, liquid beyond it; the start of the case annulus,
     * and what the oracle makes of it. */
    Problem annulus(double liquid_density)
    {
      Problem problem;
      cases::Scene &scene = problem.scene;
      scene.symmetry = cases::Symmetry::cylindrical;
      scene.domain = {cases::DomainShape::shell, 2, {}, {}, 1, 0.3};
      scene.material.solid = {.conductivity = 2};
      scene.material.liquid = {.conductivity = 1, .specific_heat_capacity = 2};
      scene.material.liquid.density = liquid_density;
      scene.material.latent_heat = 2;
      scene.end_time = 0.12;
      const auto start = [](double r)
      {
        return r < 0.5 ? (1 - std::pow(r / 0.5, -0.4)) / 0.4
                       : 0.25 * (1 - std::pow(r / 0.5, -1.6));
      };
      const auto radius = [](const cases::Position &p) { return std::hypot(p[0], p[1]); };
      scene.initial.temperature
          = field_of([=](const cases::Position &p) { return start(radius(p)); });
      scene.initial.front
          = field_of([=](const cases::Position &p) { return radius(p) - 0.5; });
      set_boundary(scene, cases::Side::inner, fixed_wall(start(0.3)));
      set_boundary(scene, cases::Side::outer, fixed_wall(start(1)));
      cases::OracleProblem oracle;
      oracle.symmetry = scene.symmetry;
      oracle.material = scene.material;
      oracle.inner = 0.3;
      oracle.end_time = scene.end_time;
      oracle.initial_fronts = {0.5};
      oracle.initial_temperature = start;
      oracle.inner_wall
          = {cases::BoundaryKind::fixed_temperature, [=](double) { return start(0.3); }};
      oracle.outer_wall
          = {cases::BoundaryKind::fixed_temperature, [=](double) { return start(1); }};
      oracle.nodes = 24;
      oracle.tolerance = 1e-9;
      problem.exact = std::make_shared<cases::SpectralOracle>(oracle);
      return problem;
    }

    TEST(LiquidFlow, ConvergesToTheRadialSolutionWithMotion)
    {
      for(const double liquid_density : {0.8, 1.25})
      {
        const Problem problem = annulus(liquid_density);
        const Convergence found = converge(*method, problem, {20, 28, 40, 56});
        EXPECT_GE(found.order, 1.7) << liquid_density;
        EXPECT_LE(found.errors.back(), 1.5e-4) << liquid_density;
        expect_balanced(balances_of(problem.scene, 28));
      }
    }

    /** Freezes from a wall that is cold in waves; the other end is warm. */
    cases::Scene wavy_box(double liquid_density, double phase = 0)
    {
      cases::Scene scene
          = box(displacing(1, liquid_density), 2, {0, 0, 0}, {1, 0.5, 0}, 0.3, 0.05);
      set_boundary(
          scene, cases::Side::x_min,
          {.kind = cases::BoundaryKind::fixed_temperature,
           .value = field_of([phase](const cases::Position &p)
                             { return -0.6 * (1 + 0.7 * std::sin(6 * p[1] + phase)); })});
      set_boundary(scene, cases::Side::x_max, fixed_wall(0.3));
      return scene;
    }

    TEST(LiquidFlow, MassAndHeatBalanceAtEveryStep)
    {
      for(const double liquid_density : {0.5, 0.8, 1.25, 2.})
      {
        const Balances of = balances_of(wavy_box(liquid_density), 20);
        expect_balanced(of);
        EXPECT_GT(of.solid.back(), 0.05);
      }
    }

    /** Temperatures by place. */
    std::map<std::pair<long, long>, double> by_place(const Course &course, double height,
                                                     bool mirrored)
    {
      std::map<std::pair<long, long>, double> result;
      for(std::size_t i = 0; i < course.temperature.size(); ++i)
      {
        const cases::Position p = course.place(i);
        const double y = mirrored ? height - p[1] : p[1];
        result[{std::lround(1e6 * p[0]), std::lround(1e6 * y)}] = course.temperature[i];
      }
      return result;
    }

    TEST(LiquidFlow, AMirrorImageStaysOne)
    {
      // sin(6 (0.5 - y) + a) = sin(6 y + b) with b = pi - 3 - a
      constexpr double phase = 0.4;
      const auto one = by_place(balances_of(wavy_box(1.25, phase), 20), 0.5, false);
      const auto other = by_place(
          balances_of(wavy_box(1.25, 3.14159265358979324 - 3 - phase), 20), 0.5, true);
      ASSERT_EQ(one.size(), other.size());
      for(const auto &[place, temperature] : one)
        EXPECT_NEAR(temperature, other.at(place), 1e-11);
    }

    TEST(LiquidFlow, WithoutADifferenceOfDensitiesNothingChanges)
    {
      cases::Scene scene = wavy_box(1);
      const Course off = balances_of(scene, 20);
      scene.effect_choices[cases::Effect::liquid_motion] = cases::EffectChoice::on;
      const Course on = balances_of(scene, 20);
      EXPECT_EQ(off.temperature, on.temperature);
      EXPECT_EQ(off.solid_fraction, on.solid_fraction);
      EXPECT_EQ(off.heat.boundary, on.heat.boundary);
    }

    TEST(LiquidFlow, AFrontAtRestStaysForTenThousandSteps)
    {
      cases::Scene scene
          = slab(displacing(0.8, 1), 1, 0, 5, fixed_wall(-1), fixed_wall(1));
      scene.initial.temperature
          = field_of([](const cases::Position &p) { return 2 * p[0] - 1; });
      const Balances of = balances_of(scene, 10000,
                                      {{"dimension", "2"},
                                       {"refine", "time"},
                                       {"cells", "10"},
                                       {"time_scheme", "euler"}});
      EXPECT_EQ(of.step.back(), 10000);
      EXPECT_NEAR(of.solid.back(), 0.5, 1e-9);
      expect_balanced(of);
    }

    // The last liquid between three fronts, particle by particle.
    TEST(LiquidFlow, ABoxFreezesThrough)
    {
      for(const double liquid_density : {0.8, 1.25})
      {
        cases::Scene scene
            = box(displacing(1, liquid_density), 2, {0, 0, 0}, {1, 0.5, 0}, 0.1, 0.2);
        for(const cases::Side side :
            {cases::Side::x_min, cases::Side::y_min, cases::Side::y_max})
          set_boundary(scene, side, fixed_wall(-1));
        const Balances of = balances_of(scene, 20);
        expect_balanced(of);
        EXPECT_NEAR(of.solid.back(), 0.5, 1e-9);
        EXPECT_NEAR(of.heat.latent, 0, 1e-9);
      }
    }

    void expect_refusal(const cases::Scene &scene, const OptionTexts &options,
                        const std::string &word)
    {
      try
      {
        balances_of(scene, 20, options);
        FAIL() << "not refused: " << word;
      }
      catch(const cases::Refusal &refusal)
      {
        EXPECT_NE(std::string(refusal.what()).find(word), std::string::npos)
            << refusal.what();
      }
    }

    TEST(LiquidFlow, RefusesWhatItDoesNotMove)
    {
      const cases::Scene scene = wavy_box(1.25);
      expect_refusal(scene, {{"layout", "edge"}}, "layout = cell");
      expect_refusal(scene, {{"jitter", "0.1"}}, "jitter = 0");
      expect_refusal(scene, {{"moment_correction", "false"}}, "moment_correction");
      expect_refusal(scene, {{"time_scheme", "crank-nicolson"}}, "explicit steps");

      // Liquid that the solid encloses, in the middle of the wall's cold.
      cases::Scene other = box(displacing(1, 1.25), 2, {0, 0, 0}, {1, 1, 0}, 0.1, 0.1);
      for(const cases::Side side : {cases::Side::x_min, cases::Side::x_max,
                                    cases::Side::y_min, cases::Side::y_max})
        set_boundary(other, side, fixed_wall(-1));
      expect_refusal(other, {}, "enclose");

      // Through the whole outlet while a long wall freezes at once.
      other = box(displacing(1, 5), 2, {0, 0, 0}, {2, 0.2, 0}, 0.1, 0.1);
      set_boundary(other, cases::Side::y_min, fixed_wall(-2));
      expect_refusal(other, {}, "step_factor");
    }

    /** A square of particles that pass liquid on to their neighbours. */
    struct Square
    {
      explicit Square(int n)
        : scene(unit_box(2, unit_material(0), 0, 1))
      {
        parameters.n = n;
        parameters.dimension = 2;
        dis.emplace(scene, parameters);
        rows.emplace(*dis, true);
      }

      cases::Scene scene;
      SphParameters parameters;
      std::optional<Discretisation> dis;
      std::optional<ConductionRows> rows;
    };

    // Factors of what was liquid before serve, and are renewed.
    void expect_potential(const ParticleOperator &rows, int dimension)
    {
      std::vector<double> links(rows.padded_rows(), 0.);
      links[0] = 1;
      DisplacementSolver solver(rows, links, dimension, 1);
      std::vector<double> liquid(rows.padded_rows(), 1.), due(rows.rows()),
          potential(rows.padded_rows(), 0.);
      std::mt19937 random(7);
      for(int frozen = 0; frozen < 120; frozen += 20)
      {
        for(double &volume : due)
          volume = 1e-3 * std::uniform_real_distribution(0., 1.)(random);
        std::vector<double> rest = due;
        ASSERT_TRUE(solver.solve(liquid, rest, potential, 1e-13));
        std::vector<double> passed(rows.rows(), 0.);
        double total = 0;
        for(std::uint32_t a = 0; a < rows.rows(); ++a)
        {
          if(liquid[a] == 0)
            continue;
          total += due[a];
          passed[a] = links[a] * potential[a];
          rows.visit_row(a, [&](std::uint32_t b, double g)
                         { passed[a] += g * liquid[b] * (potential[a] - potential[b]); });
          EXPECT_NEAR(passed[a], due[a], 1e-12);
        }
        EXPECT_NEAR(potential[0], total, 1e-12); // all leaves there
        for(int i = 0; i < 20; ++i)
          liquid[rows.rows() - 1 - frozen - i] = 0;
      }
    }

    TEST(DisplacementSolver, FindsThePotentialWhateverFreezes)
    {
      const Square square(16);
      for(const int with_factors_for : {2, 3})
        expect_potential(square.rows->rows, with_factors_for);
    }

    TEST(EnclosedLiquid, NarrowPocketsHandOnAndWideOnesAreTold)
    {
      const Square square(16);
      const ParticleOperator &rows = square.rows->rows;
      std::vector<double> liquid(rows.padded_rows(), 0.), due(rows.rows(), 0.);
      std::vector<std::uint32_t> openings;
      const auto fill = [&](double x_from, double x_to, double y_from, double y_to)
      {
        for(std::uint32_t a = 0; a < rows.rows(); ++a)
        {
          const cases::Position p = square.dis->particles.point(a);
          if(p[0] > x_from && p[0] < x_to && p[1] > y_from && p[1] < y_to)
          {
            liquid[a] = 1;
            due[a] = 1;
          }
        }
      };
      fill(7 / 16., 0.5, -0.5, 0.5); // a row beside the outlet
      for(std::uint32_t a = 0; a < rows.rows(); ++a)
        if(liquid[a] > 0)
          openings.push_back(a);
      EnclosedLiquid enclosed(rows, openings);
      fill(-0.25, -0.125, -0.25, 0.25); // two particles wide
      const std::span<double> all = std::span(liquid).first(rows.rows());
      auto outcome = enclosed.settle(all, due);
      EXPECT_EQ(outcome.stuck, 0);
      EXPECT_EQ(outcome.straight_out, 0);
      double handed_on = 0;
      for(const std::uint32_t a : openings)
      {
        EXPECT_EQ(liquid[a], 1);
        handed_on += due[a];
      }
      EXPECT_EQ(handed_on, 16 + 16);
      EXPECT_EQ(std::accumulate(all.begin(), all.end(), 0.), 16);

      fill(-0.25, -0.0625, -0.25, 0.25); // three
      outcome = enclosed.settle(all, due);
      EXPECT_EQ(outcome.stuck, 1);

      std::fill(liquid.begin(), liquid.end(), 0.);
      std::fill(due.begin(), due.end(), 0.);
      fill(-0.25, -0.125, -0.25, 0.25); // and the outlet is frozen
      outcome = enclosed.settle(all, due);
      EXPECT_EQ(outcome.straight_out, 16);
    }
  } // namespace
} // namespace meltfront::particles::testing
