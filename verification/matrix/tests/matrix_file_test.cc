#include <cases/case_file/case_file.h>
#include <cases/case_file/vary_case.h>
#include <cases/error.h>
#include <verification/matrix/matrix_file.h>
#include <verification/record/label.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    const std::string good
        = "set title = Two blocks\n"
          "set hard cases = true\n"
          "set time limit = 30\n"
          "subsection Block 1\n"
          "  set cases = plane-freezing, line-sink\n"
          "  set methods = sph, sph-2005\n"
          "  set resolutions = 20, 40\n"
          "  set options = sph.step_factor = 0.9 | 1.1; sph.jitter = 0.2\n"
          "end\n"
          "subsection Block 2\n"
          "  set cases = line-sink\n"
          "  set methods = sph\n"
          "  set resolutions = 80\n"
          "  set seeds = 1, 2, 3\n"
          "  set threads = 2\n"
          "end\n";

    TEST(MatrixFile, ReadsBlocks)
    {
      const Matrix matrix = read_matrix_text(good, "folder/two.prm");
      EXPECT_EQ(matrix.name, "two");
      EXPECT_EQ(matrix.title, "Two blocks");
      EXPECT_TRUE(matrix.hard_cases);
      EXPECT_EQ(matrix.time_limit, 30);
      ASSERT_EQ(matrix.blocks.size(), 2u);
      const MatrixBlock &first = matrix.blocks[0], &second = matrix.blocks[1];
      EXPECT_EQ(first.cases, (std::vector<std::string>{"plane-freezing", "line-sink"}));
      EXPECT_EQ(first.methods, (std::vector<std::string>{"sph", "sph-2005"}));
      EXPECT_EQ(first.resolutions, (std::vector<int>{20, 40}));
      EXPECT_EQ(first.seeds, (std::vector<std::uint64_t>{1}));
      ASSERT_EQ(first.options.size(), 2u);
      EXPECT_EQ(first.options[0].method, "sph");
      EXPECT_EQ(first.options[0].key, "step_factor");
      EXPECT_EQ(first.options[0].values, (std::vector<std::string>{"0.9", "1.1"}));
      EXPECT_EQ(first.options[1].key, "jitter");
      EXPECT_EQ(second.seeds, (std::vector<std::uint64_t>{1, 2, 3}));
      EXPECT_EQ(second.threads, (std::vector<int>{2}));
    }

    std::string message_of(std::string text, const std::string &from,
                           const std::string &to)
    {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
      try
      {
        read_matrix_text(text, "two.prm");
      }
      catch(const cases::InputError &error)
      {
        return error.what();
      }
      return "accepted";
    }

    TEST(MatrixFile, SaysWhereAMistakeStands)
    {
      const auto expect = [](const std::string &message, const std::string &part)
      { EXPECT_NE(message.find(part), std::string::npos) << message; };
      expect(message_of(good, "resolutions = 20, 40", "resolutions = 20, many"),
             "two.prm:7:");
      expect(message_of(good, "resolutions = 20, 40", "resolutions = 20, 0"), "'0'");
      expect(message_of(good, "20, 40", "20, 99999999999999"), "99999999999999");
      expect(message_of(good, "sph.step_factor = 0.9 | 1.1", "step_factor 0.9"),
             "two.prm:8:");
      expect(message_of(good, "0.9 | 1.1", "0.9 | "), "no value");
      expect(message_of(good, "set methods = sph, sph-2005", "set method = sph"),
             "methods");
      expect(message_of(good, "  set methods = sph, sph-2005\n", ""), "methods");
      expect(message_of(good, "set title = Two blocks\n", ""), "title");
      expect(message_of(good, "time limit = 30", "time limit = -1"), "two.prm:3:");
      expect(message_of(good, "Block 2", "Block two"), "Block two");
      EXPECT_THROW(read_matrix_text("set title = Nothing\n", "x.prm"), cases::InputError);
    }

    const std::string study
        = "set title = A study\n"
          "subsection Block 1\n"
          "  set cases = bar\n"
          "  set methods = sph\n"
          "  set resolutions = 20, 40\n"
          "  set variations = Scene/Material/latent heat = 7 | 70; Scene/end front = 1\n"
          "end\n"
          "subsection Finding 1\n"
          "  set claim = The order is {1}, and {2}.\n"
          "  set evidence 1 = bar[latent_heat=*]: sph: order of front_rms >= 1.5\n"
          "  set evidence 2 = bar: sph[jitter=0.2]: front_rms at n=20 <= 1\n"
          "end\n"
          "subsection Picture 1\n"
          "  set caption = Errors.\n"
          "  set cases = bar\n"
          "  set runs = sph; sph[jitter=*]\n"
          "  set against = cpu_seconds\n"
          "end\n";

    TEST(MatrixFile, ReadsVariationsFindingsAndPictures)
    {
      const Matrix matrix = read_matrix_text(study, "study.prm");
      const std::vector<CaseAxis> &axes = matrix.blocks.at(0).variations;
      ASSERT_EQ(axes.size(), 2u);
      EXPECT_EQ(axes[0].key, "Scene/Material/latent heat");
      EXPECT_EQ(axes[0].values, (std::vector<std::string>{"7", "70"}));
      EXPECT_EQ(axes[1].values, (std::vector<std::string>{"1"}));
      ASSERT_EQ(matrix.findings.size(), 1u);
      const Finding &finding = matrix.findings[0];
      EXPECT_EQ(finding.claim, "The order is {1}, and {2}.");
      ASSERT_EQ(finding.evidence.size(), 2u);
      EXPECT_EQ(finding.evidence[0].cases, "bar[latent_heat=*]");
      EXPECT_EQ(finding.evidence[0].criterion.statistic, cases::Statistic::order);
      EXPECT_EQ(finding.evidence[0].criterion.lower, 1.5);
      EXPECT_EQ(finding.evidence[1].criterion.method, "sph[jitter=0.2]");
      ASSERT_EQ(matrix.pictures.size(), 1u);
      EXPECT_EQ(matrix.pictures[0].runs,
                (std::vector<std::string>{"sph", "sph[jitter=*]"}));
      EXPECT_EQ(matrix.pictures[0].quantity, "front_rms");
      EXPECT_EQ(matrix.pictures[0].against, "cpu_seconds");
    }

    TEST(MatrixFile, SaysWhatIsWrongWithAStudy)
    {
      const auto expect
          = [](const std::string &from, const std::string &to, const std::string &part)
      {
        const std::string message = message_of(study, from, to);
        EXPECT_NE(message.find(part), std::string::npos) << message;
      };
      expect("latent heat = 7 | 70", "latent heat", "two.prm:6:");
      expect("7 | 70", "7 | ", "no value");
      expect("Scene/end front = 1", "Scene/Material/latent heat = 1", "second time");
      expect("and {2}", "and {3}", "two.prm:9:");
      expect("bar: sph[jitter=0.2]: front_rms at n=20", "front_rms", "CASE: METHOD");
      expect("order of front_rms >= 1.5", "order of front_rms", "two.prm:10:");
      expect("evidence 2", "evidence 3", "without 'evidence 2'");
      expect("  set claim = The order is {1}, and {2}.\n", "", "claim");
      expect("  set caption = Errors.\n", "", "caption");
      expect("subsection Finding 1", "subsection Found 1", "Found 1");
    }

    TEST(MatrixLibrary, HoldsMatricesOfCasesThatThereAre)
    {
      const std::vector<std::string> names = matrix_names();
      for(const char *name : {"default", "stability", "paper-sph"})
        EXPECT_NE(std::ranges::find(names, name), names.end()) << name;
      const std::vector<std::string> known = cases::library_names();
      for(const std::string &name : names)
      {
        const Matrix matrix = load_matrix(name);
        EXPECT_EQ(matrix.name, name);
        for(const PlannedCase &planned : planned_cases(matrix))
          if(!planned.settings.empty())
          {
            EXPECT_NO_THROW(cases::vary_case(cases::load_case(planned.base), planned.name,
                                             planned.settings));
          }
        for(const std::string &case_name : case_names(matrix))
          EXPECT_NE(std::ranges::find(known, case_name), known.end()) << case_name;
      }
      EXPECT_TRUE(load_matrix("stability").hard_cases);
      EXPECT_THROW(load_matrix("paper"), cases::InputError);
      EXPECT_THROW(load_matrix("folder/nothing.prm"), cases::InputError);
      EXPECT_NE(matrix_file_reference().find("resolutions"), std::string::npos);
    }

    TEST(MatrixLibrary, BoundsEveryCaseThatIsNotOnlyHard)
    {
      std::set<std::string> bounded;
      for(const std::string &name : matrix_names())
        for(const MatrixCriterion &one : load_matrix(name).criteria)
          bounded.insert(one.case_name);
      for(const std::string &name : cases::library_names())
      {
        const cases::Case c = cases::load_case(name);
        const bool of_family
            = std::ranges::any_of(bounded, [&name](const std::string &family)
                                  { return in_family(family, name); });
        EXPECT_TRUE(of_family || bounded.contains(name) || !c.criteria.empty()
                    || std::ranges::find(c.tags, "hard") != c.tags.end())
            << name;
      }
    }

    TEST(MatrixLibrary, RestatesTheTableOfThePaperInFull)
    {
      const cases::Case c = cases::load_case("line-sink");
      const Matrix paper = load_matrix("paper-sph");
      ASSERT_EQ(c.printed.size(), 8u);
      for(const cases::PrintedValue &printed : c.printed)
      {
        const auto bound
            = std::ranges::find_if(paper.criteria,
                                   [&printed](const MatrixCriterion &one)
                                   {
                                     return one.case_name == "line-sink"
                                            && one.criterion.method == printed.method
                                            && one.criterion.quantity == printed.quantity
                                            && one.criterion.n == printed.n;
                                   });
        ASSERT_NE(bound, paper.criteria.end()) << printed.quantity << printed.n;
        EXPECT_NEAR(bound->criterion.lower, 0.85 * printed.value, 1e-15);
        EXPECT_NEAR(bound->criterion.upper, 1.15 * printed.value, 1e-15);
      }
    }
  } // namespace
} // namespace meltfront::verification
