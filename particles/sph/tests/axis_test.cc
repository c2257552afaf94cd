// Bodies about an axis: particles are rings.

#include <cases/error.h>
#include <cases/exact/oracle.h>
#include <particles/sph/conduction_rows.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    const auto method = make_sph();
    constexpr double pi = std::numbers::pi;

    /** From `inner` to 1 about the axis, 0 to 0.5 along it; insulated. */
    cases::Scene about_axis(const cases::Material &material, double inner,
                            double temperature, double end)
    {
      cases::Scene scene = box(material, 2, {inner, 0, 0}, {1, 0.5, 0}, temperature, end);
      scene.domain.shape = cases::DomainShape::axisymmetric;
      return scene;
    }

    cases::Scene without_latent_heat(cases::Scene scene)
    {
      scene.material.latent_heat = 0;
      scene.material.melting_temperature = -100;
      return scene;
    }

    cases::Boundary held(std::function<double(const cases::Position &, double)> value)
    {
      return {cases::BoundaryKind::fixed_temperature, {"given", std::move(value)}};
    }

    /** Root mean square over the body. */
    double error_of(const Outcome &outcome,
                    const std::function<double(double distance)> &exact, bool spherical)
    {
      double sum = 0, volume = 0;
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
      {
        const double at = spherical ? outcome.distance[i] : outcome.position_x[i];
        sum += outcome.weights[i] * std::pow(outcome.temperature[i] - exact(at), 2);
        volume += outcome.weights[i];
      }
      return std::sqrt(sum / volume);
    }

    // (r u_r)_r/r + u_zz of quadratics, also beside the axis.
    TEST(Axis, RowsAreExactForQuadratics)
    {
      const cases::Scene scene = about_axis(unit_material(), 0, 0, 1);
      SphParameters parameters;
      parameters.dimension = 2;
      parameters.n = 10;
      const Discretisation dis(scene, parameters);
      const ConductionRows rows(dis, true);
      std::vector<double> u(rows.rows.padded_rows()), flow(u.size());
      const auto &r = dis.particles.position[0], &z = dis.particles.position[1];
      for(const double along : {0., 1.})
      {
        for(std::size_t i = 0; i < dis.particles.size(); ++i)
          u[i] = along * z[i] * z[i] + (1 - along) * r[i] * r[i];
        rows.rows.apply(u, flow, 1);
        double sum = 0;
        for(std::size_t i = 0; i < dis.particles.size(); ++i)
        {
          sum += flow[i];
          if(r[i] < 0.9 && z[i] > 0.1 && z[i] < 0.4)
            EXPECT_NEAR(flow[i] / dis.weights[i], along > 0 ? 2 : 4, 1e-11);
        }
        EXPECT_NEAR(sum, 0, 1e-12);
      }
      double volume = 0;
      for(const double weight : dis.weights)
        volume += weight;
      EXPECT_NEAR(volume, pi * 0.5, 1e-13);
    }

    // A Bessel function of the radius between insulated walls; a spherical wave, whose
    // walls hold it.
    TEST(Axis, WavesDecay)
    {
      constexpr double k = 3.83170597020751232, end = 0.03;
      std::vector<double> spacing, round, spherical;
      for(const int n : {10, 20, 40})
      {
        Problem problem;
        problem.scene = without_latent_heat(about_axis(unit_material(), 0, 0, end));
        problem.scene.initial.temperature
            = field_of([](const cases::Position &p)
                       { return std::cyl_bessel_j(0., k * std::abs(p[0])); });
        const Outcome outcome = run(*method, problem, n);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        round.push_back(error_of(
            outcome,
            [](double r)
            { return std::exp(-k * k * end) * std::cyl_bessel_j(0., k * r); },
            false));

        const auto wave = [](const cases::Position &p, double time)
        { return std::exp(-4 * time) * std::sph_bessel(0U, 2 * std::hypot(p[0], p[1])); };
        problem.scene.initial.temperature = {"wave", wave};
        for(const cases::Side side : {cases::Side::x_max, cases::Side::y_max})
          set_boundary(problem.scene, side, held(wave));
        const Outcome ball = run(*method, problem, n);
        EXPECT_LE(ball.largest_defect, 1e-12);
        spherical.push_back(error_of(
            ball,
            [&](double distance) {
              return wave({distance, 0, 0}, end);
            },
            true));
        spacing.push_back(1. / n);
      }
      EXPECT_GE(fitted_order(spacing, round), 1.9);
      EXPECT_GE(fitted_order(spacing, spherical), 1.8);
    }

    cases::Material contrast()
    {
      cases::Material material = unit_material(0);
      material.solid.conductivity = 2;
      material.liquid.specific_heat_capacity = 2;
      material.latent_heat = 2;
      return material;
    }

    double solid_volume(const Outcome &outcome)
    {
      double sum = 0;
      for(std::size_t i = 0; i < outcome.weights.size(); ++i)
        sum += outcome.weights[i] * outcome.solid_fraction[i];
      return sum;
    }

    // Ice on a cold pipe, nothing of which varies along the axis.
    TEST(Axis, APipeFreezes)
    {
      cases::OracleProblem oracle;
      oracle.symmetry = cases::Symmetry::cylindrical;
      oracle.material = contrast();
      oracle.inner = 0.4;
      oracle.end_time = 0.06;
      oracle.initial_fronts = {0.6};
      oracle.initial_temperature = [](double r)
      { return r < 0.6 ? 5 * (r - 0.6) : std::sin(pi / 2 * (r - 0.6) / 0.4); };
      oracle.inner_wall
          = {cases::BoundaryKind::fixed_temperature, [](double) { return -1.; }};
      oracle.nodes = 24;
      oracle.tolerance = 1e-9;
      const cases::SpectralOracle exact(oracle);
      const double front = exact.front(0.06);
      std::vector<double> spacing, fronts;
      for(const int n : {12, 24, 48, 96})
      {
        Problem problem;
        problem.scene = about_axis(contrast(), 0.4, 0, 0.06);
        problem.scene.initial.temperature = field_of(
            [&](const cases::Position &p) { return oracle.initial_temperature(p[0]); });
        problem.scene.initial.front
            = field_of([](const cases::Position &p) { return p[0] - 0.6; });
        set_boundary(problem.scene, cases::Side::x_min, fixed_wall(-1));
        const Outcome outcome = run(*method, problem, n);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        EXPECT_GE(outcome.lowest, -1 - 1e-12);
        EXPECT_LE(outcome.highest, 1);
        fronts.push_back(
            std::abs(std::sqrt(0.16 + solid_volume(outcome) / (0.5 * pi)) - front));
        spacing.push_back(1. / n);
      }
      EXPECT_GE(fitted_order(spacing, fronts), 1.3);
      EXPECT_LE(fronts.back(), 5e-4);
    }

    // Half of a ball of ice melts in a can: the front is oblique to the lattice.
    TEST(Axis, ABallMelts)
    {
      cases::OracleProblem oracle;
      oracle.symmetry = cases::Symmetry::spherical;
      oracle.material = contrast();
      oracle.outer = 1.6;
      oracle.end_time = 0.1;
      oracle.initial_fronts = {0.6};
      oracle.initial_temperature = [](double r)
      { return r < 0.6 ? 0.5 * (r * r / 0.36 - 1) : 2 * std::sin(pi / 2 * (r - 0.6)); };
      oracle.nodes = 24;
      oracle.tolerance = 1e-9;
      const auto exact = std::make_shared<cases::SpectralOracle>(oracle);
      const double front = exact->front(0.1);
      std::vector<double> spacing, fronts;
      for(const int n : {12, 24, 48})
      {
        Problem problem;
        problem.scene = about_axis(contrast(), 0, 0, 0.1);
        problem.scene.domain.upper[1] = 1;
        problem.scene.initial.temperature
            = field_of([&](const cases::Position &p)
                       { return oracle.initial_temperature(std::hypot(p[0], p[1])); });
        problem.scene.initial.front = field_of([](const cases::Position &p)
                                               { return std::hypot(p[0], p[1]) - 0.6; });
        for(const cases::Side side : {cases::Side::x_max, cases::Side::y_max})
          set_boundary(
              problem.scene, side,
              held([exact](const cases::Position &p, double time)
                   { return exact->temperature(std::hypot(p[0], p[1]), time); }));
        const Outcome outcome = run(*method, problem, n);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        fronts.push_back(
            std::abs(std::cbrt(solid_volume(outcome) * 3 / (2 * pi)) - front));
        spacing.push_back(1. / n);
      }
      EXPECT_GE(fitted_order(spacing, fronts), 0.6);
      EXPECT_LE(fronts.back(), 1e-3);
    }

    // Through each wall, and released throughout.
    TEST(Axis, HeatComesInByTheWallsArea)
    {
      for(const double inner : {0., 0.2})
        for(const char *scheme : {"rkl2", "euler", "crank-nicolson"})
        {
          Problem problem;
          problem.scene = about_axis(unit_material(100), inner, 1, 0.05);
          for(const cases::Side side :
              {cases::Side::x_max, cases::Side::y_min, cases::Side::y_max})
            set_boundary(problem.scene, side, flux_wall(0.25));
          if(inner > 0)
            set_boundary(problem.scene, cases::Side::x_min, flux_wall(0.25));
          problem.scene.volumetric_source = cases::Field::uniform(0.7);
          const Outcome outcome = run(*method, problem, 16, {{"time_scheme", scheme}});
          const double across = pi * (1 - inner * inner);
          EXPECT_NEAR(outcome.heat.boundary,
                      0.05 * 0.25 * (2 * across + 2 * pi * (1 + inner) * 0.5), 1e-12);
          EXPECT_NEAR(outcome.heat.sources, 0.05 * 0.7 * across * 0.5, 1e-12);
          EXPECT_LE(outcome.largest_defect, 1e-11);
        }
    }

    TEST(Axis, RefusesParticlesThatReachFarther)
    {
      Problem problem;
      problem.scene = about_axis(unit_material(), 0, 1, 0.01);
      EXPECT_THROW(run(*method, problem, 16, {{"smoothing_length", "1.3"}}),
                   cases::Refusal);
      EXPECT_THROW(run(*method, problem, 16, {{"jitter", "0.1"}}), cases::Refusal);
      EXPECT_THROW(run(*method, problem, 17, {{"layout", "edge"}}), cases::Refusal);
      EXPECT_THROW(run(*make_sph_2005(), problem, 17), cases::Refusal);
    }
  } // namespace
} // namespace meltfront::particles::testing
