#include <cases/error.h>
#include <verification/measure/checks/snapshot_checks.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <optional>

namespace meltfront::verification
{
  namespace
  {
    using cases::BoundaryKind, cases::DomainShape, cases::FrontOrigin, cases::Side;

    /** Whether a text holds another; a failure shows both. */
    testing::AssertionResult says(const std::string &text, const std::string &part)
    {
      if(text.find(part) != std::string::npos)
        return testing::AssertionSuccess();
      return testing::AssertionFailure() << '"' << text << "\" lacks \"" << part << '"';
    }

    constexpr int n = 50;
    constexpr double spacing = 1. / n;

    void set_wall(cases::Scene &scene, Side side, BoundaryKind kind, double value)
    {
      scene.boundaries[static_cast<std::size_t>(side)]
          = cases::Boundary{kind, cases::Field::uniform(value), false, 0};
    }

    /** Liquid at 1, of which all properties are 1, and a wall at -1. */
    cases::Scene freezing_slab()
    {
      cases::Scene scene = tests::scene_of(DomainShape::slab, 1, cases::Symmetry::planar);
      set_wall(scene, Side::x_min, BoundaryKind::fixed_temperature, -1);
      return scene;
    }

    /** Solid up to a front, of which a cell may be in part, and T = x - front. */
    tests::State state_with(double front)
    {
      tests::State state;
      for(int i = 0; i < n; ++i)
      {
        const double x = (i + 0.5) / n;
        state.positions[0].push_back(x);
        state.weights.push_back(1. / n);
        state.solid_fraction.push_back(std::clamp(front * n - i, 0., 1.));
        const double fraction = state.solid_fraction.back();
        state.temperature.push_back(fraction > 0 && fraction < 1 ? 0 : x - front);
      }
      return state;
    }

    cases::Capabilities capable_of(std::vector<FrontOrigin> origins)
    {
      cases::Capabilities result;
      result.front_origins = std::move(origins);
      return result;
    }

    std::optional<Check> find(const std::vector<Check> &checks, const std::string &name)
    {
      const auto found = std::ranges::find(checks, name, &Check::name);
      return found == checks.end() ? std::nullopt : std::optional<Check>(*found);
    }

    /** The sentence with which a snapshot ends a run, `refused: ` before that of a
     * Refusal; empty if it passes. */
    std::string judged(SnapshotChecks &checks, const cases::Snapshot &snapshot)
    {
      try
      {
        checks.judge(snapshot);
      }
      catch(const cases::Refusal &refusal)
      {
        return std::string("refused: ") + refusal.what();
      }
      catch(const cases::NumericalError &error)
      {
        return error.what();
      }
      return {};
    }

    std::string judged(const cases::Scene &scene, const cases::Snapshot &snapshot,
                       const cases::Capabilities &capabilities
                       = capable_of({FrontOrigin::wall}))
    {
      SnapshotChecks checks(scene, capabilities, "fake", spacing);
      return judged(checks, snapshot);
    }

    TEST(SnapshotChecks, PassAnHonestState)
    {
      const cases::Scene scene = freezing_slab();
      SnapshotChecks checks(scene, capable_of({FrontOrigin::wall}), "fake", spacing);
      for(const double front : {0.013, 0.3, 0.777})
      {
        tests::State state = state_with(front);
        state.snapshot.front[0] = {&front, 1};
        state.book(1);
        EXPECT_EQ(judged(checks, state.view(1, 0.5)), "");
      }
      for(const char *name : {"phase against temperature", "maximum principle",
                              "heat of sites", "heat of sources", "front against phases"})
      {
        const std::optional<Check> check = find(checks.checks(), name);
        ASSERT_TRUE(check) << name;
        EXPECT_TRUE(check->passed) << name;
      }
      EXPECT_FALSE(find(checks.checks(), "heat of walls"));
      EXPECT_EQ(checks.unchecked().at("heat of walls"),
                "the heat through x_min depends on the solution");
    }

    TEST(SnapshotChecks, FindLiquidThatAWallShouldFreeze)
    {
      const cases::Scene scene = freezing_slab();
      tests::State state = state_with(0.2);
      state.solid_fraction.assign(n, 0);
      const cases::Snapshot &snapshot = state.view(1, 0.5);
      EXPECT_TRUE(says(judged(scene, snapshot),
                       "fake, step 0, t = 0.5: phase is liquid at x = 0.01, 0.19 K below "
                       "its melting temperature; so is 0.2 of the domain"));
      EXPECT_EQ(judged(scene, snapshot, capable_of({FrontOrigin::initial_front})),
                "refused: fake does not simulate fronts that set out from a wall; at t = "
                "0.5 the liquid at x = 0.01 is 0.19 K below its melting temperature");
    }

    TEST(SnapshotChecks, JudgeTheStablePhaseBesideAMetastableOne)
    {
      // Liquid beyond the front is undercooled; solid that a wall melts is not excused.
      cases::Scene scene = freezing_slab();
      scene.initial.front = cases::Field{
          "", [](const cases::Position &p, double) { return p[0] - 0.4; }, false};
      scene.initial.temperature = cases::Field{
          "", [](const cases::Position &p, double) { return std::min(0., 0.4 - p[0]); },
          false};
      set_wall(scene, Side::x_min, BoundaryKind::fixed_temperature, 0.3);
      const cases::Capabilities able
          = capable_of({FrontOrigin::initial_front, FrontOrigin::wall});
      tests::State state = state_with(0.4);
      for(int i = 0; i < n; ++i)
        state.temperature[i] = std::min(0., 0.4 - state.positions[0][i]);
      EXPECT_EQ(judged(scene, state.view(1, 0.5), able), "");
      for(int i = 0; i < 10; ++i)
        state.temperature[i] = 0.3 - i * 0.03;
      EXPECT_TRUE(
          says(judged(scene, state.view(1, 0.5), able),
               "phase is solid at x = 0.01, 0.3 K above its melting temperature"));
    }

    TEST(SnapshotChecks, FindASecondFrontThatIsIgnored)
    {
      const cases::Scene scene = freezing_slab();
      tests::State state = state_with(0.5);
      for(int i = 40; i < n; ++i)
        state.temperature[i] = -0.1;
      cases::Capabilities one = capable_of({FrontOrigin::wall});
      one.most_fronts = 1;
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5), one),
                       "refused: fake does not simulate a second front"));
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5)), "phase is liquid at"));
    }

    TEST(SnapshotChecks, RefuseAFrontThatSetsOutWhereHeatIsReleasedThroughout)
    {
      cases::Scene scene = freezing_slab();
      tests::State state = state_with(0.5);
      const double front = 0.5;
      state.snapshot.front[0] = {&front, 1};
      for(int i = 35; i < n - 5; ++i)
        state.temperature[i] = -0.1;
      for(const double released : {-4., 4.})
      {
        scene.volumetric_source = cases::Field::uniform(released);
        SnapshotChecks checks(scene, capable_of({FrontOrigin::wall}), "fake", spacing);
        const std::string sentence = judged(checks, state.view(1, 0.5));
        EXPECT_TRUE(says(sentence,
                         released < 0 ? "refused: fake does not simulate fronts that set "
                                        "out where heat is released throughout"
                                      : "phase is liquid at"))
            << sentence;
      }
    }

    TEST(SnapshotChecks, LeaveOutSitesBesideAFrontAndCapillarity)
    {
      cases::Scene scene = freezing_slab();
      tests::State state = state_with(0.5);
      state.temperature[25] = -0.1;
      EXPECT_EQ(judged(scene, state.view(1, 0.5)), "");
      state.temperature[30] = -0.1;
      EXPECT_NE(judged(scene, state.view(1, 0.5)), "");
      // A body four spacings across melts 0.1 lower.
      scene.material.gibbs_thomson_coefficient = 0.101 * 2 * spacing;
      EXPECT_EQ(judged(scene, state.view(1, 0.5)), "");
    }

    TEST(SnapshotChecks, HoldAnAlloyAgainstItsLiquidus)
    {
      cases::Scene scene = freezing_slab();
      scene.alloy = cases::Alloy{.solutes = {{.name = "salt", .liquidus_slope = 2}},
                                 .eutectic_temperature = -0.5};
      tests::State state = state_with(0.5);
      state.solid_fraction.assign(n, 0);
      state.temperature.assign(n, -0.3);
      state.concentration[0].assign(n, 0.2);
      EXPECT_EQ(judged(scene, state.view(1, 0.5)), "") << "the liquidus is -0.4";
      state.concentration[0].assign(n, 0.1);
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5)), "liquid"));
      state.solid_fraction.assign(n, 1);
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5)), "solid"));
      state.temperature.assign(n, -0.6);
      EXPECT_EQ(judged(scene, state.view(1, 0.5)), "");
      state.solid_fraction.assign(n, 0);
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5)), "liquid"));
    }

    TEST(SnapshotChecks, AllowTheDeclaredOvershootOnly)
    {
      const cases::Scene scene = freezing_slab();
      cases::Capabilities capabilities = capable_of({FrontOrigin::wall});
      capabilities.overshoot = {.at_twenty = 0.05, .order = 1}; // 0.02 of 2 at n = 50
      tests::State state = state_with(0.5);
      state.snapshot.obeys_maximum_principle = false;
      state.temperature.back() = 1.039;
      EXPECT_EQ(judged(scene, state.view(1, 0.5), capabilities), "");
      state.temperature.back() = 1.041;
      EXPECT_EQ(
          judged(scene, state.view(1, 0.5), capabilities),
          "fake, step 0, t = 0.5: temperature is 1.041 at x = 0.99, above the highest "
          "initial and wall value 1 by 0.0205 of the span of the bounds, more than "
          "0.02 (maximum principle)");
      state.temperature.back() = 1.001;
      state.snapshot.obeys_maximum_principle = true;
      EXPECT_TRUE(
          says(judged(scene, state.view(1, 0.5), capabilities), "maximum principle"));
    }

    TEST(SnapshotChecks, PassABodyAtRest)
    {
      cases::Scene scene = tests::scene_of(DomainShape::slab, 1, cases::Symmetry::planar);
      scene.initial.temperature = cases::Field::uniform(1.2);
      tests::State state = state_with(0);
      state.temperature.assign(n, 1.2 * (1 + 1e-15));
      state.book(2.2);
      state.snapshot.heat.boundary = 0;
      EXPECT_EQ(judged(scene, state.view(1, 0.5)), "");
      state.temperature[7] = 1.2 + 1e-6;
      EXPECT_NE(judged(scene, state.view(1, 0.5)), "");
    }

    TEST(SnapshotChecks, HoldTheBookAgainstSitesAndScene)
    {
      cases::Scene scene = tests::scene_of(DomainShape::slab, 1, cases::Symmetry::planar);
      scene.initial.temperature = cases::Field::uniform(-1);
      set_wall(scene, Side::x_max, BoundaryKind::flux, 2);
      tests::State state = state_with(1); // -1/2 stored on average
      state.temperature.assign(n, 0);
      state.book(-1); // 1 has come in
      SnapshotChecks checks(scene, capable_of({FrontOrigin::none}), "fake", spacing);
      EXPECT_EQ(judged(checks, state.view(1, 0.5)), "");
      EXPECT_TRUE(find(checks.checks(), "heat of walls")->passed);
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.4)),
                       "heat of walls is 1 in the book, and 0.8 by the scene's data"));
      state.snapshot.heat.stored += 0.1;
      state.snapshot.heat.boundary += 0.1;
      EXPECT_TRUE(says(judged(checks, state.view(1, 0.5)), "heat of the sites is 0 "));
      EXPECT_FALSE(find(checks.checks(), "heat of sites")->passed);
      state.book(-1);
      state.snapshot.heat.sources = 0.1;
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5)), "heat of sources is 0.1"));
    }

    TEST(SnapshotChecks, FindHeatThatIsUnaccountedFor)
    {
      // Liquid at rest that a method booked a third of its heat into from nowhere.
      cases::Scene scene = tests::scene_of(DomainShape::slab, 1, cases::Symmetry::planar);
      tests::State state = state_with(-0.5);
      state.temperature.assign(n, 1);
      state.book(1);
      cases::HeatBudget &heat = state.snapshot.heat;
      const double content = heat.stored + heat.latent;
      heat.initial = content;
      heat.boundary = heat.sources = 0;
      EXPECT_EQ(judged(scene, state.view(1, 0.5)), "");
      heat.initial = content * 2 / 3;
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5)), "heat balance leaves"));
      heat.initial = content * (1 - 2 * spacing);
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5)), "heat balance leaves"));
      // A method that does not conserve may be off by some layers of one spacing.
      cases::Capabilities loses = capable_of({FrontOrigin::wall});
      loses.conserves_heat = false;
      EXPECT_EQ(judged(scene, state.view(1, 0.5), loses), "");
      heat.initial = content * 2 / 3;
      EXPECT_TRUE(says(judged(scene, state.view(1, 0.5), loses), "heat balance leaves"));
    }

    // A wall that was hot for a moment does not widen what may be lost later.
    TEST(SnapshotChecks, APulseThatHasPassedExcusesNoLoss)
    {
      cases::Scene scene = tests::scene_of(DomainShape::slab, 1, cases::Symmetry::planar);
      set_wall(scene, Side::x_max, BoundaryKind::fixed_temperature, 1000);
      cases::Capabilities loses = capable_of({FrontOrigin::wall});
      loses.conserves_heat = false;
      SnapshotChecks checks(scene, loses, "fake", spacing);
      tests::State state = state_with(-0.5);
      cases::HeatBudget &heat = state.snapshot.heat;
      const auto judge_with_loss = [&](double time, double loss)
      {
        state.book(1);
        heat.initial = heat.stored + heat.latent + loss;
        heat.boundary = heat.sources = 0;
        return judged(checks, state.view(1, time));
      };
      state.temperature.assign(n, 1);
      state.temperature.back() = 900;
      EXPECT_EQ(judge_with_loss(0.25, 5), "") << "a part of a layer that is hot";
      state.temperature.back() = 1;
      EXPECT_TRUE(says(judge_with_loss(0.5, 5), "heat balance leaves 5"));
    }

    TEST(SnapshotChecks, FindAFrontWhereNoPhaseChangesAndOneThatIsMissing)
    {
      const cases::Scene scene = freezing_slab();
      SnapshotChecks checks(scene, capable_of({FrontOrigin::wall}), "fake", spacing);
      tests::State state = state_with(0.3);
      const double right = 0.3, wrong = 0.7;
      state.snapshot.front[0] = {&right, 1};
      EXPECT_EQ(judged(checks, state.view(1, 0.5)), "");
      state.snapshot.front[0] = {&wrong, 1};
      EXPECT_TRUE(says(judged(checks, state.view(1, 0.5)),
                       "front is reported at x = 0.7, where no phase changes"));
      state.snapshot.front[0] = {};
      EXPECT_TRUE(says(judged(checks, state.view(1, 0.5)),
                       "front is not reported, and there are both phases"));
      EXPECT_EQ(judged(scene, state.view(1, 0.5)), "") << "a method that tracks none";
    }

    // A layer of few particles may be hotter than where it melts, and is solid.
    TEST(SnapshotChecks, FluctuationsOfFewParticlesAreNoBreach)
    {
      cases::Scene scene = freezing_slab();
      tests::State state = state_with(0.5);
      state.temperature[3] = 0.4;
      const auto judged = [&]
      {
        SnapshotChecks checks(scene, capable_of({FrontOrigin::wall}), "fake", spacing);
        checks.judge(state.view(1, 0));
        return checks.unchecked();
      };
      EXPECT_THROW(judged(), cases::NumericalError);
      scene.particle_solid = cases::ParticleSolid();
      const auto unchecked = judged();
      for(const char *name : {"maximum principle", "phase against temperature"})
        EXPECT_TRUE(says(unchecked.at(name), "fluctuates"));
    }
  } // namespace
} // namespace meltfront::verification
