#include <verification/measure/tests/fixtures.h>
#include <verification/run/alloy_measures.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meltfront;
using namespace meltfront::verification;

namespace
{
  cases::Case salty_case()
  {
    cases::Case c;
    c.scene = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
    c.scene.alloy.emplace();
    c.scene.alloy->solutes.push_back({.name = "salt", .liquidus_slope = 1});
    c.scene.initial.concentration = {cases::Field::uniform(0.1)};
    c.exact = std::make_shared<tests::HalfFrozen>();
    c.measurement.marks = {0.25, 0.64};
    return c;
  }

  /** Two sites, the first in the mush, in the exact state of a time. */
  tests::State exact_state(double time)
  {
    const tests::HalfFrozen exact;
    tests::State state;
    state.positions[0] = {0.1, 0.9};
    state.weights = {0.5, 0.5};
    for(const double x : state.positions[0])
    {
      state.temperature.push_back(exact.temperature(x, time));
      state.solid_fraction.push_back(exact.solid_fraction(x, time));
      state.concentration[0].push_back(0.1);
    }
    return state;
  }
} // namespace

TEST(AlloyMeasures, AMarkIsComparedInTheFirstSnapshotThatReachesIt)
{
  const cases::Case c = salty_case();
  AlloyMeasures measures(c, c.scene, 0.1);
  for(const double time : {0., 0.2, 0.3, 0.64, 1.})
  {
    tests::State state = exact_state(time);
    state.temperature[0] += time;
    const cases::Snapshot &snapshot = state.view(1, time);
    measures.add(snapshot, state.positions[0]);
    if(time == 1)
      measures.measure_end(snapshot, state.positions[0]);
  }
  const auto quantities = measures.quantities();
  EXPECT_NEAR(quantities.at("temperature_rms_1"), 0.3 * std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(quantities.at("temperature_rms_2"), 0.64 * std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(quantities.at("temperature_rms"), std::sqrt(0.5), 1e-14);
  EXPECT_TRUE(std::isnan(quantities.at("temperature_rms_3")));
  EXPECT_NEAR(quantities.at("solid_fraction_rms"), 0, 1e-15);
  ASSERT_EQ(measures.profiles().size(), 2u);
  EXPECT_EQ(measures.profiles()[0].time, 0.3);
  EXPECT_EQ(measures.profiles()[1].concentration.at(0),
            0.2); // in the half that is liquid
  EXPECT_EQ(measures.profiles()[1].solid_fraction_exact.at(0), 0.5);
}

TEST(AlloyMeasures, KeepTheWorstDefectOfAnySnapshot)
{
  const cases::Case c = salty_case();
  AlloyMeasures measures(c, c.scene, 0.1);
  tests::State state = exact_state(0.1);
  state.snapshot.mass = {2, 2};
  state.snapshot.solute[0] = {0.98, 1};
  measures.add(state.view(1, 0.1), state.positions[0]);
  state.snapshot.solute[0] = {1, 1};
  measures.add(state.view(1, 0.2), state.positions[0]);
  EXPECT_NEAR(measures.quantities().at("solute_defect"), 0.02, 1e-15);
  EXPECT_EQ(measures.quantities().at("mass_defect"), 0);
}

TEST(AlloyMeasures, AFallOfEntropyIsSeenRelativeToItsGain)
{
  cases::Case c = salty_case();
  c.measurement.absolute_zero = -100;
  AlloyMeasures measures(c, c.scene, 0.1);
  const auto add = [&](double cold, double warm)
  {
    tests::State state = exact_state(0.1);
    state.solid_fraction = {0, 0};
    state.temperature = {cold, warm};
    measures.add(state.view(1, 0.1), state.positions[0]);
  };
  add(10, 30);
  add(20, 20);
  EXPECT_EQ(measures.quantities().at("entropy_fall"), 0);
  add(10, 30); // all that was gained is lost again
  EXPECT_NEAR(measures.quantities().at("entropy_fall"), 1, 1e-9);
  EXPECT_TRUE(std::isnan(measures.quantities().at("mixing_entropy_fall")));
}
