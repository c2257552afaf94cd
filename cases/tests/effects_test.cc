#include <cases/effects.h>
#include <cases/scene.h>

#include <gtest/gtest.h>

#include <set>

using namespace meltfront::cases;

namespace
{
  /** A slab of one substance without sources, all walls insulated, no latent heat. */
  Scene bare_scene()
  {
    Scene scene;
    scene.symmetry = Symmetry::planar;
    scene.domain.upper = {1, 0, 0};
    scene.material.latent_heat = 0;
    scene.initial.temperature = Field::uniform(1);
    scene.boundaries[0] = Boundary();
    scene.boundaries[1] = Boundary();
    return scene;
  }

  /** A scene that calls for every effect. */
  Scene full_scene()
  {
    Scene scene = bare_scene();
    scene.material.latent_heat = 3;
    scene.material.liquid = {2, 4, 5};
    scene.material.gibbs_thomson_coefficient = 1e-7;
    scene.boundaries[0] = Boundary{BoundaryKind::fixed_temperature, Field::uniform(-1)};
    scene.boundaries[1] = Boundary{BoundaryKind::flux, Field::uniform(7)};
    scene.boundaries[2]
        = Boundary{BoundaryKind::heat_transfer, Field::uniform(0), false, 1};
    scene.boundaries[3]
        = Boundary{BoundaryKind::radiation, Field::uniform(0), false, 0, 1};
    scene.volumetric_source = Field::uniform(1);
    scene.inclusion = Inclusion{Field::uniform(-1), 3};
    scene.sources.resize(2);
    for(PointSource &source : scene.sources)
      source.power = [](double) { return 1.; };
    scene.sources[1].path = Path{"t", [](double t) { return Position{t, 0, 0}; }};
    const auto curve = std::make_shared<PropertyCurve>(
        std::vector<double>{-2, 2}, std::vector<double>{1, 2}, "table");
    scene.material.solid.conductivity_curve = curve;
    scene.material.liquid.heat_capacity_curve = curve;
    scene.material.melting_range = std::make_shared<MeltingRange>(
        MeltingRange{0, 1,
                     std::make_shared<PropertyCurve>(std::vector<double>{0, 1},
                                                     std::vector<double>{1, 0}, "linear"),
                     "linear"});
    scene.initial.front = Field::uniform(-1); // solid, though too warm
    scene.alloy.emplace();
    scene.alloy->solutes.push_back(
        {.name = "salt", .liquidus_slope = 1, .diffusivity = 1});
    scene.alloy->eutectic_temperature = 1e6;
    scene.initial.concentration = {Field::uniform(0.1)};
    return scene;
  }

  const EffectDecision &decision(const EffectSet &effects, Effect effect)
  {
    return effects.decisions().at(static_cast<std::size_t>(effect));
  }
} // namespace

TEST(Effects, EachHasItsOwnWordAndSentence)
{
  ASSERT_EQ(all_effects().size(), n_effects);
  std::set<std::string> words;
  for(const Effect effect : all_effects())
  {
    words.insert(to_string(effect));
    EXPECT_TRUE(std::string(description(effect)).ends_with('.'));
  }
  EXPECT_EQ(words.size(), n_effects);
}

TEST(Effects, ABareSceneCallsForNone)
{
  const EffectSet effects = effects_called_for(bare_scene());
  ASSERT_EQ(effects.decisions().size(), n_effects - 7); // less those of particle solids
  for(const EffectDecision &d : effects.decisions())
  {
    EXPECT_FALSE(d.on) << to_string(d.effect);
    EXPECT_FALSE(d.reason.empty());
  }
}

TEST(Effects, AFullSceneCallsForAllWithReasons)
{
  const EffectSet effects = effects_called_for(full_scene());
  for(const EffectDecision &d : effects.decisions())
    EXPECT_TRUE(d.on) << to_string(d.effect);
  EXPECT_EQ(decision(effects, Effect::heat_sources).reason,
            "there are 2 point or line sources");
  EXPECT_EQ(decision(effects, Effect::wall_temperature).reason,
            "a temperature is prescribed on x_min");
  EXPECT_EQ(decision(effects, Effect::wall_flux).reason,
            "a heat flux is prescribed on x_max");
  EXPECT_EQ(decision(effects, Effect::phase_conductivity).reason,
            "the solid conducts 1 W/(m K), the liquid 2 (at the melting temperature)");
  EXPECT_EQ(decision(effects, Effect::variable_heat_capacity).reason,
            "the heat capacity depends on temperature: that of the liquid is table");
  EXPECT_EQ(decision(effects, Effect::melting_range).reason,
            "the material is partly solid from 0 to 1 (linear)");
}

TEST(Effects, EachPropertyCallsForItsOwnEffectOnly)
{
  const auto called_for = [](const Scene &scene)
  {
    std::vector<Effect> on;
    const EffectSet effects = effects_called_for(scene);
    for(const EffectDecision &d : effects.decisions())
      if(d.on)
        on.push_back(d.effect);
    return on;
  };
  Scene scene = bare_scene();
  scene.material.liquid.conductivity = 2;
  EXPECT_EQ(called_for(scene), std::vector{Effect::phase_conductivity});
  scene = bare_scene();
  scene.material.liquid.specific_heat_capacity = 2;
  EXPECT_EQ(called_for(scene), std::vector{Effect::phase_heat_capacity});
  scene = bare_scene();
  scene.material.liquid.density = 2;
  EXPECT_EQ(called_for(scene), std::vector{Effect::liquid_motion});
  scene = bare_scene();
  scene.material.latent_heat = 1e-300;
  EXPECT_EQ(called_for(scene), std::vector{Effect::phase_change});
}

TEST(Effects, ASoluteOfWhichThereIsNoneIsNotSimulated)
{
  Scene scene = full_scene();
  scene.initial.concentration = {Field::uniform(0)};
  const EffectSet effects = effects_called_for(scene);
  for(const Effect effect : {Effect::solute, Effect::solute_diffusion, Effect::eutectic})
    EXPECT_FALSE(effects.contains(effect)) << to_string(effect);
  const Scene simulated = simulated_scene(scene, effects);
  EXPECT_FALSE(simulated.alloy);
  EXPECT_TRUE(simulated.initial.concentration.empty());
}

TEST(Effects, AChoiceOverridesTheRuleAndSaysSo)
{
  Scene scene = full_scene();
  scene.effect_choices[Effect::liquid_motion] = EffectChoice::off;
  scene.effect_choices[Effect::wall_flux] = EffectChoice::automatic;
  EffectSet effects = effects_called_for(scene);
  EXPECT_FALSE(effects.contains(Effect::liquid_motion));
  EXPECT_TRUE(effects.contains(Effect::wall_flux));
  EXPECT_TRUE(decision(effects, Effect::liquid_motion)
                  .reason.starts_with("the case file says off"));

  scene = bare_scene();
  scene.effect_choices[Effect::heat_sources] = EffectChoice::on;
  effects = effects_called_for(scene);
  EXPECT_TRUE(effects.contains(Effect::heat_sources));
  EXPECT_TRUE(decision(effects, Effect::heat_sources)
                  .reason.starts_with("the case file says on"));
}

TEST(SimulatedScene, IsTheSceneItselfWithAllEffectsOn)
{
  const Scene scene = full_scene();
  const Scene simulated = simulated_scene(scene, effects_called_for(scene));
  EXPECT_EQ(simulated.material.latent_heat, 3);
  EXPECT_EQ(simulated.material.liquid.conductivity, 2);
  EXPECT_EQ(simulated.material.liquid.specific_heat_capacity, 4);
  EXPECT_EQ(simulated.material.liquid.density, 5);
  EXPECT_EQ(simulated.sources.size(), 2u);
  EXPECT_EQ(simulated.boundary(Side::x_min).kind, BoundaryKind::fixed_temperature);
  EXPECT_EQ(simulated.boundary(Side::x_max).kind, BoundaryKind::flux);
}

TEST(SimulatedScene, LosesThePhysicsOfEachEffectThatIsOff)
{
  Scene scene = full_scene();
  for(const Effect effect : all_effects())
    scene.effect_choices[effect] = EffectChoice::off;
  const Scene simulated = simulated_scene(scene, effects_called_for(scene));
  EXPECT_EQ(simulated.material.latent_heat, 0);
  EXPECT_EQ(simulated.material.liquid.conductivity, scene.material.solid.conductivity);
  EXPECT_EQ(simulated.material.liquid.specific_heat_capacity,
            scene.material.solid.specific_heat_capacity);
  EXPECT_EQ(simulated.material.liquid.density, scene.material.solid.density);
  EXPECT_TRUE(simulated.sources.empty());
  for(const Side side : simulated.sides())
    EXPECT_EQ(simulated.boundary(side).kind, BoundaryKind::insulated);
}

TEST(SimulatedScene, OneEffectOffLeavesTheOthers)
{
  Scene scene = full_scene();
  scene.effect_choices[Effect::wall_temperature] = EffectChoice::off;
  const Scene simulated = simulated_scene(scene, effects_called_for(scene));
  EXPECT_EQ(simulated.boundary(Side::x_min).kind, BoundaryKind::insulated);
  EXPECT_EQ(simulated.boundary(Side::x_max).kind, BoundaryKind::flux);
  EXPECT_EQ(simulated.material.latent_heat, 3);
}

TEST(Effects, APhaseBeyondTheMeltingTemperatureIsMetastable)
{
  Scene scene = bare_scene();
  scene.material.melting_temperature = 1;
  const auto at = [&scene](double left, double right)
  {
    scene.initial.temperature
        = {"", [=](const Position &p, double) { return p[0] < 0.5 ? left : right; }};
    return decision(effects_called_for(scene), Effect::metastable_phase);
  };
  EXPECT_FALSE(at(2, 0).on) << "without a front of its own";
  scene.initial.front
      = Field{"x - 0.5", [](const Position &p, double) { return p[0] - 0.5; }};
  EXPECT_FALSE(at(0, 2).on);
  EXPECT_FALSE(at(1, 2).on) << "solid at the melting temperature";
  EXPECT_FALSE(at(1 + 1e-12, 2).on) << "the same to round-off";
  EXPECT_FALSE(at(0, 1).on);
  EXPECT_EQ(at(1, 0.5).reason, "liquid is undercooled at the start");
  EXPECT_EQ(at(1.5, 2).reason, "solid is superheated at the start");
  EXPECT_TRUE(at(1, 0.5).on);
}
