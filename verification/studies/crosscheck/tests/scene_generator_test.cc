#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/record/hash.h>
#include <verification/studies/crosscheck/random_stream.h>
#include <verification/studies/crosscheck/scene_generator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    TEST(RandomStream, IsSplitmixAndKnowsNothingOfItsNeighbours)
    {
      // The first numbers of the reference code for the state that seed and index make.
      RandomStream one(1, 0), again(1, 0), other(1, 1), seed(2, 0);
      const std::uint64_t first = one.next();
      EXPECT_EQ(first, again.next());
      EXPECT_NE(first, other.next());
      EXPECT_NE(first, seed.next());
      double sum = 0, logarithms = 0;
      constexpr int count = 20000;
      for(int i = 0; i < count; ++i)
      {
        const double u = one.uniform(2, 4), v = one.log_uniform(1e-2, 1e2);
        ASSERT_TRUE(u >= 2 && u < 4 && v >= 0.0099999 && v <= 100.0001);
        sum += u;
        logarithms += std::log10(v);
      }
      EXPECT_NEAR(sum / count, 3, 0.02);
      EXPECT_NEAR(logarithms / count, 0, 0.04);
    }

    TEST(SceneGenerator, MakesTheSameSceneOfTheSameNumbers)
    {
      EXPECT_EQ(random_scene(7, 3).text(), random_scene(7, 3).text());
      EXPECT_NE(random_scene(7, 3).text(), random_scene(7, 4).text());
      EXPECT_NE(random_scene(7, 3).text(), random_scene(8, 3).text());
    }

    TEST(SceneGenerator, EverySceneIsACase)
    {
      std::map<std::string, int> words;
      for(int index = 0; index < 600; ++index)
      {
        const std::string text = random_scene(11, index).text();
        try
        {
          const cases::Case c = cases::read_case_text(text, "scene.prm");
          ++words[cases::to_string(c.scene.domain.shape)];
          for(const cases::Side side : c.scene.sides())
            ++words[cases::to_string(c.scene.boundary(side).kind)];
          const cases::EffectSet effects = cases::effects_called_for(c.scene);
          for(const cases::EffectDecision &decision : effects.decisions())
            words[cases::to_string(decision.effect)] += decision.on;
        }
        catch(const cases::InputError &error)
        {
          ADD_FAILURE() << error.what() << "\n" << text;
        }
      }
      for(const char *word : {"slab",
                              "box",
                              "ball",
                              "shell",
                              "outline",
                              "insulated",
                              "fixed temperature",
                              "flux",
                              "periodic",
                              "heat transfer",
                              "phase_change",
                              "phase_conductivity",
                              "phase_heat_capacity",
                              "heat_sources",
                              "liquid_motion",
                              "metastable_phase",
                              "solute",
                              "solute_diffusion",
                              "eutectic",
                              "volumetric_source",
                              "inclusion",
                              "gibbs_thomson"})
        EXPECT_GT(words[word], 0) << word;
    }

    TEST(SceneGenerator, KeepsToADimension)
    {
      for(int index = 0; index < 40; ++index)
        for(const int dimension : {1, 2, 3})
        {
          const cases::Case c = cases::read_case_text(
              random_scene(5, index, dimension).text(), "scene.prm");
          EXPECT_EQ(c.scene.symmetry == cases::Symmetry::none ? c.scene.domain.dimension
                                                              : 1,
                    dimension);
        }
    }
  } // namespace
} // namespace meltfront::verification
