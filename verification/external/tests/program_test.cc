#include <cases/error.h>
#include <verification/external/program.h>
#include <verification/external/tests/processes.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace meltfront::verification::external
{
  namespace
  {
    struct Outcome
    {
      ProgramEnd end;
      std::string answer, messages;
    };

    std::string text_of(const UnnamedFile &file)
    {
      std::ifstream in(file.path());
      return {std::istreambuf_iterator<char>(in), {}};
    }

    Outcome run(const std::vector<std::string> &words, const std::string &request = "",
                bool named_answer = false, double most_bytes = 1e6)
    {
      UnnamedFile input, answer, messages;
      input.write(request);
      Outcome outcome;
      outcome.end = run_program(words, input, answer, messages, named_answer, most_bytes);
      outcome.answer = text_of(answer);
      outcome.messages = text_of(messages);
      return outcome;
    }

    Outcome shell(const std::string &script, const std::string &request = "",
                  bool named_answer = false)
    {
      return run({"sh", "-c", script}, request, named_answer);
    }

    TEST(Program, ReadsTheRequestAndWritesAnAnswerAndMessages)
    {
      const Outcome outcome = shell("cat; echo said >&2", "asked\n");
      EXPECT_EQ(outcome.end.problem(), "");
      EXPECT_EQ(outcome.answer, "asked\n");
      EXPECT_EQ(outcome.messages, "said\n");
      EXPECT_GT(outcome.end.wall, 0);
    }

    TEST(Program, FindsItsFilesByName)
    {
      const Outcome outcome = shell(std::string("echo noise; cat ") + request_file + " > "
                                        + answer_file + "; echo more >> " + answer_file,
                                    "asked\n", true);
      EXPECT_EQ(outcome.answer, "asked\nmore\n");
      EXPECT_EQ(outcome.messages, "noise\n");
    }

    TEST(Program, TellsHowItEnded)
    {
      EXPECT_EQ(shell("exit 7").end.problem(), "ended with status 7");
      EXPECT_EQ(shell("kill -SEGV $$").end.problem(), "crashed (Segmentation fault)");
      EXPECT_EQ(shell("kill -KILL $$").end.problem(),
                "was killed, perhaps because memory ran out");
      EXPECT_THROW(run({"no-such-program"}), cases::Refusal);
    }

    TEST(Program, IsNoShell)
    {
      EXPECT_EQ(run({"echo", "$HOME", "*", ";", "exit 3"}).answer, "$HOME * ; exit 3\n");
    }

    TEST(Program, CountsWhatItsChildrenTook)
    {
      const Outcome outcome
          = shell("sh -c 'i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done'; true");
      EXPECT_GT(outcome.end.cpu, 0.02);
      EXPECT_GT(outcome.end.wall, 0.5 * outcome.end.cpu);
    }

    TEST(Program, IsStoppedWhenItWritesTooMuch)
    {
      for(const char *where : {"", " >&2"})
      {
        const Outcome outcome
            = run({"sh", "-c", std::string("while :; do echo 0123456789; done") + where});
        EXPECT_TRUE(outcome.end.too_much) << where;
        EXPECT_LT(outcome.answer.size() + outcome.messages.size(), 1e9);
      }
    }

    TEST(Program, TakesItsGroupWithIt)
    {
      const Outcome outcome = shell("sleep 60 & echo $!");
      EXPECT_TRUE(
          tests::comes_true([&] { return !tests::runs(std::stoi(outcome.answer)); }));
      EXPECT_LT(outcome.end.wall, 30);
    }
  } // namespace
} // namespace meltfront::verification::external
