#include <cases/case_file/case_file.h>
#include <verification/record/hash.h>
#include <verification/record/json_values.h>
#include <verification/record/stored_case.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    const std::string wanted = R"(
subsection Acceptance
  set criterion 1 = sph: order of front_rms over n=20..50 >= 1.25; expected failure: 1.2
end
subsection Printed
  set source = A paper
  set value 1 = sph: front_rms at n=20 = 0.01063 (Table 1)
  set front figure = Fig. 1
end
)";

    StoredCase read_again(const StoredCase &record)
    {
      return nlohmann::json::parse(nlohmann::json(record).dump()).get<StoredCase>();
    }

    TEST(StoredCase, ComesBackFromItsText)
    {
      const std::string text = tests::slab_text("A slab") + wanted;
      const cases::Case c = cases::read_case_text(text, "folder/slab.prm");
      const StoredCase read = read_again(stored_case(c));
      EXPECT_EQ(read.name(), "slab");
      EXPECT_EQ(read.text, text);
      EXPECT_EQ(read.hash, sha256(text));
      EXPECT_EQ(read.title, "A slab");
      EXPECT_EQ(read.scene.symmetry, cases::Symmetry::planar);
      EXPECT_EQ(read.scene.boundary(cases::Side::x_min).value({}, 0), -1);
      EXPECT_EQ(read.criteria.at(0).statistic, cases::Statistic::order);
      EXPECT_EQ(read.criteria.at(0).n_to, 50);
      EXPECT_EQ(read.printed.at(0).value, 0.01063);
      EXPECT_EQ(read.printed_figures.size(), 1u);
      EXPECT_EQ(read.variation_of, "");
    }

    TEST(StoredCase, OfAVariationIsWithoutVerdicts)
    {
      const cases::Case base
          = cases::read_case_text(tests::slab_text("A slab") + wanted, "slab.prm");
      const cases::CaseSettings settings{{"Scene/Material/latent heat", "0.5"}};
      const StoredCase read = read_again(stored_case(
          cases::vary_case(base, "slab[latent_heat=0.5]", settings), "slab", settings));
      EXPECT_EQ(read.name(), "slab[latent_heat=0.5]");
      EXPECT_EQ(read.scene.material.latent_heat, 0.5);
      EXPECT_EQ(read.variation_of, "slab");
      EXPECT_EQ(read.variation, settings);
      EXPECT_TRUE(read.criteria.empty());
      EXPECT_TRUE(read.printed.empty());
      EXPECT_TRUE(read.printed_figures.empty());
    }
  } // namespace
} // namespace meltfront::verification
