#include <cases/error.h>
#include <cases/exact/manufactured/manufactured_solution.h>
#include <verification/measure/measure.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

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
    c.measurement.intermediate_times = {0.25, 0.64};
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

  /** All measures of a run that conducts heat. */
  class Measured
  {
  public:
    explicit Measured(const cases::Case &c)
      : measures(measures_for(MeasuredScenes::with_heat, {c, c.scene, 0.1}))
    {
    }

    void add(tests::State &state, double time,
             const std::vector<int> &intermediate_times = {}, bool at_end = false)
    {
      Sighting sighting{.snapshot = state.view(1, time),
                        .intermediate_times = intermediate_times,
                        .at_end = at_end};
      sighting.coordinates = &state.positions[0];
      for(const auto &measure : measures)
        measure->observe(sighting);
    }

    Results results() const
    {
      Results values;
      for(const auto &measure : measures)
        values.merge(measure->results());
      return values;
    }

  private:
    std::vector<std::unique_ptr<Measure>> measures;
  };
} // namespace

TEST(Measures, HaveQuantitiesOfDifferentNames)
{
  std::set<std::string> names;
  for(const Quantity &quantity : all_quantities())
  {
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
    EXPECT_EQ(quantity.heading.empty(), quantity.shown == Shown::nowhere)
        << quantity.name;
  }
  for(const Quantity &quantity : all_quantities())
    if(quantity.compared)
    {
      EXPECT_EQ(names.count(quantity.name + "_error"), 1u) << quantity.name;
      EXPECT_EQ(names.count(quantity.name + "_bars"), 1u) << quantity.name;
    }
  EXPECT_NO_THROW(require_quantity("front_rms"));
  EXPECT_THROW(require_quantity("front_rsm"), cases::InputError);
}

TEST(Measures, OfARunFillInWhatTheyDeclare)
{
  const cases::Case c = salty_case();
  Measured measured(c);
  tests::State state = exact_state(1);
  measured.add(state, 1, {}, true);
  for(const auto &[name, value] : measured.results())
    EXPECT_NO_THROW(require_quantity(name));
}

TEST(Measures, OfAMushAreTakenAtIntermediateTimesAndAtTheEnd)
{
  const cases::Case c = salty_case();
  Measured measured(c);
  const auto add = [&](double time, const std::vector<int> &intermediate_times = {},
                       bool at_end = false)
  {
    tests::State state = exact_state(time);
    state.temperature[0] += time;
    measured.add(state, time, intermediate_times, at_end);
  };
  add(0);
  add(0.3, {1});
  add(0.64, {2});
  add(1, {}, true);
  const Results quantities = measured.results();
  EXPECT_NEAR(quantities.at("temperature_rms_1"), 0.3 * std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(quantities.at("temperature_rms_2"), 0.64 * std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(quantities.at("temperature_rms"), std::sqrt(0.5), 1e-14);
  EXPECT_EQ(quantities.count("temperature_rms_3"), 0u);
  EXPECT_NEAR(quantities.at("solid_fraction_rms"), 0, 1e-15);
}

TEST(Measures, CountMassWhereAMethodDoes)
{
  cases::Case c = salty_case();
  c.scene.alloy.reset();
  c.scene.initial.concentration = {};
  Measured measured(c);
  tests::State state = exact_state(0.1);
  measured.add(state, 0.1);
  EXPECT_EQ(measured.results().count("mass_defect"), 0u);
  state.snapshot.mass = {2.02, 2};
  measured.add(state, 0.2);
  EXPECT_NEAR(measured.results().at("mass_defect"), 0.01, 1e-15);
  EXPECT_EQ(measured.results().count("solute_defect"), 0u);
}

TEST(Measures, KeepTheWorstDefectOfAnySnapshot)
{
  const cases::Case c = salty_case();
  Measured measured(c);
  tests::State state = exact_state(0.1);
  state.snapshot.mass = {2, 2};
  state.snapshot.solute[0] = {0.98, 1};
  measured.add(state, 0.1);
  state.snapshot.solute[0] = {1, 1};
  measured.add(state, 0.2);
  EXPECT_NEAR(measured.results().at("solute_defect"), 0.02, 1e-15);
  EXPECT_EQ(measured.results().at("mass_defect"), 0);
}

TEST(Measures, OfEntropySeeAFallRelativeToItsGain)
{
  cases::Case c = salty_case();
  c.measurement.absolute_zero = -100;
  Measured measured(c);
  const auto add = [&](double cold, double warm)
  {
    tests::State state = exact_state(0.1);
    state.solid_fraction = {0, 0};
    state.temperature = {cold, warm};
    measured.add(state, 0.1);
  };
  add(10, 30);
  add(20, 20);
  EXPECT_EQ(measured.results().at("entropy_fall"), 0);
  add(10, 30); // all that was gained is lost again
  EXPECT_NEAR(measured.results().at("entropy_fall"), 1, 1e-9);
  EXPECT_TRUE(std::isnan(measured.results().at("mixing_entropy_fall")));
}

/** All liquid, a front is off by the solid's volume over its area. */
TEST(FrontError, IsToldApartNearAMergeAndAfterIt)
{
  cases::Case c;
  c.scene = tests::scene_of(cases::DomainShape::box, 2, cases::Symmetry::none);
  c.scene.end_time = 0.6;
  const auto exact = std::make_shared<cases::ManufacturedSolution>(
      cases::Material{}, cases::make_front_family({.name = "two-disks", .dimension = 2}),
      1);
  c.exact = exact;
  tests::State liquid;
  liquid.positions = {{{0.1}, {0.2}, {0}}};
  liquid.weights = {1};
  liquid.temperature = {1};
  liquid.solid_fraction = {0};
  const auto measures = measures_for(MeasuredScenes::with_heat, {c, c.scene, 0.1});
  for(const double time : {0.1, 0.22, 0.4})
    for(const auto &measure : measures)
      measure->observe({.snapshot = liquid.view(2, time),
                        .front_counts = true,
                        .coordinates = &liquid.positions[0]});
  Results values;
  for(const auto &measure : measures)
    values.merge(measure->results());
  const auto off
      = [&](double time) { return exact->solid_volume(time) / exact->front_area(time); };
  EXPECT_DOUBLE_EQ(values.at("front_merge_rms"), off(0.22));
  EXPECT_DOUBLE_EQ(values.at("front_merged_rms"), off(0.4));
  EXPECT_TRUE(values.contains("front_merge_mismatch_rms"));
  EXPECT_TRUE(values.contains("front_merged_mismatch_rms"));
}
