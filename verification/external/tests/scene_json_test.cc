#include <cases/case_file/case_file.h>
#include <cases/effects.h>
#include <cases/error.h>
#include <verification/external/protocol.h>
#include <verification/external/sample_places.h>
#include <verification/external/scene_json.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace meltfront::verification::external
{
  namespace
  {
    using nlohmann::json;

    json request_of(const cases::Case &c, int n, const Sampling &sampling)
    {
      const cases::EffectSet effects = cases::effects_called_for(c.scene);
      return request_json(cases::simulated_scene(c.scene, effects), effects, {n, {}}, {},
                          {c.scene.start_time, c.scene.end_time}, sampling);
    }

    json scene_of(const std::string &name, int n, const Sampling &sampling = {})
    {
      return request_of(cases::load_case(name), n, sampling).at("scene");
    }

    double value_in(const json &quantity, const char *unit)
    {
      EXPECT_EQ(quantity.at("unit"), unit);
      return quantity.at("value");
    }

    /** Every case whose heat the protocol has words for. */
    TEST(SceneJson, IsAsTheSchemaSaysForTheWholeLibrary)
    {
      int written = 0, refused = 0;
      for(const std::string &name : cases::library_names())
      {
        const cases::Case c = cases::load_case(name);
        try
        {
          // As it is read: what is not finite has become null.
          const json request = json::parse(request_of(c, 4, {true, false, 3}).dump());
          EXPECT_EQ(breach_of_protocol(request, "request"), "") << name;
          ++written;
        }
        catch(const cases::Refusal &)
        {
          EXPECT_TRUE(!c.scene.conducts_heat() || c.scene.alloy || c.scene.particle_solid
                      || (c.scene.domain.round() && c.scene.domain.dimension == 3))
              << name;
          ++refused;
        }
      }
      EXPECT_GT(written, 60);
      EXPECT_GT(refused, 10);
    }

    TEST(SceneJson, HoldsEveryNumberWithItsUnit)
    {
      const cases::Case c = cases::load_case("plane-one-phase");
      const json scene = scene_of("plane-one-phase", 10);
      EXPECT_EQ(scene.at("name"), "plane-one-phase");
      EXPECT_EQ(scene.at("units"), "SI");
      EXPECT_EQ(value_in(scene.at("end_time"), "s"), 86400);
      EXPECT_EQ(scene.at("domain").at("shape"), "slab");
      EXPECT_EQ(value_in(scene.at("domain").at("side"), "m"), 1);
      const json &material = scene.at("material");
      EXPECT_EQ(value_in(material.at("latent_heat"), "J/kg"),
                c.scene.material.latent_heat);
      EXPECT_EQ(value_in(material.at("solid").at("conductivity"), "W/(m K)"),
                c.scene.material.solid.conductivity);
      const json &cold = scene.at("walls").at("x_min");
      EXPECT_EQ(cold.at("kind"), "fixed temperature");
      EXPECT_TRUE(cold.at("temperature").at("constant"));
      EXPECT_EQ(cold.at("temperature").at("value"), -10);
    }

    TEST(SceneJson, HoldsExactWallsAsTablesInTime)
    {
      const cases::Case c = cases::load_case("plane-freezing");
      const json scene = scene_of("plane-freezing", 10, {false, false, 101});
      const json &wall = scene.at("walls").at("x_max").at("temperature");
      EXPECT_EQ(wall.at("unit"), "K");
      EXPECT_EQ(wall.at("expression"), "exact");
      const json &samples = wall.at("samples");
      ASSERT_EQ(samples.at("times").size(), 101u);
      EXPECT_EQ(samples.at("times").back(), c.scene.end_time);
      EXPECT_EQ(samples.at("positions"), json::parse("[[1.0]]"));
      for(const int i : {0, 50, 100})
        EXPECT_EQ(samples.at("values").at(i).at(0),
                  c.exact->temperature(1, samples.at("times").at(i)));
    }

    TEST(SceneJson, SamplesExpressionsWhenAsked)
    {
      const json plain = scene_of("bar-flux", 4);
      const json &untold = plain.at("initial").at("temperature");
      EXPECT_EQ(untold.at("expression"), "0.6 - (1 - x)^2/2");
      EXPECT_FALSE(untold.contains("samples"));
      const json cells = scene_of("bar-flux", 4, {true, false, 5});
      const json samples = cells.at("initial").at("temperature").at("samples");
      EXPECT_EQ(samples.at("positions"), json::parse("[[0.125,0.375,0.625,0.875]]"));
      ASSERT_EQ(samples.at("values").size(), 1u);
      EXPECT_NEAR(samples.at("values").at(0).at(1).get<double>(),
                  0.6 - 0.5 * 0.625 * 0.625, 1e-15);
      const json ends = scene_of("bar-flux", 4, {true, true, 5});
      EXPECT_EQ(ends.at("initial").at("temperature").at("samples").at("positions"),
                json::parse("[[0.0,0.25,0.5,0.75,1.0]]"));
    }

    TEST(SceneJson, RefusesTablesThatAreTooLarge)
    {
      EXPECT_THROW(scene_of("heat-decay-square", 3000, {true, false, 5}), cases::Refusal);
      EXPECT_THROW(scene_of("alloy-unit", 10), cases::Refusal);
    }

    TEST(SamplePlaces, LieInTheDomainAndOnItsWalls)
    {
      const cases::Scene square = cases::load_case("corner-freezing").scene;
      const auto inside = places_in(square, 2, false);
      ASSERT_EQ(inside.size(), 4u);
      EXPECT_EQ(inside[1], (cases::Position{0.75, 0.25, 0}));
      const auto on = places_on(square, cases::Side::y_max, 2, false);
      ASSERT_EQ(on.size(), 2u);
      EXPECT_EQ(on[1], (cases::Position{0.75, 1, 0}));
      const cases::Scene annulus = cases::load_case("line-sink-annulus").scene;
      for(const cases::Position &place : places_in(annulus, 20, false))
      {
        EXPECT_EQ(place[1], 0);
        EXPECT_GT(place[0], annulus.domain.inner_radius);
      }
      EXPECT_EQ(places_on(annulus, cases::Side::inner, 20, false).front()[0],
                annulus.domain.inner_radius);
      const cases::Scene disks = cases::load_case("cavity-two-sinks").scene;
      for(const cases::Position &place : places_in(disks, 12, false))
        EXPECT_TRUE(disks.domain.outline->inside(place));
    }
  } // namespace
} // namespace meltfront::verification::external
