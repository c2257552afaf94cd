#include <cases/error.h>
#include <particles/sph/conduction_spectrum.h>
#include <particles/sph/conductivity_contrast.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();

    /** Rows on a periodic unit square, k = rho = c = 1. */
    struct PeriodicRows
    {
      cases::Scene scene;
      SphParameters parameters;
      Discretisation dis;
      ConductionRows rows;

      PeriodicRows(KernelShape kernel, double smoothing_length, double jitter,
                   bool moment_correction = false)
        : scene(unit_box(2, unit_material(), 0, 1))
        , parameters(make_parameters(kernel, smoothing_length, jitter))
        , dis(make_periodic(scene), parameters)
        , rows(dis, moment_correction)
      {
      }

      static const cases::Scene &make_periodic(cases::Scene &scene)
      {
        for(int side = 0; side < 4; ++side)
          scene.boundaries[side] = periodic_wall();
        return scene;
      }

      static SphParameters make_parameters(KernelShape kernel, double smoothing_length,
                                           double jitter)
      {
        SphParameters p;
        p.moment_correction = false;
        p.front = FrontRule::sub_particle;
        p.dimension = 2;
        p.kernel = kernel;
        p.smoothing_length = smoothing_length;
        p.layout = LatticeLayout::cell_centred;
        p.jitter = jitter;
        p.seed = 3;
        p.n = 24;
        return p;
      }

      /** In units of rho c h^2/k. */
      double in_units(double step) const
      {
        const double h = dis.kernel.smoothing_length();
        return step / (h * h);
      }

      double row_sum_limit() const
      {
        return in_units(dis.particle_volume / rows.largest_row_sum);
      }

      double euler_limit() const
      {
        return in_units(2 * dis.particle_volume / largest_eigenvalue(rows, {}));
      }
    };

    // Limits found by an independent eigenvalue solver, in units of rho c h^2/k.
    TEST(Stability, LimitsOfTheSquareLattice)
    {
      const auto cubic = KernelShape::cubic_spline;
      for(const auto &[smoothing_length, limit] :
          {std::pair{1.0, 0.3667}, {1.2, 0.3473}, {1.3, 0.3473}, {1.5, 0.3512}})
        EXPECT_NEAR(PeriodicRows(cubic, smoothing_length, 0).euler_limit(), limit,
                    0.02 * limit);
      EXPECT_NEAR(PeriodicRows(KernelShape::wendland_c2, 1.3, 0).euler_limit(), 0.318,
                  0.02 * 0.318);
      EXPECT_NEAR(PeriodicRows(KernelShape::quintic_spline, 1.3, 0).euler_limit(), 0.517,
                  0.02 * 0.517);
      EXPECT_NEAR(PeriodicRows(cubic, 1.3, 0).row_sum_limit(), 0.2305, 0.001);
    }

    TEST(Stability, LimitsOfDisorderedParticles)
    {
      const auto cubic = KernelShape::cubic_spline;
      for(const auto &[jitter, limit] :
          {std::pair{0.1, 0.333}, {0.2, 0.312}, {0.3, 0.291}})
        EXPECT_NEAR(PeriodicRows(cubic, 1.3, jitter).euler_limit(), limit, 0.05 * limit);
      EXPECT_NEAR(PeriodicRows(cubic, 1.3, 0.3).row_sum_limit(), 0.173, 0.1 * 0.173);
      EXPECT_GE(PeriodicRows(cubic, 1.0, 0.4).row_sum_limit(), 0.13);
    }

    TEST(Stability, RowsAreSymmetricAndDisorderKeepsTheMoment)
    {
      // A linear profile is exact in the mean: sum over a lattice's rows of g x_ab^2.
      const PeriodicRows lattice(KernelShape::cubic_spline, 1.3, 0, true);
      EXPECT_NEAR(lattice.rows.second_moment, 1.010543, 1e-6);
      const PeriodicRows disordered(KernelShape::cubic_spline, 1.3, 0.3, true);
      const std::size_t n = disordered.dis.particles.size();
      std::vector<double> x(disordered.rows.rows.padded_rows(), 0), flow(x.size());
      std::mt19937_64 generator(9);
      for(std::size_t i = 0; i < n; ++i)
        x[i] = std::normal_distribution<double>()(generator);
      disordered.rows.rows.apply(x, flow, 1);
      double sum = 0, magnitude = 0;
      for(std::size_t i = 0; i < n; ++i)
      {
        sum += flow[i];
        magnitude += std::abs(flow[i]);
      }
      EXPECT_LE(std::abs(sum), 1e-14 * magnitude);
    }

    /** Of n particles on the unit line between two walls. */
    double eigenvalue_of_line(int n, const cases::Boundary &wall, LatticeLayout layout)
    {
      const cases::Scene scene = slab(unit_material(), 1, 0, 1, wall, wall);
      SphParameters p;
      p.dimension = 1;
      p.n = n;
      p.layout = layout;
      const Discretisation dis(scene, p);
      return largest_eigenvalue(ConductionRows(dis, true), dis.dirichlet);
    }

    // Only nearest neighbours exchange on the line: the eigenvectors are cosines and
    // sines.
    TEST(Stability, LargestEigenvalueOfALine)
    {
      using std::numbers::pi;
      const auto cell = LatticeLayout::cell_centred, edge = LatticeLayout::on_edge;
      for(const int n : {8, 40})
      {
        const double spacings = n - 1;
        EXPECT_NEAR(eigenvalue_of_line(n, {}, cell) / n, 2 * (1 + std::cos(pi / n)),
                    1e-6);
        EXPECT_NEAR(eigenvalue_of_line(n, fixed_wall(1), cell) / n, 4, 1e-6);
        EXPECT_NEAR(eigenvalue_of_line(n, fixed_wall(1), edge) / spacings,
                    2 * (1 + std::cos(pi / spacings)), 1e-6);
      }
    }

    // Explicit steps up to the row-sum bound never lower the entropy nor pass the
    // extremes.
    TEST(Stability, RowSumBoundKeepsEntropyGrowing)
    {
      for(const double jitter : {0., 0.3})
        for(int trial = 0; trial < 10; ++trial)
        {
          const PeriodicRows p(KernelShape::cubic_spline, 1.3, jitter);
          const std::size_t n = p.dis.particles.size();
          std::vector<double> t(p.rows.rows.padded_rows(), 1), flow(t.size());
          std::mt19937_64 generator(100 + trial);
          std::uniform_real_distribution<double> uniform(1, 100);
          for(std::size_t i = 0; i < n; ++i)
            t[i] = uniform(generator);
          for(int step = 0; step < 20; ++step)
          {
            const auto [low, high] = std::minmax_element(t.begin(), t.begin() + n);
            const double lowest = *low, highest = *high;
            double before = 0, after = 0;
            p.rows.rows.apply(t, flow, 1);
            for(std::size_t i = 0; i < n; ++i)
            {
              before += std::log(t[i]);
              t[i] += flow[i] / p.rows.largest_row_sum;
              after += std::log(t[i]);
              ASSERT_GE(t[i], lowest * (1 - 1e-14));
              ASSERT_LE(t[i], highest * (1 + 1e-14));
            }
            ASSERT_GT(after, before);
          }
        }
    }

    TEST(Stability, StepsBeyondTheLimitAreRefused)
    {
      for(const auto &m : {make_sph(), make_sph_2005()})
        for(const char *scheme : {"euler", "rkl2"})
        {
          const OptionTexts below{{"step_factor", "0.9"}, {"time_scheme", scheme}};
          const OptionTexts above{{"step_factor", "1.1"}, {"time_scheme", scheme}};
          for(const Problem &problem : {plane_freezing(), line_sink(47500)})
          {
            EXPECT_NO_THROW(run(*m, problem, 40, below));
            try
            {
              run(*m, problem, 40, above);
              ADD_FAILURE() << m->name() << " ran with step_factor 1.1";
            }
            catch(const cases::Refusal &refusal)
            {
              EXPECT_NE(std::string(refusal.what()).find("1.1 times the largest"),
                        std::string::npos)
                  << refusal.what();
            }
          }
        }
    }

    TEST(Stability, UnguardedStepsBeyondTheLimitEndAsErrors)
    {
      for(const auto &m : {make_sph(), make_sph_2005()})
        for(const char *scheme : {"euler", "rkl2"})
        {
          const auto with = [&](const char *factor)
          {
            return OptionTexts{{"step_limit", "stability"},
                               {"step_factor", factor},
                               {"time_scheme", scheme}};
          };
          EXPECT_NO_THROW(run(*m, plane_freezing(), 80, with("0.3")))
              << m->name() << " " << scheme;
          for(const char *factor : {"1.1", "2", "5"})
            EXPECT_THROW(run(*m, plane_freezing(), 80, with(factor)),
                         cases::NumericalError)
                << m->name() << " " << scheme << " " << factor;
        }
    }

    TEST(Stability, FrontsThatLagTooFarAreRefused)
    {
      EXPECT_DOUBLE_EQ(front_lag(0.1, 3, 1), 0.1);
      EXPECT_LT(front_lag(0.1, 1, 3), 0);
      // Water freezes, n = 20: 0.077 of the side; a contrast of a thousand: 13 sides.
      EXPECT_NO_THROW(run(*make_sph_2005(), plane_freezing_water(), 20));
      Problem problem = plane_freezing();
      problem.scene.material.liquid.conductivity = 1e-3;
      for(const char *front : {"partner", "liquid"})
        EXPECT_THROW(run(*method, problem, 40, {{"front", front}}), cases::Refusal)
            << front;
      EXPECT_NO_THROW(run(*method, problem, 40));
      // The phase ahead of the front conducts better: nothing lags.
      problem.scene.material.liquid.conductivity = 30;
      EXPECT_NO_THROW(run(*method, problem, 20, {{"front", "liquid"}}));
    }

    /** Runs to the end, within the bounds (the method checks), with a closed budget. */
    Outcome expect_held(const Problem &problem, int n, const OptionTexts &options = {},
                        std::uint64_t seed = 1)
    {
      Outcome outcome;
      EXPECT_NO_THROW(outcome = run(*method, problem, n, options, seed));
      EXPECT_LE(outcome.largest_defect, 1e-12);
      return outcome;
    }

    void expect_monotone(const Outcome &outcome)
    {
      EXPECT_LE(outcome.steepest_retreat, 1e-9);
    }

    Problem with_material(double solid_conductivity, double liquid_conductivity,
                          double latent_heat)
    {
      cases::Material material = unit_material(1);
      material.solid.conductivity = solid_conductivity;
      material.liquid.conductivity = liquid_conductivity;
      material.latent_heat = latent_heat;
      return freezing_slab(material, 0.2, 1.2, 1, 0.05 / solid_conductivity);
    }

    const std::vector<OptionTexts> variants{
        {},
        {{"time_scheme", "euler"}},
        {{"front", "partner"}},
        {{"dimension", "2"}, {"smoothing_length", "1.3"}},
        {{"layout", "edge"}},
        {{"dimension", "2"}, {"jitter", "0.3"}, {"smoothing_length", "1.5"}}};

    TEST(Stability, SmallAndLargeStefanNumbers)
    {
      for(const OptionTexts &options : variants)
        for(const double latent_heat : {80., 0.008, 1e-6})
        {
          const Problem problem = with_material(1, 1, latent_heat);
          const Outcome outcome = expect_held(problem, 40, options);
          expect_monotone(outcome);
          EXPECT_NEAR(outcome.front_end, problem.exact->front(0.05), 0.03);
        }
    }

    TEST(Stability, ConductivityRatios)
    {
      for(const OptionTexts &options : variants)
        for(const double ratio : {1e-3, 1e3, 1e9})
        {
          if(options == variants[2]) // refused: FrontsThatLagTooFarAreRefused
            continue;
          const Outcome outcome = expect_held(
              with_material(std::min(ratio, 1.), std::min(1 / ratio, 1.), 1), 20,
              options);
          expect_monotone(outcome);
          // The same with liquid at the wall.
          cases::Material material = unit_material(1);
          material.liquid.conductivity = std::min(ratio, 1.);
          material.solid.conductivity = std::min(1 / ratio, 1.);
          const Problem melting
              = freezing_slab(material, 2, 0.8, 1, 0.05 / material.liquid.conductivity);
          expect_held(melting, 20, options);
        }
    }

    TEST(Stability, DiscontinuousStart)
    {
      for(const OptionTexts &options : variants)
      {
        Problem problem;
        problem.scene = slab(unit_material(), 1, 0, 0.04, fixed_wall(-50), {});
        problem.scene.initial.temperature
            = {"if(x < 0.3, -5, 2)",
               [](const cases::Position &p, double) { return p[0] < 0.3 ? -5. : 2.; },
               false};
        expect_monotone(expect_held(problem, 40, options));
      }
    }

    TEST(Stability, LiquidLayerOneParticleThick)
    {
      for(const OptionTexts &options : variants)
      {
        Problem problem;
        problem.scene
            = slab(unit_material(), 1, 0, 0.02, fixed_wall(-0.1), fixed_wall(-0.1));
        problem.scene.initial.temperature
            = {"if(x > 0.49 && x < 0.515, 0.01, -0.1)",
               [](const cases::Position &p, double)
               { return p[0] > 0.49 && p[0] < 0.515 ? 0.01 : -0.1; },
               false};
        const Outcome outcome = expect_held(problem, 40, options);
        expect_monotone(outcome);
        EXPECT_EQ(outcome.heat.latent, 0);
      }
    }

    TEST(Stability, FrontThatTurnsBack)
    {
      for(const OptionTexts &options : variants)
      {
        Problem problem;
        cases::Boundary wall = fixed_wall(-1);
        wall.value = {"-1 + 0.49*(1 + tanh((t - 0.03)/0.0015))",
                      [](const cases::Position &, double t)
                      { return -1 + 0.49 * (1 + std::tanh((t - 0.03) / 0.0015)); },
                      false};
        problem.scene = slab(unit_material(), 1, 1, 0.09, wall, fixed_wall(1));
        const Outcome outcome = expect_held(problem, 80, options);
        // The exact front: 0.1305 at 0.03, 0.0404 at the end.
        const double farthest
            = *std::max_element(outcome.fronts.begin(), outcome.fronts.end());
        EXPECT_NEAR(farthest, 0.131, 0.012);
        EXPECT_NEAR(outcome.front_end, 0.0404, 0.012);
      }
    }

    TEST(Stability, DisorderedParticlesOfManySeeds)
    {
      for(int seed = 1; seed <= 5; ++seed)
        for(const char *jitter : {"0.1", "0.2", "0.3"})
          for(const char *dimension : {"1", "2"})
            expect_monotone(expect_held(
                plane_freezing(), 40,
                {{"jitter", jitter}, {"dimension", dimension}, {"smoothing_length", "2"}},
                seed));
    }

    TEST(Stability, IceThatMeetsTheWalls)
    {
      Problem problem = line_sink(2.5e6);
      problem.scene.symmetry = cases::Symmetry::none;
      problem.exact = nullptr;
      expect_monotone(expect_held(problem, 20));
    }

    // A jump in conductivity at a front at rest: the steady flux is exact for h = dp.
    TEST(Stability, SteadyFluxAcrossAJump)
    {
      for(const double ratio : {10., 1e3, 1e9})
      {
        cases::Material material = unit_material();
        material.liquid.conductivity = 1 / ratio;
        material.latent_heat = 1e-6;
        Problem problem;
        // Start from the steady state: front in the middle between two particles.
        problem.scene = slab(material, 1, 0, 10, fixed_wall(-1), fixed_wall(ratio));
        problem.scene.initial.temperature
            = {"steady",
               [ratio](const cases::Position &p, double)
               { return 2 * (p[0] - 0.5) * (p[0] < 0.5 ? 1 : ratio); },
               false};
        const Outcome outcome = expect_held(problem, 20);
        EXPECT_NEAR(outcome.front_end, 0.5, 1e-9) << ratio;
        for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        {
          const double x = outcome.position_x[i] - 0.5;
          ASSERT_NEAR(outcome.temperature[i], 2 * x * (x < 0 ? 1 : ratio),
                      1e-9 * (x < 0 ? 1 : ratio));
        }
      }
    }
  } // namespace
} // namespace meltfront::particles::testing
