// Run on any number of ranks (ctest: on one and on two): what a rank sees of a run that
// all share is the same as what the serial engine, or the same engine on one rank, gives.

#include <cases/error.h>
#include <cases/exact/line_sink.h>
#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <reference_fem/enthalpy/distributed/rank_run.h>
#include <reference_fem/enthalpy/distributed/shared_search.h>
#include <reference_fem/enthalpy/enthalpy.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>

namespace meltfront::reference_fem::tests
{
  namespace
  {
    using namespace cases;
    using namespace test_support;

    int all_ranks()
    {
      return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    }

    /** What a run showed at its end and after every step. */
    struct Shown
    {
      std::vector<double> time, latent, boundary, defect;
      std::map<std::array<long, 3>, double> temperature; ///< by place in 1e-9 of a metre
      Cost cost;
      StepStatistics statistics;
    };

    struct Interruption
    {
    };

    struct Watch : Observer, private StateKeeper
    {
      explicit Watch(Shown &shown)
        : shown(shown)
      {
      }

      bool wants(long, double) override
      {
        return true;
      }

      void observe(const Snapshot &snapshot) override
      {
        shown.time.push_back(snapshot.time);
        shown.latent.push_back(snapshot.heat.latent);
        shown.boundary.push_back(snapshot.heat.boundary);
        shown.defect.push_back(snapshot.heat.defect());
        shown.temperature.clear();
        for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
        {
          std::array<long, 3> place{};
          for(int d = 0; d < snapshot.dimension; ++d)
            place[d] = std::lround(1e9 * snapshot.positions[d][i]);
          shown.temperature[place] = snapshot.temperature[i];
        }
      }

      StateKeeper *state_keeper() override
      {
        return left_after < 0 && state.empty() ? nullptr : this;
      }

      std::unique_ptr<std::istream> state_to_resume() override
      {
        return state.empty() ? nullptr : std::make_unique<std::istringstream>(state);
      }

      void offer(long step, double,
                 const std::function<void(std::ostream &)> &save) override
      {
        if(step != left_after)
          return;
        std::ostringstream out;
        save(out);
        state = out.str();
        throw Interruption();
      }

      Shown &shown;
      long left_after = -1; ///< step after which the run is left, its state kept
      std::string state;    ///< from which it goes on
    };

    template <typename Make>
    void watch_run(const Scene &scene, int n, const OptionTexts &options,
                   const Make &make, Watch &watch)
    {
      const EffectSet effects = effects_called_for(scene);
      const Scene simulated = simulated_scene(scene, effects);
      const auto method = make_fem_enthalpy();
      const Resolution resolution = resolution_of(*method, n, options);
      const Stopwatch stopwatch;
      const auto run = make(simulated, effects, resolution);
      watch.shown.cost = run->carry_out(simulated, stopwatch, watch);
      watch.shown.statistics = run->worst_of_steps();
    }

    void watch_on_ranks(const Scene &scene, int n, int ranks, const OptionTexts &options,
                        Watch &watch)
    {
      watch_run(
          scene, n, options,
          [ranks](const Scene &simulated, const EffectSet &effects,
                  const Resolution &resolution)
          { return std::make_unique<RankRun>(simulated, effects, resolution, ranks); },
          watch);
    }

    Shown on_ranks(const Scene &scene, int n, int ranks, const OptionTexts &options = {})
    {
      Shown shown;
      Watch watch(shown);
      watch_on_ranks(scene, n, ranks, options, watch);
      return shown;
    }

    Shown serially(const Scene &scene, int n, const OptionTexts &options = {})
    {
      Shown shown;
      Watch watch(shown);
      watch_run(
          scene, n, options,
          [](const Scene &simulated, const EffectSet &effects,
             const Resolution &resolution)
          { return std::make_unique<EnthalpyRun>(simulated, effects, resolution); },
          watch);
      return shown;
    }

    /** Steps, latent heat after each, temperatures at the sites that this rank has. */
    void expect_same(const Shown &one, const Shown &other, double tolerance)
    {
      ASSERT_EQ(one.time, other.time);
      double largest = 0;
      for(const double latent : other.latent)
        largest = std::max(largest, std::abs(latent));
      for(std::size_t k = 0; k < one.latent.size(); ++k)
      {
        EXPECT_NEAR(one.latent[k], other.latent[k], tolerance * largest);
        EXPECT_LE(one.defect[k], 1e-12);
      }
      double span = 0, off = 0;
      for(const auto &[place, temperature] : one.temperature)
      {
        const auto found = other.temperature.find(place);
        ASSERT_NE(found, other.temperature.end());
        span = std::max(span, std::abs(temperature));
        off = std::max(off, std::abs(temperature - found->second));
      }
      EXPECT_LE(off, 10 * tolerance * span);
      EXPECT_LE(one.statistics.graph_inconsistency,
                NonlinearSolver::accepted_inconsistency);
      EXPECT_LE(one.statistics.balance_defect, accepted_balance_defect);
    }

    /** On these ranks, on one rank and serially. */
    void expect_same_everywhere(const Scene &scene, int n,
                                const OptionTexts &options = {})
    {
      const Shown shared = on_ranks(scene, n, all_ranks(), options);
      expect_same(shared, on_ranks(scene, n, 1, options), 1e-10);
      expect_same(shared, serially(scene, n, options), 1e-10);
    }

    Scene line_sink_square(double end = 475000)
    {
      const auto exact = std::make_shared<LineSink>(water(), 0.15, 10);
      Scene scene = box(water(), 2, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, 10, end);
      scene.sources.push_back(steady_sink({0.01, -0.02, 0}, exact->strength()));
      for(const Side side : scene.sides())
        set_boundary(scene, side, exact_wall(exact));
      return scene;
    }

    /** Ice with cold walls of all kinds, of other properties than the water's. */
    Scene walls_of_all_kinds()
    {
      Scene scene = box(water(), 2, {0, 0, 0}, {1, 0.5, 0}, 3, 4e6);
      set_boundary(scene, Side::x_min, fixed_wall(-8));
      set_boundary(scene, Side::x_max, flux_wall(-40));
      Boundary convection;
      convection.kind = BoundaryKind::heat_transfer;
      convection.value = Field::uniform(-5);
      convection.heat_transfer_coefficient = 20;
      set_boundary(scene, Side::y_min, convection);
      Boundary radiation;
      radiation.kind = BoundaryKind::radiation;
      radiation.value = Field::uniform(-20);
      radiation.emission_coefficient = 0.9 * 5.670374419e-8;
      radiation.absolute_zero = -273.15;
      set_boundary(scene, Side::y_max, radiation);
      scene.volumetric_source = Field::uniform(30);
      return scene;
    }
  } // namespace

  TEST(RankRun, LineSinkIsTheSerialOne)
  {
    expect_same_everywhere(line_sink_square(), 32);
  }

  TEST(RankRun, LongStepsMoveFrontsFar)
  {
    const OptionTexts few_steps{{"steps", "10"}};
    const Scene scene = line_sink_square();
    expect_same_everywhere(scene, 128, few_steps);
  }

  TEST(RankRun, WallsOfAllKindsAndReleasedHeat)
  {
    expect_same_everywhere(walls_of_all_kinds(), 32);
  }

  TEST(RankRun, OneSlopeAndNoLatentHeat)
  {
    Material plain = unit_material();
    plain.latent_heat = 0;
    Scene scene = box(plain, 2, {0, 0, 0}, {1, 1, 0}, 1, 0.1);
    set_boundary(scene, Side::y_min, fixed_wall(-1));
    expect_same_everywhere(scene, 16);
    Scene freezing = box(unit_material(), 2, {0, 0, 0}, {1, 1, 0}, 0.3, 0.1);
    set_boundary(freezing, Side::y_min, fixed_wall(-1));
    expect_same_everywhere(freezing, 16, {{"time_scheme", "backward-euler"}});
  }

  TEST(RankRun, InSpace)
  {
    Scene scene = box(water(), 3, {0, 0, 0}, {1, 0.5, 0.25}, 2, 2e6);
    set_boundary(scene, Side::x_min, fixed_wall(-10));
    set_boundary(scene, Side::z_max, fixed_wall(-4));
    expect_same_everywhere(scene, 16);
  }

  // A body about its axis, a source on it; without its core; in steps that move fronts
  // far.
  TEST(RankRun, AboutAnAxis)
  {
    Scene scene = walls_of_all_kinds();
    scene.domain.shape = DomainShape::axisymmetric;
    set_boundary(scene, Side::x_min, Boundary());
    set_boundary(scene, Side::x_max, fixed_wall(-8));
    scene.sources.push_back(steady_sink({0, 0.2, 0}, -3));
    expect_same_everywhere(scene, 32);
    expect_same_everywhere(scene, 128, {{"steps", "10"}});
    Scene hollow = walls_of_all_kinds();
    hollow.domain.shape = DomainShape::axisymmetric;
    hollow.domain.lower = {0.25, -0.5, 0};
    hollow.domain.upper = {1.25, 1.5, 0};
    hollow.initial.temperature
        = field_of([](const Position &p) { return p[0] + p[1] < 0.7 ? -3. : 2.; });
    expect_same_everywhere(hollow, 16);
  }

  // The rank that holds one phase only is to average like the others.
  TEST(RankRun, StartsFromAFrontAnywhere)
  {
    Scene scene = box(water(), 2, {-1, -1, 0}, {1, 1, 0}, 0, 2e5);
    const auto level
        = [](const Position &p) { return std::hypot(p[0] - 0.61, p[1] - 0.57) - 0.23; };
    scene.initial.temperature
        = field_of([level](const Position &p) { return 5 * level(p); });
    scene.initial.front = field_of(level);
    expect_same_everywhere(scene, 32);
    scene.initial.front.reset();
    expect_same_everywhere(scene, 32);
  }

  TEST(RankRun, RepeatsToTheBit)
  {
    const Scene scene = line_sink_square(2e5);
    const Shown one = on_ranks(scene, 32, all_ranks()),
                other = on_ranks(scene, 32, all_ranks());
    EXPECT_EQ(one.latent, other.latent);
    EXPECT_EQ(one.boundary, other.boundary);
    EXPECT_EQ(one.temperature, other.temperature);
  }

  TEST(RankRun, GoesOnToTheBitWhereItWasLeft)
  {
    for(const auto &[scene, options] :
        {std::pair(walls_of_all_kinds(), OptionTexts()),
         std::pair(line_sink_square(), OptionTexts{{"steps", "10"}})})
    {
      const Shown whole = on_ranks(scene, 32, all_ranks(), options);
      for(const long step : {0, 1, 8})
      {
        Shown left, resumed;
        Watch leaves(left), goes_on(resumed);
        leaves.left_after = step;
        EXPECT_THROW(watch_on_ranks(scene, 32, all_ranks(), options, leaves),
                     Interruption);
        goes_on.state = leaves.state;
        watch_on_ranks(scene, 32, all_ranks(), options, goes_on);
        const auto rest
            = static_cast<std::ptrdiff_t>(whole.time.size() - resumed.time.size());
        EXPECT_EQ(rest, step + 1);
        EXPECT_TRUE(std::equal(whole.latent.begin() + rest, whole.latent.end(),
                               resumed.latent.begin(), resumed.latent.end()));
        EXPECT_TRUE(std::equal(whole.boundary.begin() + rest, whole.boundary.end(),
                               resumed.boundary.begin(), resumed.boundary.end()));
        EXPECT_EQ(resumed.temperature, whole.temperature);
        EXPECT_EQ(resumed.cost.work, whole.cost.work);
        EXPECT_EQ(resumed.cost.evidence, whole.cost.evidence);
        for(std::size_t e = 0; e < whole.cost.effects.size(); ++e)
          EXPECT_EQ(resumed.cost.effects[e].calls, whole.cost.effects[e].calls);
      }
    }
  }

  // On as many ranks each goes on from its part of the state, on others from all parts.
  TEST(RankRun, GoesOnOnAnotherNumberOfRanks)
  {
    const OptionTexts few_steps{{"steps", "10"}};
    for(const auto &scene : {walls_of_all_kinds(), line_sink_square()})
    {
      const Shown whole = on_ranks(scene, 32, all_ranks(), few_steps);
      for(const auto &[before, after] :
          {std::pair(all_ranks(), 1), std::pair(1, all_ranks())})
      {
        Shown left, resumed;
        Watch leaves(left), goes_on(resumed);
        leaves.left_after = 5;
        EXPECT_THROW(watch_on_ranks(scene, 32, before, few_steps, leaves), Interruption);
        goes_on.state = leaves.state;
        if(before > 1)
        {
          goes_on.state.clear();
          for(const std::string &part :
              dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, leaves.state))
            goes_on.state += part;
        }
        watch_on_ranks(scene, 32, after, few_steps, goes_on);
        const auto rest = whole.time.size() - resumed.time.size();
        ASSERT_EQ(rest, 6u);
        const double scale = std::abs(*std::ranges::max_element(
            whole.latent, {}, [](double latent) { return std::abs(latent); }));
        for(std::size_t k = rest; k < whole.time.size(); ++k)
        {
          EXPECT_EQ(resumed.time[k - rest], whole.time[k]);
          EXPECT_NEAR(resumed.latent[k - rest], whole.latent[k], 1e-10 * scale);
          EXPECT_LE(resumed.defect[k - rest], 1e-12);
        }
        EXPECT_EQ(resumed.cost.steps, whole.cost.steps);
        // Ranks that iterate otherwise touch a little more or less.
        EXPECT_NEAR(double(resumed.cost.work), double(whole.cost.work),
                    0.1 * double(whole.cost.work));
      }
    }
  }

  TEST(RankRun, TellsWhatItDid)
  {
    const Shown shown = on_ranks(line_sink_square(2e5), 32, all_ranks());
    EXPECT_EQ(shown.cost.evidence.at("ranks"), all_ranks());
    EXPECT_EQ(shown.cost.unknowns, 31 * 31);
    EXPECT_GT(shown.cost.evidence.at("iterations_per_step"), 0);
    EXPECT_GT(shown.cost.evidence.at("reductions per step"), 0);
    EXPECT_EQ(shown.cost.evidence.at("bytes sent per step") > 0, all_ranks() > 1);
  }

  TEST(RankRun, RefusesByName)
  {
    const Scene scene = line_sink_square(2e5);
    EXPECT_THROW(on_ranks(scene, 97, all_ranks()), Refusal);
    EXPECT_THROW(on_ranks(scene, 32, all_ranks(), {{"refinement", "front"}}), Refusal);
    EXPECT_THROW(on_ranks(scene, 32, all_ranks(), {{"preconditioner", "amg"}}), Refusal);
    Scene outside = scene;
    outside.sources.front().position = {0.7, 0, 0};
    EXPECT_THROW(on_ranks(outside, 32, all_ranks()), InputError);
    Scene periodic = scene;
    set_boundary(periodic, Side::y_min, periodic_wall());
    set_boundary(periodic, Side::y_max, periodic_wall());
    EXPECT_THROW(on_ranks(periodic, 32, all_ranks()), Refusal);
  }

  // The minimum of a convex function of which every rank has a part.
  TEST(SharedSearch, FindsTheLowestPoint)
  {
    const auto rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    std::mt19937 random(7);
    for(int trial = 0; trial < 50; ++trial)
    {
      KinkedDerivative whole, part;
      Traffic traffic;
      std::uniform_real_distribution<double> number(0, 1);
      const int n_kinks = trial % 5 == 0 ? 0 : 1 + trial;
      whole.start = -n_kinks * number(random) - number(random) + (trial == 3 ? 9 : 0);
      whole.slope = 3 * number(random);
      for(int k = 0; k < n_kinks; ++k)
        whole.kinks.push_back(
            {number(random), 2 * number(random), number(random) - 0.2 / n_kinks});
      part.start = rank == 0 ? whole.start : 0;
      part.slope = whole.slope / all_ranks();
      for(int k = 0; k < n_kinks; ++k)
        if(k % all_ranks() == static_cast<int>(rank))
          part.kinks.push_back(whole.kinks[static_cast<std::size_t>(k)]);
      EXPECT_NEAR(lowest_of_all(part, MPI_COMM_WORLD, traffic), whole.lowest(), 2e-6);
    }
  }
} // namespace meltfront::reference_fem::tests

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
