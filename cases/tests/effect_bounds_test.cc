#include <cases/domain_measure.h>
#include <cases/effect_bounds.h>
#include <cases/scene_heat.h>
#include <cases/tests/support/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meltfront::cases;
using namespace meltfront::test_support;

namespace
{
  /** Liquid at 0.5 that freezes from a wall at -1 for a time; L = 2, the liquid conducts
   * a tenth better and stores a fifth more. */
  Scene freezing_slab(double end, const Boundary &far = Boundary())
  {
    Material material = unit_material(0);
    material.latent_heat = 2;
    material.liquid.conductivity = 1.1;
    material.liquid.specific_heat_capacity = 1.2;
    return slab(material, 1, 0.5, end, fixed_wall(-1), far);
  }

  EffectBound bound(Effect effect, const Scene &scene)
  {
    Scene less = scene;
    less.effect_choices[effect] = EffectChoice::off;
    return bound_of_effect(effect, simulated_scene(scene, effects_called_for(scene)),
                           simulated_scene(less, effects_called_for(less)));
  }

  const EffectDecision &decision(const EffectSet &effects, Effect effect)
  {
    return effects.decisions().at(static_cast<std::size_t>(effect));
  }
} // namespace

TEST(SceneHeat, BoundsWhatASlabExchanges)
{
  // All it can lose: (0.5 * 1.2 + 2 + 1).
  EXPECT_DOUBLE_EQ(bound_scene_heat(freezing_slab(1e3)).exchanged, 3.6);
  // In a short time sqrt(2 U t Delta), with U = 1.1 * 0.5 + 1.
  EXPECT_NEAR(bound_scene_heat(freezing_slab(1e-3)).exchanged,
              std::sqrt(2 * 1.55e-3 * 3.6), 1e-12);
  const SceneHeat heat = bound_scene_heat(freezing_slab(1e3));
  EXPECT_EQ(heat.course, HeatCourse::cooling);
  EXPECT_DOUBLE_EQ(heat.liquid.turned, 0.6);
  EXPECT_DOUBLE_EQ(heat.liquid.through_fronts, 0.6);
  // What the liquid gives, and the latent heat, pass into the solid.
  EXPECT_DOUBLE_EQ(heat.solid.through_fronts, 2.6);
}

TEST(SceneHeat, OfASlabBetweenTwoWallsHoldsTheSteadyLayer)
{
  // d = u_l/(u_l + u_s) = 0.55/1.55.
  const SceneHeat heat = bound_scene_heat(freezing_slab(2, fixed_wall(0.5)));
  EXPECT_NEAR(heat.liquid.through_fronts, (0.6 / 2 + 0.55 * 2) / (0.55 / 1.55), 1e-12);
  // Not where it may turn back.
  Scene both = freezing_slab(2, fixed_wall(0.7));
  EXPECT_EQ(bound_scene_heat(both).course, HeatCourse::both_ways);
  EXPECT_EQ(bound_scene_heat(both).liquid.through_fronts, infinity);
}

TEST(SceneHeat, ATemperatureThatIsDrivenBothWaysSwings)
{
  const Scene scene = slab(
      unit_material(0), 1, 0.5, 1, fixed_wall(-1),
      varying_wall([](double t) { return 0.2 * std::sin(2 * std::numbers::pi * t); }));
  const SceneHeat heat = bound_scene_heat(scene);
  // Twice the excess and the variation of the wall above the melting point, 2 * 0.2.
  const double excess = heat.bounds.upper;
  EXPECT_NEAR(excess, 0.5, 2e-3);
  EXPECT_NEAR(heat.liquid.turned, 2 * excess + 0.4, 1e-4);
}

TEST(DomainMeasure, OfEveryShape)
{
  EXPECT_EQ(volume_of(freezing_slab(1).domain), 1);
  EXPECT_EQ(area_of(freezing_slab(1).domain, Side::x_max), 1);
  const Domain disk = ball(unit_material(), 2, 2, 0, 1).domain;
  EXPECT_DOUBLE_EQ(volume_of(disk), 4 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(area_of(disk, Side::outer), 4 * std::numbers::pi);
  const Domain box_3d = box(unit_material(), 3, {0, 0, 0}, {1, 2, 3}, 0, 1).domain;
  EXPECT_DOUBLE_EQ(volume_of(box_3d), 6);
  EXPECT_DOUBLE_EQ(area_of(box_3d, Side::y_min), 3);
  Domain tube = box(unit_material(), 2, {1, 0, 0}, {2, 3, 0}, 0, 1).domain;
  tube.shape = DomainShape::axisymmetric;
  EXPECT_DOUBLE_EQ(volume_of(tube), 9 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(area_of(tube, Side::x_max), 12 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(area_of(tube, Side::y_max), 3 * std::numbers::pi);
}

TEST(EffectBounds, OfPropertiesAreThoseOfTheStefanNumberOfTheLiquid)
{
  const Scene scene = freezing_slab(1e3);
  // |1.1 - 1| (0.6 + 0.6), over L and over (1.5 K) c_min.
  const EffectBound conductivity = bound(Effect::phase_conductivity, scene);
  EXPECT_NEAR(conductivity.front, 0.06, 1e-12);
  EXPECT_NEAR(conductivity.temperature, 0.12 / 1.5, 1e-12);
  EXPECT_EQ(conductivity.words,
            "conductivity ratio 1.1, Stefan number of the liquid 0.3");
  // |1.2 - 1| theta, without the effect c = 1.
  const EffectBound capacity = bound(Effect::phase_heat_capacity, scene);
  EXPECT_NEAR(capacity.front, 0.05, 1e-12);
  // The same in a disk as a radius: front^2 of the diameter 2 pi/4.
  Scene disk = ball(scene.material, 2, 0.5, 0.5, 1e3);
  disk.symmetry = Symmetry::cylindrical;
  set_boundary(disk, Side::outer, fixed_wall(-1));
  EXPECT_NEAR(bound(Effect::phase_heat_capacity, disk).front, 0.5 * std::sqrt(0.05),
              1e-12);
}

TEST(EffectBounds, OfWhatHeatsAreTheHeat)
{
  Scene scene = freezing_slab(2);
  scene.volumetric_source = Field::uniform(1e-3);
  EXPECT_NEAR(bound(Effect::volumetric_source, scene).front, 1e-3 * 2 / 2, 1e-12);
  Boundary wall{BoundaryKind::heat_transfer, Field::uniform(-1)};
  wall.heat_transfer_coefficient = 1e-4;
  // The difference to the ambient temperature is 1.5 at most.
  EXPECT_NEAR(bound(Effect::robin_wall, freezing_slab(2, wall)).front, 1.5e-4, 1e-9);
  EXPECT_NEAR(bound(Effect::wall_flux, freezing_slab(2, flux_wall(-1e-3))).front, 1e-3,
              1e-12);
}

TEST(EffectBounds, AreZeroWhereNothingOfItHappens)
{
  Scene warm = freezing_slab(1);
  set_boundary(warm, Side::x_min, fixed_wall(0.1));
  EXPECT_EQ(bound(Effect::phase_change, warm).largest(), 0);
  EXPECT_GT(bound(Effect::phase_change, freezing_slab(1)).largest(), 1);
  Scene at_melting = freezing_slab(1);
  at_melting.initial.temperature = Field::uniform(0);
  EXPECT_EQ(bound(Effect::phase_conductivity, at_melting).largest(), 0);
  Scene curved = freezing_slab(1);
  curved.material.gibbs_thomson_coefficient = 0.1;
  EXPECT_EQ(bound(Effect::gibbs_thomson, curved).largest(), 0);
}

TEST(EffectsWithin, LeaveOutTheLeastFirstAndSayWhy)
{
  Scene scene = freezing_slab(1e3);
  scene.material.liquid.conductivity = 1.001;
  scene.material.liquid.specific_heat_capacity = 1.002;
  EXPECT_TRUE(effects_within(scene, 0).contains(Effect::phase_conductivity));
  // 6.7e-4 and 6.7e-4 of the range of temperature: together more than 1e-3.
  const EffectSet one = effects_within(scene, 1e-3);
  EXPECT_NE(one.contains(Effect::phase_conductivity),
            one.contains(Effect::phase_heat_capacity));
  const EffectSet none = effects_within(scene, 2e-3);
  EXPECT_FALSE(none.contains(Effect::phase_conductivity));
  EXPECT_TRUE(decision(none, Effect::phase_conductivity)
                  .reason.starts_with(
                      "left out: changes front and temperature by at most 0.00067 "
                      "(conductivity ratio 1.001"));
  EXPECT_TRUE(none.contains(Effect::wall_temperature));
  EXPECT_NE(decision(none, Effect::wall_temperature).reason.find("it may change front"),
            std::string::npos);
  scene.effect_choices[Effect::phase_conductivity] = EffectChoice::on;
  EXPECT_TRUE(effects_within(scene, 2e-3).contains(Effect::phase_conductivity));
}

TEST(EffectsWithin, WithoutABoundAnEffectStaysOn)
{
  Scene scene = freezing_slab(1);
  scene.material.gibbs_thomson_coefficient = 1e-9;
  scene.symmetry = Symmetry::none;
  scene.domain = box(scene.material, 2, {0, 0, 0}, {1, 1, 0}, 0.5, 1).domain;
  for(const Side side : {Side::y_min, Side::y_max})
    set_boundary(scene, side, Boundary());
  const EffectSet effects = effects_within(scene, 0.9);
  EXPECT_TRUE(effects.contains(Effect::gibbs_thomson));
  EXPECT_TRUE(effects.contains(Effect::phase_conductivity));
  EXPECT_NE(decision(effects, Effect::phase_conductivity)
                .reason.find("no bound on its change: there is none beside curved"),
            std::string::npos);
}
