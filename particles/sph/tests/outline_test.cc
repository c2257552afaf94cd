#include <cases/error.h>
#include <particles/sph/discretisation.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::testing
{
  namespace
  {
    using namespace cases;

    /** Two sinks in the cavity of the case cavity-two-sinks. */
    Problem cavity(double end_time)
    {
      Scene scene;
      scene.domain.shape = DomainShape::outline;
      scene.domain.dimension = 2;
      scene.domain.outline = std::make_shared<const Outline>(
          [](double phi)
          {
            return 0.42
                   * (1 + 0.18 * std::cos(2 * phi) + 0.12 * std::sin(phi)
                      - 0.08 * std::sin(3 * phi));
          },
          Outline::Point{0, 0});
      for(int d = 0; d < 2; ++d)
      {
        scene.domain.lower[d] = scene.domain.outline->lower()[d];
        scene.domain.upper[d] = scene.domain.outline->upper()[d];
      }
      scene.domain.reference_length = 1;
      scene.boundaries[static_cast<std::size_t>(Side::outer)] = cases::Boundary{};
      scene.material = water();
      scene.initial.temperature = Field::uniform(10);
      scene.end_time = end_time;
      constexpr double strength = 148.449955;
      for(const double x : {-0.25, 0.25})
        scene.sources.push_back({{x, -0.1, 0},
                                 "constant",
                                 [](double) { return -strength; },
                                 [](double time) { return -strength * time; }});
      return {scene, nullptr};
    }

    std::size_t particles_of(const Scene &scene, int n, const OptionTexts &options)
    {
      Resolution resolution;
      resolution.n = n;
      resolution.options = Options(make_sph()->option_declarations());
      for(const auto &[key, text] : options)
        resolution.options.set(key, text);
      return Discretisation(scene,
                            resolve_parameters(corrected_policy(), scene, resolution))
          .particles.size();
    }

    // The counts of an independent code on the same lattice.
    TEST(OutlineLattice, HoldsTheParticlesInside)
    {
      const Problem problem = cavity(1);
      const int n[] = {20, 40, 60, 80, 120};
      const std::size_t counts[] = {204, 860, 1972, 3550, 8054};
      for(int i = 0; i < 5; ++i)
        EXPECT_EQ(particles_of(problem.scene, n[i], {{"layout", "edge"}}), counts[i]);
    }

    TEST(OutlineLattice, IsSymmetricToTheLastBit)
    {
      const Problem problem = cavity(1);
      Resolution resolution;
      resolution.n = 30;
      resolution.options = Options(make_sph()->option_declarations());
      const Discretisation dis(
          problem.scene,
          resolve_parameters(corrected_policy(), problem.scene, resolution));
      std::vector<Position> points, mirrored;
      for(std::size_t i = 0; i < dis.particles.size(); ++i)
      {
        points.push_back(dis.particles.point(i));
        mirrored.push_back({-points[i][0], points[i][1], 0});
      }
      std::ranges::sort(points);
      std::ranges::sort(mirrored);
      EXPECT_EQ(points, mirrored);
    }

    TEST(OutlineLattice, WeighsTheArea)
    {
      const Problem problem = cavity(1);
      for(const int n : {20, 33})
      {
        double area = 0;
        for(const double weight : run(*make_sph(), problem, n).weights)
          area += weight;
        const double exact = problem.scene.domain.outline->area();
        EXPECT_NEAR(area, exact, 1e-13 * exact) << n;
      }
    }

    TEST(OutlineRun, KeepsItsBudgetAndItsBounds)
    {
      for(const auto &method : {make_sph(), make_sph_2005()})
      {
        const Problem problem = cavity(100000);
        const Outcome outcome = run(*method, problem, 20);
        const double drawn = 2 * 148.449955 * 100000;
        EXPECT_NEAR(outcome.heat.sources, -drawn, 1e-12 * drawn);
        EXPECT_NEAR(outcome.heat.initial - outcome.heat.stored - outcome.heat.latent,
                    drawn, 1e-12 * outcome.heat.initial);
        EXPECT_EQ(outcome.heat.boundary, 0);
        EXPECT_LE(outcome.largest_defect, 1e-12);
        EXPECT_LE(outcome.highest, 10);
        EXPECT_LT(outcome.lowest, 0);
      }
    }

    /** What a polygon bounds, of ones. */
    Problem within(std::vector<Outline::Point> corners, const Field &temperature,
                   double melting_temperature, double end_time)
    {
      Scene scene;
      scene.domain.shape = DomainShape::outline;
      scene.domain.dimension = 2;
      scene.domain.outline = std::make_shared<const Outline>(std::move(corners));
      for(int d = 0; d < 2; ++d)
      {
        scene.domain.lower[d] = scene.domain.outline->lower()[d];
        scene.domain.upper[d] = scene.domain.outline->upper()[d];
      }
      scene.domain.reference_length = 1;
      scene.boundaries[static_cast<std::size_t>(Side::outer)] = cases::Boundary{};
      scene.material = unit_material(melting_temperature);
      scene.initial.temperature = temperature;
      scene.end_time = end_time;
      return {scene, nullptr};
    }

    /** An L, oblique to the lattice, above y = 0. */
    std::vector<Outline::Point> oblique_angle_iron()
    {
      std::vector<Outline::Point> corners;
      for(const auto &[x, y] : {Outline::Point{0.0, 0.0},
                                {1., 0.},
                                {1., 0.4},
                                {0.4, 0.4},
                                {0.4, 1.},
                                {0., 1.}})
        corners.push_back({x * std::cos(0.3) - y * std::sin(0.3),
                           x * std::sin(0.3) + y * std::cos(0.3)});
      return corners;
    }

    double harmonic(const Position &p)
    {
      return p[0] * p[0] - p[1] * p[1] + 0.5 * p[0];
    }

    /** Of a steady harmonic temperature, from which a run starts. */
    struct SteadyError
    {
      double root_mean_square, mean;
    };

    SteadyError steady_error(const cases::Boundary &wall, int n)
    {
      Problem problem = within(oblique_angle_iron(), field_of(harmonic), -10, 0.2);
      problem.scene.boundaries[static_cast<std::size_t>(Side::outer)] = wall;
      const Outcome outcome = run(*make_sph(), problem, n);
      EXPECT_LE(outcome.largest_defect, 1e-11);
      double area = 0, sum = 0, squares = 0;
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
      {
        const double x = outcome.position_x[i], r = outcome.distance[i];
        const double y = std::sqrt(std::max(r * r - x * x, 0.)),
                     error = outcome.temperature[i] - harmonic({x, y, 0});
        area += outcome.weights[i];
        sum += outcome.weights[i] * error;
        squares += outcome.weights[i] * error * error;
      }
      return {std::sqrt(squares / area), sum / area};
    }

    // Walls of all kinds at which a harmonic function is at rest, on sides that are
    // oblique to the lattice, with a corner that points inwards.
    TEST(OutlineRun, WallsHoldASteadyTemperature)
    {
      const Outline outline(oblique_angle_iron());
      const auto flux = [outline](const Position &p)
      {
        const auto [nx, ny] = outline.nearest_edge(p).normal;
        return (2 * p[0] + 0.5) * nx - 2 * p[1] * ny;
      };
      constexpr double coefficient = 3;
      const cases::Boundary held{.kind = BoundaryKind::fixed_temperature,
                                 .value = field_of(harmonic)},
          heated{.kind = BoundaryKind::flux, .value = field_of(flux)},
          exchanging{.kind = BoundaryKind::heat_transfer,
                     .value = field_of([flux](const Position &p)
                                       { return harmonic(p) + flux(p) / coefficient; }),
                     .heat_transfer_coefficient = coefficient};
      struct Expected
      {
        const cases::Boundary &wall;
        double least_order, error_at_80;
      };
      const std::vector<int> n{20, 28, 40, 56, 80};
      for(const auto &[wall, least_order, at_80] :
          {Expected{held, 1.1, 3e-4}, Expected{heated, 0.9, 8e-3},
           Expected{exchanging, 0.9, 2.5e-3}})
      {
        std::vector<double> errors;
        for(const int particles : n)
        {
          const auto [root_mean_square, mean] = steady_error(wall, particles);
          errors.push_back(root_mean_square);
          // All of what is given arrives, though no side is along the lattice.
          if(wall.kind == BoundaryKind::flux)
          {
            EXPECT_NEAR(mean, 0, 1e-11) << particles;
          }
        }
        EXPECT_GE(fitted_order(n, errors), least_order) << to_string(wall.kind);
        EXPECT_LE(errors.back(), at_80) << to_string(wall.kind);
      }
    }

    // Two rooms with a slit between them that is narrower than what particles reach over,
    // and joined far below: for a short time neither feels the other.
    TEST(OutlineRun, ParticlesDoNotActAcrossASlit)
    {
      constexpr double half = 0.004;
      const std::vector<Outline::Point> rooms{{-0.5, 0},  {0.5, 0},    {0.5, 1},
                                              {half, 1},  {half, 0.1}, {-half, 0.1},
                                              {-half, 1}, {-0.5, 1}};
      const Field start = field_of([](const Position &p) { return p[0] < 0 ? 1. : 3.; });
      for(const double warm_wall : {0., 1.})
      {
        Problem problem = within(rooms, start, -10, 4e-3);
        if(warm_wall > 0)
          problem.scene.boundaries[static_cast<std::size_t>(Side::outer)]
              = {.kind = BoundaryKind::fixed_temperature, .value = start};
        const Outcome outcome = run(*make_sph(), problem, 30);
        int looked_at = 0;
        for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
        {
          const double x = outcome.position_x[i], r = outcome.distance[i];
          if(r * r - x * x < 0.5 * 0.5)
            continue;
          EXPECT_NEAR(outcome.temperature[i], x < 0 ? 1 : 3, 1e-3) << x;
          ++looked_at;
        }
        EXPECT_GT(looked_at, 300);
      }
    }

    TEST(OutlineRun, RefusesWhatHoldsNoParticle)
    {
      Problem problem = cavity(100);
      problem.scene.domain.reference_length = 10;
      EXPECT_THROW(run(*make_sph(), problem, 5), Refusal);
    }

    TEST(OutlineRun, AsPublishedWallsAreInsulated)
    {
      Problem problem = cavity(100);
      problem.scene.boundaries[static_cast<std::size_t>(Side::outer)] = fixed_wall(0);
      EXPECT_THROW(run(*make_sph_2005(), problem, 20), Refusal);
    }
  } // namespace
} // namespace meltfront::particles::testing
