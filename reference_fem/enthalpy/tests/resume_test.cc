#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;

    struct Interruption
    {
    };

    /** Keeps the state after one step, and ends the run there; or hands a state to it. */
    struct Keeper : Course, StateKeeper
    {
      StateKeeper *state_keeper() override
      {
        return this;
      }

      std::unique_ptr<std::istream> state_to_resume() override
      {
        return kept.empty() ? nullptr : std::make_unique<std::istringstream>(kept);
      }

      void offer(long step, double,
                 const std::function<void(std::ostream &)> &save) override
      {
        if(step != interrupted_after)
          return;
        std::ostringstream state;
        save(state);
        kept = state.str();
        throw Interruption();
      }

      std::string kept;
      long interrupted_after = -1;
    };

    Cost solve_kept(const Scene &scene, int n, OptionTexts options, Keeper &keeper)
    {
      options.emplace_back("checkpoint", "1");
      const auto method = make_fem_enthalpy();
      return test_support::solve(*method, scene, resolution_of(*method, n, options),
                                 keeper);
    }

    void expect_the_same(const Course &one, const Course &other)
    {
      EXPECT_EQ(one.temperature, other.temperature);
      EXPECT_EQ(one.solid_fraction, other.solid_fraction);
      EXPECT_EQ(one.positions, other.positions);
      EXPECT_EQ(one.weights, other.weights);
      EXPECT_EQ(one.cells, other.cells);
      EXPECT_EQ(one.heat.stored, other.heat.stored);
      EXPECT_EQ(one.heat.latent, other.heat.latent);
      EXPECT_EQ(one.heat.boundary, other.heat.boundary);
      EXPECT_EQ(one.heat.sources, other.heat.sources);
      EXPECT_EQ(one.heat.initial, other.heat.initial);
    }

    /** A run that is left after a step and taken up again ends as if it had not been. */
    void expect_resumable(const Scene &scene, int n, const OptionTexts &options,
                          const std::vector<long> &interruptions)
    {
      Keeper whole;
      const Cost cost = solve_kept(scene, n, options, whole);
      for(const long step : interruptions)
      {
        ASSERT_LT(step, cost.steps);
        Keeper first, second;
        first.interrupted_after = step;
        EXPECT_THROW(solve_kept(scene, n, options, first), Interruption);
        second.kept = first.kept;
        const Cost resumed = solve_kept(scene, n, options, second);
        EXPECT_EQ(second.step.front(), step + 1);
        EXPECT_EQ(second.time.back(), scene.end_time);
        expect_the_same(second, whole);
        EXPECT_EQ(resumed.steps, cost.steps);
        EXPECT_EQ(resumed.work, cost.work);
        EXPECT_EQ(resumed.solver_iterations, cost.solver_iterations);
        EXPECT_EQ(resumed.most_iterations, cost.most_iterations);
        for(const auto &[name, value] : cost.evidence)
          EXPECT_EQ(resumed.evidence.at(name), value) << name;
        for(std::size_t e = 0; e < cost.effects.size(); ++e)
          EXPECT_EQ(resumed.effects[e].calls, cost.effects[e].calls);
      }
    }

    /** A wall that varies, another whose flux has a pulse that ends in the run. */
    TEST(FemEnthalpyResume, SlabWithAPulse)
    {
      Boundary pulse = flux_wall(0);
      pulse.value
          = {.expression = "pulse",
             .value = [](const Position &, double t) { return t < 0.03 ? 8. : 0.; },
             .breakpoints = {0.03}};
      const Scene scene
          = slab(unit_material(), 1, -0.5, 0.1,
                 varying_wall([](double t) { return -1 + std::sin(40 * t); }), pulse);
      expect_resumable(scene, 40, {}, {0, 1, 3, 20, 49});
      expect_resumable(scene, 40, {{"front", "within_cells"}}, {17});
    }

    Scene square()
    {
      Material material = unit_material();
      material.solid.conductivity = 3;
      Scene scene = box(material, 2, {0, 0, 0}, {1, 1, 0}, 0.4, 0.2);
      set_boundary(scene, Side::x_min, fixed_wall(-1));
      set_boundary(scene, Side::y_max,
                   {.kind = BoundaryKind::heat_transfer,
                    .value = Field::uniform(-0.7),
                    .heat_transfer_coefficient = 5});
      return scene;
    }

    /** On a lattice large enough for multigrid, in steps that move fronts far. */
    TEST(FemEnthalpyResume, SquareInLongSteps)
    {
      expect_resumable(square(), 64, {{"steps", "8"}}, {1, 5});
    }

    TEST(FemEnthalpyResume, SourceThatMoves)
    {
      Scene scene = square();
      scene.sources = {{.position = {0.2, 0.5, 0},
                        .expression = "steady",
                        .power = [](double) { return 2.; },
                        .energy = [](double t) { return 2 * t; },
                        .path = Path{"path", [](double t) {
                                       return Position{0.2 + 2 * t, 0.5, 0};
                                     }}}};
      expect_resumable(scene, 24, {}, {2, 30});
    }

    /** The mesh that the run has made is taken up too. */
    TEST(FemEnthalpyResume, MeshRefinedAtTheFront)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      Scene scene = box(water(), 2, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, 10, 475000);
      scene.symmetry = Symmetry::cylindrical;
      scene.sources.push_back(steady_sink({}, exact->strength()));
      for(const Side side : scene.sides())
        set_boundary(scene, side, exact_wall(exact));
      expect_resumable(scene, 64, {{"refinement", "front"}}, {3, 31});
    }

    TEST(FemEnthalpyResume, RefusedWhereNothingKeepsStates)
    {
      const auto method = make_fem_enthalpy();
      NoObserver nobody;
      EXPECT_THROW(test_support::solve(*method, square(),
                                       resolution_of(*method, 8, {{"checkpoint", "1"}}),
                                       nobody),
                   Refusal);
    }
  } // namespace
} // namespace meltfront::reference_fem::tests
