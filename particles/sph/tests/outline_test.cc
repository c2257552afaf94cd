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

    TEST(OutlineRun, InsulatedWallsOnly)
    {
      Problem problem = cavity(100);
      problem.scene.boundaries[static_cast<std::size_t>(Side::outer)] = fixed_wall(0);
      EXPECT_THROW(run(*make_sph(), problem, 20), Refusal);
      problem = cavity(100);
      problem.scene.domain.reference_length = 10;
      EXPECT_THROW(run(*make_sph(), problem, 5), Refusal) << "no particle inside";
    }
  } // namespace
} // namespace meltfront::particles::testing
