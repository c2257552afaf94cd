#include <cases/error.h>
#include <verification/external/command.h>
#include <verification/external/program.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meltfront::verification::external
{
  namespace
  {
    using Words = std::vector<std::string>;

    TEST(Command, IsDividedAtBlanksAndNothingElse)
    {
      EXPECT_EQ(words_of("python3 solver.py  -n\t4"),
                (Words{"python3", "solver.py", "-n", "4"}));
      EXPECT_EQ(words_of("'my solver' --title \"two words\" a'b c'd \"\""),
                (Words{"my solver", "--title", "two words", "ab cd", ""}));
      EXPECT_EQ(words_of("a $HOME; rm -rf * | b > c && `d` \\ #e"),
                (Words{"a", "$HOME;", "rm", "-rf", "*", "|", "b", ">", "c", "&&", "`d`",
                       "\\", "#e"}));
      EXPECT_EQ(words_of("say \"it's\""), (Words{"say", "it's"}));
      for(const char *wrong : {"", "  ", "'a", "a \"b", "'' a"})
        EXPECT_THROW(words_of(wrong), cases::InputError) << wrong;
    }

    TEST(Command, TakesValuesFromTheRequest)
    {
      const nlohmann::json request{
          {"n", 40},
          {"times", {0.5, 1}},
          {"scene", {{"name", "bar"}, {"end", {{"value", 0.25}}}}}};
      EXPECT_EQ(filled_in({"-n{/n}", "{/scene/name}-{/scene/end/value}"}, request),
                (Words{"-n40", "bar-0.25"}));
      EXPECT_EQ(filled_in({"{/times}", "{/scene/front?none}", "{/n?none}"}, request),
                (Words{"0.5,1", "none", "40"}));
      EXPECT_EQ(filled_in({"{request}", "{answer}", "{x}", "{}"}, request),
                (Words{request_file, answer_file, "{x}", "{}"}));
      EXPECT_EQ(with_folder({"a", "{folder}/b{folder}"}, "/c d"),
                (Words{"a", "/c d/b/c d"}));
      EXPECT_TRUE(names_answer({"a", "--to={answer}"}));
      EXPECT_FALSE(names_answer({"a", "{request}"}));
      for(const char *wrong : {"{/m}", "{/scene}", "{/scene/end/value/2}"})
        EXPECT_THROW(filled_in({wrong}, request), cases::InputError) << wrong;
    }

    TEST(Command, FindsItsProgram)
    {
      EXPECT_TRUE(find_program("sh").ends_with("/sh"));
      EXPECT_EQ(find_program("/bin/sh"), "/bin/sh");
      for(const char *wrong : {"no-such-program", "/no/such/program", "/etc/passwd", "/"})
        EXPECT_THROW(find_program(wrong), cases::Refusal) << wrong;
    }
  } // namespace
} // namespace meltfront::verification::external
