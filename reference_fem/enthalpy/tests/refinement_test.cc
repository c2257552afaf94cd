#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/point_sink.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    constexpr double end = 475000;

    std::shared_ptr<const LineSink> line_sink()
    {
      return std::make_shared<LineSink>(water(), 0.15, 10);
    }

    void hold_walls(Scene &scene, const Boundary &wall)
    {
      for(const Side side : scene.sides())
        set_boundary(scene, side, wall);
    }

    /** Ice grows around a line sink in a square whose walls are exact. */
    Scene line_sink_square(const std::shared_ptr<const LineSink> &exact)
    {
      Scene scene = box(water(), 2, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, 10, end);
      scene.symmetry = Symmetry::cylindrical;
      scene.sources.push_back(steady_sink({}, exact->strength()));
      hold_walls(scene, exact_wall(exact));
      return scene;
    }

    OptionTexts refined(OptionTexts options = {})
    {
      options.emplace_back("refinement", "front");
      return options;
    }

    double evidence(const RunRecord &record, const std::string &name)
    {
      const auto found = record.cost.evidence.find(name);
      return found == record.cost.evidence.end() ? -1 : found->second;
    }

    void expect_sound(const RunRecord &record)
    {
      EXPECT_LE(record.worst_budget_defect(), 1e-13);
      EXPECT_LE(record.statistics.graph_inconsistency, 1e-11);
      EXPECT_EQ(record.cost.capped_steps, 0);
      EXPECT_GT(evidence(record, "adaptations"), 0);
      EXPECT_LE(evidence(record, "transfer_defect"), 1e-14);
      EXPECT_TRUE(record.obeys_maximum_principle);
      for(std::size_t k = 0; k < record.volume.size(); ++k)
        EXPECT_NEAR(record.volume[k], record.volume[0], 1e-12 * record.volume[0]);
    }

    /** Of what the front's error is on the lattice, and how many of its unknowns. */
    struct Comparison
    {
      double error, unknowns;
    };

    Comparison compare(const Scene &scene, int n, const ExactSolution &exact,
                       const OptionTexts &options = {})
    {
      const RunRecord lattice = run(scene, n, options, &exact),
                      adaptive = run(scene, n, refined(options), &exact);
      expect_sound(adaptive);
      return {adaptive.worst_front_error(scene.end_time / 2)
                  / lattice.worst_front_error(scene.end_time / 2),
              double(adaptive.cost.unknowns) / double(lattice.cost.unknowns)};
    }

    // Bounds set after measuring (1.17 to 1.27 times the error, 27.4/n): they guard. What
    // was wanted and what is missed stands in README.md.
    TEST(Refinement, LineSinkAsOnTheLatticeWithFewUnknowns)
    {
      const auto exact = line_sink();
      for(const int n : {32, 64, 128})
      {
        const Comparison now = compare(line_sink_square(exact), n, *exact);
        EXPECT_LE(now.error, 1.3) << n;
        EXPECT_LE(now.unknowns, std::min(0.9, 28. / n)) << n;
      }
    }

    TEST(Refinement, PointSinkAsOnTheLatticeWithFewUnknowns)
    {
      const auto exact = std::make_shared<PointSink>(water(), 0.15, 10);
      Scene scene = box(water(), 3, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 10, end);
      scene.symmetry = Symmetry::spherical;
      scene.sources.push_back({{},
                               "square root",
                               [exact](double time) { return -exact->strength(time); },
                               [exact](double time) { return -exact->energy(time); }});
      hold_walls(scene, exact_wall(exact));
      const Comparison now = compare(scene, 32, *exact);
      EXPECT_LE(now.error, 1.2);
      EXPECT_LE(now.unknowns, 0.6);
    }

    /** Nothing is partly solid but in cells at the front, however often cells are joined
     * behind it. */
    TEST(Refinement, LeavesNoMushBehind)
    {
      const auto exact = line_sink();
      const RunRecord record = run(line_sink_square(exact), 128, refined(), exact.get());
      int melting = 0;
      for(std::size_t i = 0; i < record.weights.size(); ++i)
        if(record.solid_fraction[i] > 0 && record.solid_fraction[i] < 1)
        {
          ++melting;
          const double r = std::hypot(record.positions[0][i], record.positions[1][i]);
          EXPECT_NEAR(r, record.front.back(), 2. / 128);
        }
      EXPECT_GT(melting, 20);
    }

    /** A square whose walls are warm and cold in turn: its fronts come, meet and vanish.
     */
    Scene square_with_turning_walls()
    {
      Material material = unit_material();
      material.liquid.conductivity = 0.3;
      Scene scene = box(material, 2, {0, 0, 0}, {1, 1, 0}, -0.2, 1);
      set_boundary(scene, Side::x_min,
                   varying_wall([](double time) { return std::sin(20 * time); }));
      set_boundary(scene, Side::y_max,
                   varying_wall([](double time) { return std::cos(20 * time); }));
      return scene;
    }

    TEST(Refinement, AHundredAdaptationsLoseNoHeat)
    {
      const RunRecord record
          = run(square_with_turning_walls(), 64, refined({{"steps", "1200"}}));
      expect_sound(record);
      EXPECT_GE(evidence(record, "adaptations"), 100);
      const double exchanged = std::abs(record.heat.boundary);
      EXPECT_GT(exchanged, 0.01);
      EXPECT_LE(std::abs(record.heat.imbalance()), 1e-11 * exchanged);
    }

    /** Largest difference of the solid volume from the lattice's over a run. */
    double difference_from_lattice(const Scene &scene, int n,
                                   const OptionTexts &options = {})
    {
      const RunRecord lattice = run(scene, n, options),
                      adaptive = run(scene, n, refined(options));
      expect_sound(adaptive);
      EXPECT_LT(adaptive.cost.unknowns, lattice.cost.unknowns);
      double largest = 0;
      for(std::size_t k = 0; k < lattice.time.size(); ++k)
      {
        if(lattice.time[k] != adaptive.time[k])
          return 1;
        largest = std::max(largest, std::abs(lattice.solid[k] - adaptive.solid[k]));
      }
      return largest / lattice.volume.back();
    }

    TEST(Refinement, FrontsThatComeAndMeetAreThoseOfTheLattice)
    {
      EXPECT_LE(difference_from_lattice(square_with_turning_walls(), 64), 2e-3);
      Scene cube = box(unit_material(), 3, {0, 0, 0}, {1, 1, 1}, -0.5, 0.05);
      hold_walls(cube, fixed_wall(1));
      EXPECT_LE(difference_from_lattice(cube, 32), 2e-3);
    }

    TEST(Refinement, OtherWallsAndAnAxis)
    {
      Scene scene = box(unit_material(), 2, {0, 0, 0}, {1, 0.5, 0}, 0.2, 0.2);
      set_boundary(scene, Side::x_min, flux_wall(-3));
      Boundary exchange = fixed_wall(-2);
      exchange.kind = BoundaryKind::heat_transfer;
      exchange.heat_transfer_coefficient = 5;
      set_boundary(scene, Side::y_max, exchange);
      EXPECT_LE(difference_from_lattice(scene, 64), 2e-3);
      scene.domain.shape = DomainShape::axisymmetric;
      set_boundary(scene, Side::x_min, Boundary());
      set_boundary(scene, Side::x_max, flux_wall(-1.5));
      EXPECT_LE(difference_from_lattice(scene, 64), 2e-3);
    }

    TEST(Refinement, RefusesByNameWhatItDoesNotCarryOver)
    {
      const auto refusal = [](const Scene &scene, int n)
      {
        try
        {
          run(scene, n, refined());
        }
        catch(const Refusal &refused)
        {
          return std::string(refused.what());
        }
        return std::string();
      };
      const auto expect_named = [](const std::string &text, const std::string &name)
      { EXPECT_NE(text.find(name), std::string::npos) << text; };

      const Scene square = line_sink_square(line_sink());
      expect_named(refusal(square, 33), "even");
      expect_named(refusal(square, 8), "16");
      Scene periodic = square;
      set_boundary(periodic, Side::y_min, periodic_wall());
      set_boundary(periodic, Side::y_max, periodic_wall());
      expect_named(refusal(periodic, 32), "periodic");
      expect_named(refusal(slab(water(), 1, 10, 1, fixed_wall(-1), Boundary()), 32),
                   "slab");
      expect_named(refusal(ball(water(), 2, 1, 10, 1), 32), "ball");
      Scene moving = square;
      moving.sources[0].path = Path{"path", [](double time) {
                                      return Position{time / end / 4, 0, 0};
                                    }};
      expect_named(refusal(moving, 32), "moving_source");
      Scene without_front = square;
      without_front.material.latent_heat = 0;
      expect_named(refusal(without_front, 32), "melts");
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
