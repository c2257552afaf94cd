#include <cases/error.h>
#include <verification/matrix/matrix_file.h>
#include <verification/matrix/matrix_files.h>
#include <verification/matrix/runner.h>
#include <verification/matrix/tests/runner_fixture.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

namespace meltfront::verification
{
  namespace
  {
    const std::string blocks = R"(set title = Criteria
subsection Block 1
  set cases       = slab
  set methods     = good, other
  set resolutions = 20, 40, 80, 160
  set options     = other.error = 0.1 | 0.2
end
)";

    std::string with_criteria(const std::string &criteria,
                              const std::string &case_name = "slab")
    {
      return blocks + "subsection Acceptance\n  subsection " + case_name + "\n" + criteria
             + "  end\nend\n";
    }

    std::string complaint(const std::string &text)
    {
      try
      {
        read_matrix_text(text, "m.prm");
      }
      catch(const cases::InputError &error)
      {
        return error.what();
      }
      return "accepted";
    }

    TEST(MatrixCriteria, AreReadByCase)
    {
      const Matrix matrix = read_matrix_text(
          with_criteria("    set criterion 1 = good: front_rms at n=40 <= 1; "
                        "expected failure: much\n"
                        "    set criterion 2 = other[error=*]: worst front_rms <= 1\n"
                        "    set criterion 3 = any method: order of front_rms >= 0.9\n"
                        "    set criterion 4 = good: order of front_rms >= 0.9\n"
                        "    set criterion 5 = good: order of front_rms <= 1.1\n"),
          "m.prm");
      ASSERT_EQ(matrix.criteria.size(), 5u);
      EXPECT_EQ(matrix.criteria[0].case_name, "slab");
      EXPECT_EQ(matrix.criteria[0].criterion.expected_failure, "much");
      EXPECT_EQ(matrix.criteria[1].criterion.method, "other[error=*]");
      EXPECT_EQ(matrix.criteria[2].criterion.method, cases::any_method);
      EXPECT_TRUE(read_matrix_text(blocks, "m.prm").criteria.empty());
    }

    TEST(MatrixCriteria, NameTheirCaseIfThatIsVaried)
    {
      const std::string text
          = "set title = T\nsubsection Block 1\n  set cases = slab\n"
            "  set methods = good\n  set resolutions = 20\n"
            "  set variations = Scene/Material/latent heat = 7 | 70\nend\n"
            "subsection Acceptance\n  subsection slab[latent_heat=70]\n"
            "    set criterion 1 = good: front_rms at n=20 <= 1\n  end\nend\n";
      EXPECT_EQ(read_matrix_text(text, "m.prm").criteria.at(0).case_name,
                "slab[latent_heat=70]");
    }

    TEST(MatrixCriteria, NameAFamily)
    {
      const std::string text
          = "set title = T\nsubsection Block 1\n  set cases = slab, slab-2\n"
            "  set methods = good\n  set resolutions = 20\nend\n"
            "subsection Block 2\n  set cases = slab-2\n"
            "  set methods = other\n  set resolutions = 20\nend\n"
            "subsection Acceptance\n  subsection slab*\n    set criterion 1 = ";
      const auto of = [&](const std::string &criterion)
      { return complaint(text + criterion + "\n  end\nend\n"); };
      EXPECT_EQ(of("good: front_rms at n=20 <= 1"), "accepted");
      EXPECT_EQ(of("other: front_rms at n=20 <= 1"), "accepted");
      EXPECT_NE(of("other: front_rms at n=30 <= 1").find("n = 30"), std::string::npos);
      EXPECT_NE(of("any method: front_rms at n=20 <= 1").find("of a family, name one"),
                std::string::npos);
    }

    TEST(MatrixCriteria, SayWhereAMistakeStands)
    {
      const std::string here
          = "m.prm:10: key 'criterion 1' in subsection 'Acceptance/slab' ";
      const auto of = [](const std::string &criterion)
      { return complaint(with_criteria("    set criterion 1 = " + criterion + "\n")); };
      EXPECT_EQ(of("good: front_rms at n=40"),
                here
                    + "'good: front_rms at n=40' cannot be read: '<=', '>=', 'in' or "
                      "'within' is wanted at its end");
      EXPECT_EQ(of("other[error=0.3]: front_rms at n=40 <= 1"),
                here
                    + "is on 'other[error=0.3]', which no block of the matrix runs at "
                      "this case; the nearest is 'other[error=0.1]'");
      EXPECT_EQ(of("good: front_rms at n=30 <= 1"),
                here
                    + "asks for n = 30, at which no block runs 'good'; there are n = 20, "
                      "40, 80, 160");
      EXPECT_EQ(of("good: order of front_rms over n=20..80 >= 1"),
                here
                    + "asks for the order of 'good', which needs 4 resolutions; of n = "
                      "20, 40, 80, 160 it has 3");
      EXPECT_NE(of("good: front_rm at n=40 <= 1").find("'front_rms'"), std::string::npos);
      EXPECT_EQ(complaint(with_criteria("", "slob")),
                "m.prm:9: subsection 'Acceptance/slob' names no case that the matrix "
                "runs; the nearest is 'slab'");
      EXPECT_EQ(complaint(with_criteria("    set criterion 1 = good: worst h <= 1\n"
                                        "    set criterion 2 = good: worst h <= 2\n")),
                "m.prm:11: key 'criterion 2' in subsection 'Acceptance/slab' sets the "
                "bound of 'good: worst h <= 1' a second time");
      EXPECT_NE(
          complaint(with_criteria("    set criterio 1 = x\n")).find("'criterion 1'"),
          std::string::npos);
      EXPECT_EQ(complaint(blocks + "subsection Acceptance\nend\n"), "accepted");
    }

    /** A matrix whose criteria are held against the runs of a fake method. */
    class MatrixCriteriaRun : public ::testing::Test
    {
    protected:
      MatrixCriteriaRun()
      {
        options = tests::options_in(scratch.path("out"));
        matrix.name = matrix.title = "test";
        matrix.blocks = {{{"slab"}, {"good"}, {20, 40, 80, 160}, {}, {1}, {1}}};
      }

      void bound(const std::string &criterion, const std::string &cases = "slab")
      {
        Matrix read = read_matrix_text(
            "set title = T\nsubsection Block 1\n  set cases = slab\n"
            "  set methods = good\n  set resolutions = 20, 40, 80, 160\nend\n"
            "subsection Acceptance\n  subsection "
                + cases + "\n    set criterion 1 = " + criterion + "\n  end\nend\n",
            "m.prm");
        matrix.criteria = read.criteria;
      }

      MatrixResult run()
      {
        return run_matrix(
            matrix, options,
            [this](const std::string &name)
            {
              cases::Case c = tests::slab_case(name);
              c.criteria = of_case;
              return c;
            },
            [this](const std::string &) -> const cases::Method & { return method; });
      }

      std::size_t starts() const
      {
        return tests::lines_of(scratch.path("started")).size();
      }

      tests::ScratchDirectory scratch;
      RunnerOptions options;
      Matrix matrix;
      std::vector<cases::Criterion> of_case;
      tests::FakeMethod method{
          "good", [this](const auto &, const cases::Resolution &resolution) {
            tests::append_line(scratch.path("started"), fmt::format("{}", resolution.n));
          }};
    };

    TEST_F(MatrixCriteriaRun, AreJudgedFromWhatIsStored)
    {
      bound("good: front_rms at n=40 <= 0.003");
      for(const MatrixResult &result : {run(), load_matrix_result(options.directory)})
      {
        ASSERT_EQ(result.criteria.size(), 1u);
        EXPECT_EQ(result.criteria[0].case_name, "slab");
        EXPECT_EQ(result.criteria[0].quantity, "front_rms at n=40");
        EXPECT_NEAR(result.criteria[0].value, 0.0025, 1e-12);
        EXPECT_TRUE(result.criteria[0].passed);
        EXPECT_TRUE(result.passed);
        EXPECT_TRUE(result.omissions.empty());
      }
    }

    TEST_F(MatrixCriteriaRun, OfAFamilyAreStoredToo)
    {
      bound("good: front_rms at n=40 <= 0.002", "sl*");
      for(const MatrixResult &result : {run(), load_matrix_result(options.directory)})
      {
        ASSERT_EQ(result.criteria.size(), 1u);
        EXPECT_EQ(result.criteria[0].case_name, "slab");
        EXPECT_EQ(result.criteria[0].quantity, "front_rms at n=40, worst of sl*");
        EXPECT_FALSE(result.criteria[0].passed);
        EXPECT_FALSE(result.passed);
      }
    }

    TEST_F(MatrixCriteriaRun, ChangeWithoutAnyRunBeingMadeAgain)
    {
      bound("good: front_rms at n=40 <= 0.003");
      run();
      EXPECT_EQ(starts(), 4u);
      bound("good: front_rms at n=40 <= 0.002");
      const MatrixResult result = run();
      EXPECT_EQ(starts(), 4u);
      EXPECT_FALSE(result.criteria.at(0).passed);
      EXPECT_FALSE(load_matrix_result(options.directory).passed);
    }

    TEST_F(MatrixCriteriaRun, RefuseABoundThatTheCaseSetsToo)
    {
      bound("good: front_rms at n=40 <= 0.003");
      of_case = {matrix.criteria.front().criterion};
      of_case[0].text = "good: front_rms at n=40 <= 0.004";
      try
      {
        run();
        FAIL();
      }
      catch(const cases::InputError &error)
      {
        EXPECT_EQ(error.what(),
                  std::string("m.prm:9: key 'criterion 1' in subsection "
                              "'Acceptance/slab' sets a bound that the case sets itself, "
                              "'good: front_rms at n=40 <= 0.004'; it belongs to one of "
                              "them"));
      }
      EXPECT_EQ(starts(), 0u);
    }
  } // namespace
} // namespace meltfront::verification
