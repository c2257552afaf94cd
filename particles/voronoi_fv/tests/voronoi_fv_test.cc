#include <cases/error.h>
#include <cases/exact/lattice_reference.h>
#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/relaxation/relax_nodes.h>
#include <particles/voronoi_fv/cell_conduction.h>
#include <particles/voronoi_fv/voronoi_fv.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::particles
{
  namespace
  {
    using cases::BoundaryKind;
    using cases::Position;
    constexpr double pi = std::numbers::pi;

    using namespace test_support;

    double squares(const Position &p)
    {
      return std::sin(5 * pi * p[0]) + std::sin(5 * pi * p[1]);
    }

    /** Chapter 5's problem. */
    cases::Scene sine_squares()
    {
      cases::Scene scene = steady_box(2, cases::Field::uniform(0));
      scene.volumetric_source = field_of(squares);
      return scene;
    }

    struct Outcome : Course
    {
      /** Unweighted error over the sites, relative. */
      double error(const std::function<double(const Position &)> &exact) const
      {
        double difference = 0, sum = 0;
        for(std::size_t i = 0; i < temperature.size(); ++i)
        {
          const double expected = exact(place(i));
          difference += (temperature[i] - expected) * (temperature[i] - expected);
          sum += expected * expected;
        }
        return std::sqrt(difference / sum);
      }
    };

    Outcome solve(const cases::Scene &scene, int n, const OptionTexts &options,
                  std::uint64_t seed = 1)
    {
      const auto method = make_voronoi_fv();
      Outcome outcome;
      test_support::solve(*method, scene, resolution_of(*method, n, options, 1, seed),
                          outcome);
      return outcome;
    }

    const cases::LatticeReference &reference()
    {
      static const cases::LatticeReference solution(
          {{0, 0, 0}, {1, 1, 0}, 1, squares, [](const Position &) { return 0.; }, 101});
      return solution;
    }

    double error_of(int n, const std::string &arrangement, std::uint64_t seed = 1,
                    const std::string &source = "particle")
    {
      return solve(sine_squares(), n, {{"arrangement", arrangement}, {"source", source}},
                   seed)
          .error([](const Position &p) { return reference().temperature(p, 1); });
    }

    double median(std::vector<double> values)
    {
      std::ranges::sort(values);
      const std::size_t half = values.size() / 2;
      return values.size() % 2 == 1 ? values[half]
                                    : 0.5 * (values[half - 1] + values[half]);
    }

    TEST(VoronoiFv, TheReportsLattice)
    {
      EXPECT_NEAR(error_of(10, "lattice"), 0.1657, 0.001);
      EXPECT_NEAR(error_of(20, "lattice"), 0.0408, 0.0005);
      EXPECT_NEAR(error_of(40, "lattice"), 0.0092, 0.0003);
    }

    TEST(VoronoiFv, EverySeedImproves)
    {
      std::vector<double> random, relaxed, centroid;
      for(std::uint64_t seed = 1; seed <= 30; ++seed)
      {
        random.push_back(error_of(10, "random", seed));
        relaxed.push_back(error_of(10, "relaxed", seed));
        centroid.push_back(error_of(10, "random", seed, "centroid"));
        EXPECT_LT(relaxed.back(), random.back()) << seed;
      }
      EXPECT_NEAR(median(relaxed), 0.160, 0.006);
      EXPECT_GT(median(random), 0.65);
      EXPECT_LT(median(random), 1.05);
      EXPECT_LT(median(centroid), 0.7 * median(random));
    }

    TEST(VoronoiFv, EverySeedImprovesWithFourTimesTheParticles)
    {
      std::vector<double> random, relaxed;
      for(std::uint64_t seed = 1; seed <= 5; ++seed)
      {
        random.push_back(error_of(20, "random", seed));
        relaxed.push_back(error_of(20, "relaxed", seed));
        EXPECT_LT(relaxed.back(), random.back()) << seed;
      }
      EXPECT_NEAR(median(relaxed), 0.0399, 0.0025);
    }

    TEST(VoronoiFv, LloydImprovesToo)
    {
      std::vector<double> swept;
      for(std::uint64_t seed = 1; seed <= 10; ++seed)
        swept.push_back(error_of(10, "lloyd", seed));
      EXPECT_LT(median(swept), 0.185);
    }

    TEST(VoronoiFv, LinearTemperaturesAreExactOnALattice)
    {
      for(int dimension = 1; dimension <= 3; ++dimension)
      {
        const auto plane
            = [](const Position &p) { return 1 + 2 * p[0] - p[1] + 3 * p[2]; };
        const cases::Scene scene = steady_box(
            dimension, field_of([&](const Position &p) { return plane(p); }));
        EXPECT_LT(solve(scene, 6, {{"arrangement", "lattice"}}).error(plane), 1e-12)
            << dimension;
      }
    }

    TEST(VoronoiFv, SecondOrderOnALattice)
    {
      cases::Scene scene = steady_box(2, cases::Field::uniform(0));
      const auto exact = [](const Position &p)
      { return std::sin(pi * p[0]) * std::sin(2 * pi * p[1]); };
      scene.volumetric_source
          = field_of([&](const Position &p) { return 5 * pi * pi * exact(p); });
      std::vector<double> errors;
      for(const int n : {7, 15, 31, 63})
        errors.push_back(solve(scene, n, {{"arrangement", "lattice"}}).error(exact));
      for(std::size_t level = 1; level < errors.size(); ++level)
        EXPECT_NEAR(std::log2(errors[level - 1] / errors[level]), 2, 0.1);
    }

    /** A wall with a temperature, one with a flux, one that exchanges heat, one
     * insulated: the temperature is 1 + 2 y, the conductivity 3. */
    TEST(VoronoiFv, FluxAndTransferOnWallsAreExactForALinearTemperature)
    {
      cases::Scene scene = steady_box(2, cases::Field::uniform(1));
      scene.material.solid.conductivity = scene.material.liquid.conductivity = 3;
      const auto exact = [](const Position &p) { return 1 + 2 * p[1]; };
      scene.boundaries[0] = scene.boundaries[1] = cases::Boundary{};
      scene.boundaries[3] = cases::Boundary{BoundaryKind::flux, cases::Field::uniform(6)};
      EXPECT_LT(solve(scene, 8, {{"arrangement", "lattice"}}).error(exact), 1e-12);
      scene.boundaries[3] = cases::Boundary{BoundaryKind::heat_transfer,
                                            cases::Field::uniform(6), false, 2};
      EXPECT_LT(solve(scene, 8, {{"arrangement", "lattice"}}).error(exact), 1e-12);
      scene.volumetric_source = cases::Field::uniform(4);
      EXPECT_LT(solve(scene, 8, {{"arrangement", "random"}}).worst_budget_defect(),
                1e-11);
    }

    TEST(VoronoiFv, AnInclusionBetweenCellsIsExact)
    {
      cases::Scene scene = steady_box(
          1, field_of([](const Position &p) { return p[0] > 0.5 ? 1. : 0.; }));
      scene.inclusion
          = cases::Inclusion{field_of([](const Position &p) { return p[0] - 0.5; }), 9};
      // n + 1 odd: the jump is midway between two particles.
      const auto exact = [](const Position &p)
      { return p[0] < 0.5 ? 0.2 * p[0] : 1 - 1.8 * (1 - p[0]); };
      EXPECT_LT(solve(scene, 10, {{"arrangement", "lattice"}}).error(exact), 1e-12);
    }

    TEST(VoronoiFv, TheMatrixIsASymmetricMMatrix)
    {
      for(const int dimension : {2, 3})
      {
        cases::Scene scene = steady_box(dimension, cases::Field::uniform(0));
        scene.boundaries[1] = cases::Boundary{BoundaryKind::heat_transfer,
                                              cases::Field::uniform(1), false, 2};
        const NodeSet nodes = arrange_nodes(scene, dimension == 2 ? 16 : 8,
                                            NodeArrangement::random, 0, 3, "a test");
        const CellConduction conduction(
            scene, nodes, voronoi_cells(nodes.positions, coordinate_box(scene.domain)),
            SourcePoint::centroid);
        const CompressedRows rows = conduction.problem().operator_rows;
        EXPECT_EQ(rows.asymmetry(), 0);
        for(std::size_t i = 0; i < rows.rows(); ++i)
        {
          double others = 0, diagonal = 0;
          for(std::size_t e = rows.offsets[i]; e < rows.offsets[i + 1]; ++e)
            if(rows.columns[e] == i)
              diagonal = rows.coefficients[e];
            else
            {
              EXPECT_GE(rows.coefficients[e], 0);
              others += rows.coefficients[e];
            }
          EXPECT_LT(diagonal, 0);
          EXPECT_LE(others, -diagonal * (1 + 1e-13));
        }
      }
    }

    TEST(VoronoiFv, HeatIsBalancedAndBoundsAreKeptOverTime)
    {
      cases::Scene scene = steady_box(
          2, {"", [](const Position &p, double t) { return p[0] + std::sin(20 * t); }});
      scene.problem = cases::ProblemKind::stefan;
      scene.end_time = 0.1;
      scene.boundaries[3] = cases::Boundary{BoundaryKind::flux, cases::Field::uniform(2)};
      scene.boundaries[1] = cases::Boundary{BoundaryKind::heat_transfer,
                                            cases::Field::uniform(1), false, 5};
      scene.volumetric_source = field_of(squares);
      for(const std::string scheme : {"backward-euler", "crank-nicolson", "bdf2"})
      {
        const Outcome outcome = solve(
            scene, 10,
            {{"arrangement", "random"}, {"time_scheme", scheme}, {"steps", "30"}});
        EXPECT_LT(outcome.worst_budget_defect(), 1e-11) << scheme;
        EXPECT_EQ(outcome.obeys_maximum_principle, scheme == "backward-euler");
      }
    }

    /** A discontinuous start on random cells, one long step: backward Euler keeps the
     * bounds (the run would stop if it did not). */
    TEST(VoronoiFv, BackwardEulerKeepsTheMaximumPrinciple)
    {
      cases::Scene scene = steady_box(2, cases::Field::uniform(0));
      scene.problem = cases::ProblemKind::stefan;
      scene.end_time = 0.01;
      scene.initial.temperature
          = field_of([](const Position &p) { return p[0] > 0.5 ? 1. : 0.; });
      for(std::uint64_t seed = 1; seed <= 5; ++seed)
        for(const double value : solve(scene, 15,
                                       {{"arrangement", "random"},
                                        {"time_scheme", "backward-euler"},
                                        {"steps", "1"}},
                                       seed)
                                     .temperature)
        {
          ASSERT_GE(value, -1e-12);
          ASSERT_LE(value, 1 + 1e-12);
        }
    }

    TEST(VoronoiFv, RefusesWhatItCannotTreat)
    {
      cases::Scene scene = sine_squares();
      EXPECT_THROW(solve(scene, 0, {}), cases::Refusal);
      scene.domain.shape = cases::DomainShape::ball;
      scene.domain.radius = 1;
      scene.boundaries[static_cast<std::size_t>(cases::Side::outer)]
          = scene.boundaries[0];
      EXPECT_THROW(solve(scene, 10, {}), cases::Refusal);
    }
  } // namespace
} // namespace meltfront::particles
