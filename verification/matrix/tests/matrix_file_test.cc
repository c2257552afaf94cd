#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/matrix/matrix_file.h>

#include <gtest/gtest.h>

#include <algorithm>

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
        for(const std::string &case_name : case_names(matrix))
          EXPECT_NE(std::ranges::find(known, case_name), known.end()) << case_name;
      }
      EXPECT_TRUE(load_matrix("stability").hard_cases);
      EXPECT_THROW(load_matrix("paper"), cases::InputError);
      EXPECT_THROW(load_matrix("folder/nothing.prm"), cases::InputError);
      EXPECT_NE(matrix_file_reference().find("resolutions"), std::string::npos);
    }
  } // namespace
} // namespace meltfront::verification
