#include <cases/numbers.h>
#include <verification/measure/measure.h>
#include <verification/measure/tests/fixtures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace meltfront;
using namespace meltfront::verification;

namespace
{
  constexpr int n_sites = 10;

  void give_wall(cases::Scene &scene, cases::Side side, cases::BoundaryKind kind,
                 double value)
  {
    scene.boundaries[static_cast<std::size_t>(side)]
        = {.kind = kind, .value = cases::Field::uniform(value)};
  }

  /** Liquid of one temperature in cells of a line, whose middles are the sites. */
  tests::State liquid(cases::Symmetry symmetry, double temperature)
  {
    tests::State state;
    const double h = symmetry == cases::Symmetry::planar ? 0.1 : 0.05;
    for(int i = 0; i < n_sites; ++i)
    {
      state.positions[0].push_back((i + 0.5) * h);
      state.weights.push_back(cases::volume_between(symmetry, i * h, (i + 1) * h));
      state.temperature.push_back(temperature);
      state.solid_fraction.push_back(0);
    }
    return state;
  }

  Results unseen(const cases::Case &c, tests::State &state, double front = cases::nan)
  {
    const double spacing = c.scene.symmetry == cases::Symmetry::planar ? 0.1 : 0.05;
    Sighting sighting{.snapshot = state.view(1, 1), .at_end = true};
    sighting.coordinates = &state.positions[0];
    sighting.front.latent_heat = front;
    Results values;
    for(const auto &measure :
        measures_for(MeasuredScenes::with_heat, {c, c.scene, spacing}))
    {
      measure->observe(sighting);
      values.merge(measure->results());
    }
    return values;
  }

  cases::Case slab_with(cases::BoundaryKind kind, double value)
  {
    cases::Case c;
    c.scene = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
    give_wall(c.scene, cases::Side::x_min, kind, value);
    return c;
  }
} // namespace

TEST(UnseenLayer, AtAColdWallIsHalfOfTheSiteNextToIt)
{
  const cases::Case c = slab_with(cases::BoundaryKind::fixed_temperature, -1);
  tests::State state = liquid(cases::Symmetry::planar, 1);
  const Results found = unseen(c, state, 0);
  EXPECT_NEAR(found.at("solid_volume_unseen"), 0.05, 1e-15);
  EXPECT_NEAR(found.at("front_unseen"), 0.05, 1e-15);
  EXPECT_NEAR(found.at("heat_unseen"), 0.05 * 1.5, 1e-15);
}

TEST(UnseenLayer, IsNoneWhereTheSiteFreezesOrLiesOnTheWallOrAFrontIsTracked)
{
  const cases::Case c = slab_with(cases::BoundaryKind::fixed_temperature, -1);
  tests::State begun = liquid(cases::Symmetry::planar, 1);
  begun.solid_fraction[0] = 0.01;
  EXPECT_EQ(unseen(c, begun, 0).at("solid_volume_unseen"), 0);
  tests::State tracked = liquid(cases::Symmetry::planar, 1);
  const std::vector<double> front{0.01};
  tracked.snapshot.front[0] = front;
  EXPECT_EQ(unseen(c, tracked, 0).at("solid_volume_unseen"), 0);
  tests::State on_wall = liquid(cases::Symmetry::planar, 1);
  on_wall.positions[0][0] = 0;
  EXPECT_EQ(unseen(c, on_wall, 0).at("solid_volume_unseen"), 0);
}

TEST(UnseenLayer, HoldsWhatMayBeLeftOfBodiesThatWereTakenOut)
{
  cases::Case c;
  c.scene = tests::scene_of(cases::DomainShape::slab, 1, cases::Symmetry::planar);
  for(const cases::DomainShape shape :
      {cases::DomainShape::slab, cases::DomainShape::outline})
  {
    c.scene.domain.shape = shape;
    tests::State state = liquid(cases::Symmetry::planar, 1);
    const std::vector<double> front{0.4};
    state.snapshot.front[0] = front;
    state.snapshot.vanished_volume = 0.003;
    EXPECT_EQ(unseen(c, state, 0).at("solid_volume_unseen"), 0.003);
  }
}

TEST(UnseenLayer, IsNoneAtAWallOfThePhaseThatIsThereOrBesideUndercooledLiquid)
{
  const cases::Case warm = slab_with(cases::BoundaryKind::fixed_temperature, 2),
                    cold = slab_with(cases::BoundaryKind::fixed_temperature, -1);
  tests::State state = liquid(cases::Symmetry::planar, 1);
  EXPECT_EQ(unseen(warm, state, 0).at("solid_volume_unseen"), 0);
  tests::State undercooled = liquid(cases::Symmetry::planar, -0.5);
  EXPECT_EQ(unseen(cold, undercooled, 0).at("solid_volume_unseen"), 0);
}

TEST(UnseenLayer, OfAGivenFluxIsNoMoreThanTheSitesSensibleHeatFreezes)
{
  // The wall is 0.05 * 30 = 1.5 K colder than the site.
  const cases::Case c = slab_with(cases::BoundaryKind::flux, -30);
  tests::State state = liquid(cases::Symmetry::planar, 0.2);
  const Results found = unseen(c, state, 0);
  EXPECT_NEAR(found.at("solid_volume_unseen"), 0.1 * 0.2, 1e-15);
  EXPECT_EQ(found.at("heat_unseen"), 0); // the heat is given
  const cases::Case gentle = slab_with(cases::BoundaryKind::flux, -3);
  EXPECT_EQ(unseen(gentle, state, 0).at("solid_volume_unseen"), 0);
}

TEST(UnseenLayer, InABallMovesTheFrontByItsVolume)
{
  cases::Case c;
  c.scene = tests::scene_of(cases::DomainShape::ball, 3, cases::Symmetry::spherical);
  give_wall(c.scene, cases::Side::outer, cases::BoundaryKind::fixed_temperature, -1);
  tests::State state = liquid(cases::Symmetry::spherical, 1);
  const Results found = unseen(c, state, 0.3);
  const double volume = state.weights.back() / 2;
  EXPECT_NEAR(found.at("solid_volume_unseen"), volume, 1e-15);
  const double moved = 0.3 + found.at("front_unseen");
  EXPECT_NEAR(4 * std::numbers::pi / 3 * (moved * moved * moved - 0.027), volume, 1e-14);
}
