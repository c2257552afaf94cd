#include <verification/matrix/runner.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <set>

namespace meltfront::verification::tests
{
  namespace
  {
    Matrix matrix()
    {
      Matrix matrix;
      matrix.name = "varied";
      MatrixBlock block;
      block.cases = {"folder/slab.prm"};
      block.methods = {"fake"};
      block.resolutions = {10, 20};
      block.variations = {{"Scene/Material/latent heat", {"1", "10"}},
                          {"Scene/Material/Solid/density", {"0.5", "1", "a/b"}}};
      matrix.blocks = {block};
      return matrix;
    }

    const FakeMethod &method()
    {
      static const FakeMethod fake("fake");
      return fake;
    }

    const cases::Method &method_named(const std::string &)
    {
      return method();
    }

    RunnerOptions options_in(const ScratchDirectory &directory)
    {
      RunnerOptions options;
      options.directory = directory.path("results");
      options.repeats.most = 1;
      return options;
    }
  } // namespace

  TEST(Variations, EveryCombinationIsACase)
  {
    const std::vector<PlannedCase> planned = planned_cases(matrix());
    ASSERT_EQ(planned.size(), 6u);
    EXPECT_EQ(planned[0].name, "slab[density=0.5,latent_heat=1]");
    EXPECT_EQ(planned[1].name, "slab[density=1,latent_heat=1]");
    EXPECT_EQ(planned[2].name, "slab[density=a_b,latent_heat=1]");
    EXPECT_EQ(planned[5].name, "slab[density=a_b,latent_heat=10]");
    EXPECT_EQ(planned[5].base, "folder/slab.prm");
    ASSERT_EQ(planned[5].settings.size(), 2u);
    EXPECT_EQ(planned[5].settings[0].first, "Scene/Material/latent heat");
    EXPECT_EQ(planned[5].settings[0].second, "10");
    EXPECT_EQ(planned[5].settings[1].second, "a/b");
  }

  TEST(Variations, KeysOfOneNameAreToldApart)
  {
    Matrix two = matrix();
    two.blocks[0].variations = {{"Scene/Material/Solid/density", {"1"}},
                                {"Scene/Material/Liquid/density", {"2"}}};
    EXPECT_EQ(planned_cases(two).front().name,
              "slab[Scene.Material.Liquid.density=2,Scene.Material.Solid.density=1]");
  }

  TEST(Variations, StandBesideTheCaseAsWritten)
  {
    Matrix both = matrix();
    both.blocks.push_back(both.blocks[0]);
    both.blocks[1].variations.clear();
    both.blocks[1].resolutions = {40};
    both.blocks.push_back(both.blocks[0]);
    both.blocks[2].variations[1].values = {"1"};
    both.blocks[2].resolutions = {20, 40};
    EXPECT_EQ(planned_cases(both).size(), 7u);
    int plain = 0, of_density_1 = 0;
    for(const PlannedRun &run : plan_runs(both, method_named))
    {
      plain += run.case_name == "slab";
      of_density_1 += run.case_name == "slab[density=1,latent_heat=10]";
    }
    EXPECT_EQ(plain, 1);
    EXPECT_EQ(of_density_1, 3);
    EXPECT_EQ(plan_runs(both, method_named).size(), 6u * 2 + 1 + 2);
    both.blocks[0].variations[0].values.clear();
    EXPECT_THROW(planned_cases(both), cases::InputError);
  }

  TEST(Variations, AreRunAndRemembered)
  {
    const ScratchDirectory directory;
    Matrix neutral = matrix();
    neutral.blocks[0].variations
        = {{"Measure/samples", {"50", "60"}}, {"title", {"A", "B", "C"}}};
    int loaded = 0;
    const MatrixResult result = run_matrix(
        neutral, options_in(directory),
        [&loaded](const std::string &)
        {
          ++loaded;
          return slab_case("slab");
        },
        method_named);
    EXPECT_EQ(loaded, 1);
    ASSERT_EQ(result.cases.size(), 6u);
    EXPECT_EQ(result.cases[3].name(), "slab[samples=60,title=A]");
    EXPECT_EQ(result.cases[3].variation_of, "slab");
    ASSERT_EQ(result.cases[3].variation.size(), 2u);
    EXPECT_EQ(result.cases[3].variation[1].first, "title");
    EXPECT_EQ(result.cases[3].variation[1].second, "A");
    std::set<std::string> hashes;
    for(const RunRecord &run : result.runs)
    {
      EXPECT_EQ(run.status, RunStatus::finished) << run.message;
      hashes.insert(run.provenance.at("case_hash"));
    }
    EXPECT_EQ(result.runs.size(), 12u);
    EXPECT_EQ(hashes.size(), 6u); // each case has a text of its own
  }
} // namespace meltfront::verification::tests
