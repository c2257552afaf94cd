#include <cases/error.h>
#include <cases/exact/formula_solution.h>
#include <particles/sph/conduction_rows.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace meltfront::particles::testing
{
  namespace
  {
    using cases::Position;
    using std::numbers::pi;

    cases::Scene box_of(const Position &sides, double latent_heat = 0)
    {
      return box(unit_material(latent_heat), sides[2] > 0 ? 3 : 2, {0, 0, 0}, sides, 0,
                 0.05);
    }

    SphParameters of(const cases::Scene &scene, int n)
    {
      SphParameters parameters;
      parameters.dimension = scene.domain.dimension;
      parameters.n = n;
      return parameters;
    }

    const std::vector<Position> all_sides{{1, 0.846, 0},   {1, 1.37, 0},
                                          {1, 0.2143, 0},  {0.3, 0.2871, 0},
                                          {1, 0.87, 1.16}, {1, 0.46, 0.871}};

    TEST(StretchedCells, FillTheBox)
    {
      for(const Position &sides : all_sides)
      {
        const cases::Scene scene = box_of(sides);
        const Discretisation dis(scene, of(scene, 22));
        EXPECT_TRUE(dis.stretched());
        EXPECT_DOUBLE_EQ(dis.cell[0], sides[0] / 22);
        double volume = 1;
        for(int d = 0; d < dis.dimension; ++d)
        {
          volume *= sides[d];
          EXPECT_NEAR(std::ranges::min(dis.particles.position[d]), dis.cell[d] / 2,
                      1e-14);
          EXPECT_NEAR(std::ranges::max(dis.particles.position[d]),
                      sides[d] - dis.cell[d] / 2, 1e-14);
        }
        EXPECT_NEAR(std::accumulate(dis.weights.begin(), dis.weights.end(), 0.), volume,
                    1e-12 * volume);
      }
    }

    /** Largest difference, inside, of what flows into a particle from 2 V trace(A), u = x
     * A x, over 2 V. */
    double error_of_quadratic(const Position &sides,
                              const std::array<std::array<double, 3>, 3> &a, double h)
    {
      const cases::Scene scene = box_of(sides);
      SphParameters parameters = of(scene, 22);
      parameters.smoothing_length = h;
      const Discretisation dis(scene, parameters);
      const ConductionRows rows(dis, true);
      const auto u = [&](std::size_t i)
      {
        const Position p = dis.particles.point(i);
        double sum = 0;
        for(int d = 0; d < dis.dimension; ++d)
          for(int e = 0; e < dis.dimension; ++e)
            sum += p[d] * a[d][e] * p[e];
        return sum;
      };
      double trace = 0, worst = 0;
      for(int d = 0; d < dis.dimension; ++d)
        trace += a[d][d];
      int inside = 0;
      for(std::size_t i = 0; i < dis.particles.size(); ++i)
      {
        const Position p = dis.particles.point(i);
        bool inner = true;
        for(int d = 0; d < dis.dimension; ++d)
          inner = inner && std::min(p[d], sides[d] - p[d]) > 3.2 * dis.cell[d];
        if(!inner)
          continue;
        ++inside;
        double flow = 0;
        rows.rows.visit_row(i, [&](std::uint32_t b, double g)
                            { flow += g * (u(b) - u(i)); });
        worst = std::max(worst, std::abs(flow / (2 * dis.particle_volume) - trace));
      }
      EXPECT_GT(inside, 0);
      return worst;
    }

    // Conduction is exact for every quadratic, also along diagonals.
    TEST(StretchedCells, QuadraticsConductAsTheMaterialDoes)
    {
      for(const Position &sides : all_sides)
        if(sides[1] > 0.25)
          for(const double h : {1., 1.3})
          {
            EXPECT_LE(error_of_quadratic(sides, {{{1, 0, 0}, {}, {}}}, h), 1e-11);
            EXPECT_LE(error_of_quadratic(sides, {{{}, {0, 1, 0}, {}}}, h), 1e-11);
            EXPECT_LE(
                error_of_quadratic(sides, {{{2, 1, -1}, {0.5, -3, 2}, {0.3, 0.7, 1}}}, h),
                1e-11);
          }
    }

    // About an axis the circumferences at the middles of pairs keep that so.
    TEST(StretchedCells, QuadraticsAboutAnAxis)
    {
      cases::Scene scene = box_of({1, 0.846, 0});
      scene.domain.shape = cases::DomainShape::axisymmetric;
      scene.symmetry = cases::Symmetry::cylindrical;
      const Discretisation dis(scene, of(scene, 22));
      EXPECT_TRUE(dis.stretched());
      const ConductionRows rows(dis, true);
      for(std::size_t i = 0; i < dis.particles.size(); ++i)
      {
        const Position p = dis.particles.point(i);
        if(std::min({p[0], 1 - p[0], p[1], 0.846 - p[1]}) < 2.2 * dis.spacing)
          continue;
        std::array<double, 2> flow{};
        rows.rows.visit_row(i,
                            [&](std::uint32_t b, double g)
                            {
                              const Position other = dis.particles.point(b);
                              for(int d = 0; d < 2; ++d)
                                flow[d] += g * (other[d] * other[d] - p[d] * p[d]);
                            });
        const double ring = 2 * pi * p[0] * dis.particle_volume;
        EXPECT_NEAR(flow[0] / ring, 4, 1e-11);
        EXPECT_NEAR(flow[1] / ring, 2, 1e-11);
      }
    }

    /** Relative, of a wave in a liquid between held walls along y and insulated ones
     * along x, of decaying amplitude. */
    double error_of_wave(double height, int n)
    {
      Problem problem{box_of({1, height, 0}), nullptr};
      const double decay = pi * pi * (1 + 1 / (height * height));
      const auto exact = [=](const Position &p, double time)
      {
        return 2
               + std::cos(pi * p[0]) * std::sin(pi * p[1] / height)
                     * std::exp(-decay * time);
      };
      problem.scene.initial.temperature = {"", exact};
      set_boundary(problem.scene, cases::Side::y_min, fixed_wall(2));
      set_boundary(problem.scene, cases::Side::y_max, fixed_wall(2));
      const Outcome outcome = run(*make_sph(), problem, n, {{"dimension", "2"}});
      EXPECT_LE(outcome.largest_defect, 1e-12);
      const Discretisation dis(problem.scene, of(problem.scene, n));
      double sum = 0, size = 0;
      for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
      {
        const double true_one = exact(dis.particles.point(i), problem.scene.end_time);
        sum += std::pow(outcome.temperature[i] - true_one, 2);
        size += std::pow(true_one - 2, 2);
      }
      return std::sqrt(sum / size);
    }

    TEST(StretchedCells, WavesDecayWithSecondOrder)
    {
      for(const double height : {0.846, 1.37, 0.631})
      {
        std::vector<double> spacing, errors;
        for(const int n : {12, 17, 24, 34, 48})
        {
          spacing.push_back(1. / n);
          errors.push_back(error_of_wave(height, n));
        }
        EXPECT_LE(errors.back(), 6e-4) << height;
        EXPECT_GE(fitted_order(spacing, errors), 1.8) << height;
      }
    }

    /** Solid at the end that freezes from the wall y_min, over that of a slab's front. */
    double solid_over_exact(double height, int n)
    {
      const Problem slab = plane_freezing();
      Problem problem{box(slab.scene.material, 2, {0, 0, 0}, {1, height, 0},
                          slab.scene.initial.temperature({1, 0, 0}, 0),
                          slab.scene.end_time),
                      nullptr};
      set_boundary(problem.scene, cases::Side::y_min,
                   fixed_wall(slab.scene.boundary(cases::Side::x_min)
                                  .value({0, 0, 0}, slab.scene.end_time)));
      const Outcome outcome = run(*make_sph(), problem, n, {{"dimension", "2"}});
      EXPECT_LE(outcome.largest_defect, 1e-12);
      double solid = 0;
      for(std::size_t i = 0; i < outcome.weights.size(); ++i)
        solid += outcome.weights[i] * outcome.solid_fraction[i];
      return solid / slab.exact->front(slab.scene.end_time);
    }

    TEST(StretchedCells, AFrontAlongThemIsThatOfTheSlab)
    {
      const double height = plane_freezing().scene.domain.upper[0] * 0.9731;
      for(const int n : {20, 29, 41})
        EXPECT_NEAR(solid_over_exact(height, n), 1, 0.3 / n) << n;
    }

    void expect_refusal(const cases::Scene &scene, const cases::Method &method,
                        const std::string &what, const OptionTexts &options = {})
    {
      try
      {
        run(method, {scene, nullptr}, 20, options);
        ADD_FAILURE() << what;
      }
      catch(const std::exception &error)
      {
        EXPECT_NE(std::string(error.what()).find(what), std::string::npos)
            << error.what();
      }
    }

    TEST(StretchedCells, OthersNeedSquares)
    {
      const std::string fitting = "n = 500 fits";
      const cases::Scene scene = box_of({1, 0.846, 0}, 1);
      expect_refusal(scene, *make_sph_2005(), "n = 501 fits");
      expect_refusal(scene, *make_sph(), fitting, {{"jitter", "0.1"}});
      expect_refusal(scene, *make_sph(), fitting, {{"moment_correction", "false"}});
      expect_refusal(scene, *make_sph(), "n = 501 fits", {{"layout", "edge"}});
      expect_refusal(box_of({1, 0.113, 0}, 1), *make_sph(), "take n at least 36");
    }
  } // namespace
} // namespace meltfront::particles::testing
