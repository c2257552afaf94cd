#include <cases/error.h>
#include <cases/scene.h>
#include <verification/external/manifest.h>
#include <verification/external/protocol.h>
#include <verification/external/tests/fixture.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace meltfront::verification::external
{
  namespace
  {
    using nlohmann::json;

    Manifest read(const json &manifest)
    {
      const tests::ExternalTrial trial(manifest);
      return read_manifest(trial.path());
    }

    std::string complaint(const json &manifest)
    {
      try
      {
        read(manifest);
      }
      catch(const cases::InputError &error)
      {
        return error.what();
      }
      return {};
    }

    TEST(Manifest, DeclaresWhatAMethodDeclares)
    {
      json written = tests::manifest_of("well");
      written["command"] = "python3 'my solver.py'";
      written["options"]
          = {{{"key", "steps"}, {"default", 5}, {"description", "A number."}},
             {{"key", "scheme"},
              {"default", "euler"},
              {"description", "A word."},
              {"choices", {"euler", "rkl2"}}}};
      written["overshoot"] = {{"at_twenty", 0.1}, {"order", 2}};
      written["conserves_heat"] = false;
      written["most_threads"] = 4;
      const Manifest manifest = read(written);
      EXPECT_EQ(manifest.name, "test");
      EXPECT_EQ(manifest.command, (std::vector<std::string>{"python3", "my solver.py"}));
      const cases::Capabilities &takes = manifest.capabilities;
      EXPECT_EQ(takes.problems, std::vector{cases::ProblemKind::stefan});
      EXPECT_TRUE(takes.takes(cases::Effect::phase_change));
      EXPECT_FALSE(takes.takes(cases::Effect::wall_flux));
      ASSERT_EQ(takes.shapes.size(), 1u);
      EXPECT_EQ(takes.shapes[0].shape, cases::DomainShape::slab);
      EXPECT_EQ(takes.shapes[0].walls[0], cases::BoundaryKind::fixed_temperature);
      EXPECT_TRUE(takes.takes(cases::FrontOrigin::wall));
      EXPECT_EQ(takes.overshoot.order, 2);
      EXPECT_FALSE(takes.conserves_heat);
      EXPECT_EQ(takes.most_threads, 4);
      cases::Options options(manifest.options);
      options.set("scheme", "rkl2");
      EXPECT_THROW(options.set("scheme", "magic"), cases::InputError);
      EXPECT_EQ(options.get_integer("steps"), 5);
    }

    TEST(Manifest, SaysWhereItIsWrong)
    {
      const json right = tests::manifest_of("well");
      EXPECT_EQ(complaint(right), "");
      const auto without = [&](const char *key)
      {
        json wrong = right;
        wrong.erase(key);
        return complaint(wrong);
      };
      const auto with = [&](const char *key, const json &value)
      {
        json wrong = right;
        wrong[key] = value;
        return complaint(wrong);
      };
      const auto expect = [](const std::string &message, const std::string &text)
      {
        EXPECT_NE(message.find(text), std::string::npos) << message;
        EXPECT_NE(message.find("manifest.json"), std::string::npos) << message;
      };
      expect(without("effects"), "effects");
      expect(without("protocol"), "protocol");
      expect(with("protocol", 2), "/protocol, 2");
      expect(with("effects", {"phase_chang"}), "/effects/0, \"phase_chang\"");
      expect(with("efects", 1), "efects");
      expect(with("most_threads", 0), "/most_threads, 0");
      expect(with("shapes", json::array()), "/shapes");
      expect(with("command", "'python3"), "quote");
      const tests::ExternalTrial broken(std::string("{\"name\": "));
      EXPECT_THROW(read_manifest(broken.path()), cases::InputError);
      EXPECT_THROW(read_manifest("/no/such/manifest.json"), cases::InputError);
      EXPECT_THROW(manifest_path("no-such-example"), cases::InputError);
    }

    /** The schema's words are ours; those of ours that it lacks have no words there. */
    TEST(Manifest, HasWordsThatWeKnow)
    {
      std::vector<std::string> effects;
      for(const cases::Effect effect : cases::all_effects())
      {
        json one = tests::manifest_of("well");
        one["effects"] = {cases::to_string(effect)};
        if(!complaint(one).empty())
          effects.push_back(cases::to_string(effect));
      }
      EXPECT_EQ(effects, (std::vector<std::string>{
                             "solute", "solute_diffusion", "eutectic", "gravity", "base",
                             "hot_base", "point_heating", "drag", "heat_bath", "light"}));
      for(std::size_t i = 0; i < cases::n_boundary_kinds; ++i)
      {
        json one = tests::manifest_of("well");
        const auto kind = static_cast<cases::BoundaryKind>(i);
        one["shapes"][0]["walls"] = {cases::to_string(kind)};
        EXPECT_EQ(read(one).capabilities.shapes[0].walls, std::vector{kind});
      }
      for(std::size_t i = 0; i < cases::n_front_origins; ++i)
      {
        json one = tests::manifest_of("well");
        const auto origin = static_cast<cases::FrontOrigin>(i);
        one["front_origins"] = {cases::to_string(origin)};
        EXPECT_TRUE(read(one).capabilities.takes(origin));
      }
    }
  } // namespace
} // namespace meltfront::verification::external
