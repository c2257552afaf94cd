#include <cases/case_file/prm_file.h>
#include <cases/case_file/tests/sample_case.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  PrmFile sample_keys()
  {
    PrmFile prm;
    prm.declare("", {.key = "title",
                     .kind = PrmKind::text,
                     .default_value = {},
                     .unit = {},
                     .description = "The title."});
    prm.declare("Step", {.key = "factor",
                         .kind = PrmKind::number,
                         .default_value = "0.5",
                         .unit = {},
                         .description = "Share of the limit.",
                         .lower = 0,
                         .upper = 1});
    prm.declare("Step", {.key = "length",
                         .kind = PrmKind::number,
                         .default_value = {},
                         .unit = "s",
                         .description = "Length.",
                         .lower = above_zero});
    prm.declare("Step", {.key = "count",
                         .kind = PrmKind::integer,
                         .default_value = "3",
                         .unit = {},
                         .description = "Count.",
                         .lower = 1,
                         .upper = 9});
    prm.declare("Step/Scheme", {.key = "name",
                                .kind = PrmKind::word,
                                .default_value = "euler",
                                .unit = {},
                                .description = "The scheme.",
                                .choices = {"euler", "rkl2"}});
    prm.declare("Step/Scheme", {.key = "checked",
                                .kind = PrmKind::boolean,
                                .default_value = "true",
                                .unit = {},
                                .description = "Checked."});
    prm.declare("Step/Scheme", {.key = "weights",
                                .kind = PrmKind::numbers,
                                .default_value = {},
                                .unit = {},
                                .description = "Weights."});
    prm.declare_numbered("",
                         {.key = "line",
                          .kind = PrmKind::text,
                          .default_value = {},
                          .unit = {},
                          .description = "A line."},
                         3);
    return prm;
  }

  PrmFile parse(const std::string &text)
  {
    PrmFile prm = sample_keys();
    prm.read_text(text, "f.prm");
    return prm;
  }

  std::string refusal(const std::string &text)
  {
    try
    {
      parse(text);
    }
    catch(const InputError &error)
    {
      return error.what();
    }
    return "no complaint";
  }
} // namespace

TEST(PrmFile, GivesDefaultsAndValues)
{
  const PrmFile prm = parse("set title = A = B # comment\n"
                            "subsection Step\n  set length = 0.25\n"
                            "  subsection Scheme\n    set weights = 1, 2.5 , -3e-1\n"
                            "    set checked=false\n  end\nend\n"
                            "set line 3 = three\nset line 1 = one\n");
  EXPECT_EQ(prm.get_text("", "title"), "A = B");
  EXPECT_EQ(prm.get_number("Step", "factor"), 0.5);
  EXPECT_EQ(prm.get_number("Step", "length"), 0.25);
  EXPECT_EQ(prm.get_integer("Step", "count"), 3);
  EXPECT_EQ(prm.get_text("Step/Scheme", "name"), "euler");
  EXPECT_FALSE(prm.get_boolean("Step/Scheme", "checked"));
  EXPECT_EQ(prm.get_numbers("Step/Scheme", "weights"),
            (std::vector<double>{1, 2.5, -0.3}));
  EXPECT_EQ(prm.given_numbers("", "line"), (std::vector<int>{1, 3}));
  EXPECT_TRUE(prm.given("Step", "length"));
  EXPECT_FALSE(prm.given("Step", "factor"));
  EXPECT_TRUE(prm.opened("Step/Scheme"));
}

TEST(PrmFile, JoinsLinesThatGoOnAndTakesCrLfAndAByteOrderMark)
{
  EXPECT_EQ(parse("set title = one \\\n     two\\\n three\n").get_text("", "title"),
            "one two three");
  const PrmFile prm = parse("\xef\xbb\xbfset title = Eis \xc3\xbc"
                            "ber Wasser\r\n"
                            "subsection Step\r\n set count = 4\r\nend\r\n");
  EXPECT_EQ(prm.get_text("", "title"), "Eis \xc3\xbc"
                                       "ber Wasser");
  EXPECT_EQ(prm.get_integer("Step", "count"), 4);
  EXPECT_EQ(parse("set title = last line without end").get_text("", "title"),
            "last line without end");
}

TEST(PrmFile, NamesTheNearestKeyAndSubsection)
{
  EXPECT_EQ(refusal("\nset titel = x\n"),
            "f.prm:2: key 'titel' at the top level is unknown; the nearest valid key is "
            "'title'");
  EXPECT_EQ(refusal("subsection Step\nset fctor = 1\nend"),
            "f.prm:2: key 'fctor' in subsection 'Step' is unknown; the nearest valid key "
            "is 'factor'");
  EXPECT_EQ(refusal("set factor = 1\n"),
            "f.prm:1: key 'factor' at the top level is unknown; it belongs to subsection "
            "'Step'");
  EXPECT_EQ(refusal("subsection Stepp\nend\n"),
            "f.prm:1: subsection 'Stepp' is unknown at the top level; the nearest valid "
            "subsection is 'Step'");
  EXPECT_EQ(refusal("subsection Step\nsubsection Schema\nend\nend\n"),
            "f.prm:2: subsection 'Step/Schema' is unknown in subsection 'Step'; the "
            "nearest valid subsection is 'Step/Scheme'");
}

TEST(PrmFile, SaysWhatAValueMustBe)
{
  EXPECT_EQ(refusal("subsection Step\nset factor = fast\nend"),
            "f.prm:2: key 'factor' in subsection 'Step' needs a number from 0 to 1, not "
            "'fast'");
  EXPECT_EQ(refusal("subsection Step\nset factor = 1.01\nend"),
            "f.prm:2: key 'factor' in subsection 'Step' needs a number from 0 to 1, not "
            "'1.01'");
  EXPECT_EQ(refusal("subsection Step\nset length = 0\nend"),
            "f.prm:2: key 'length' in subsection 'Step' needs a number greater than 0 "
            "(s), not '0'");
  EXPECT_EQ(refusal("subsection Step\nset count = 2.5\nend"),
            "f.prm:2: key 'count' in subsection 'Step' needs an integer from 1 to 9, not "
            "'2.5'");
  EXPECT_EQ(refusal("subsection Step\nsubsection Scheme\nset name = rkl\nend\nend"),
            "f.prm:3: key 'name' in subsection 'Step/Scheme' needs one of euler, rkl2, "
            "not 'rkl'; the nearest is 'rkl2'");
  EXPECT_EQ(refusal("subsection Step\nsubsection Scheme\nset checked = yes\nend\nend"),
            "f.prm:3: key 'checked' in subsection 'Step/Scheme' needs true or false, not "
            "'yes'");
  for(const char *number : {"nan", "inf", "1e999", "1,5", "1 2", "", "0x"})
    EXPECT_NE(refusal(std::string("subsection Step\nset length = ") + number + "\nend"),
              "no complaint")
        << number;
  EXPECT_NE(
      refusal("subsection Step\nsubsection Scheme\nset weights = 1,2,3,4\nend\nend"),
      "no complaint");
}

TEST(PrmFile, LocatesBrokenSyntax)
{
  EXPECT_EQ(refusal("set title = a\nset line 1 = b\nset title = c\n"),
            "f.prm:3: key 'title' at the top level is set a second time, after line 1");
  EXPECT_EQ(refusal("subsection Step\nset count = 1\n"),
            "f.prm:1: subsection 'Step' has no 'end'");
  EXPECT_EQ(refusal("subsection Step\nend\nend\n"),
            "f.prm:3: 'end' closes no subsection");
  EXPECT_EQ(refusal("set title\n"), "f.prm:1: 'set title' has no '= VALUE'");
  EXPECT_EQ(refusal("set = 3\n"), "f.prm:1: 'set' has no key before '='");
  EXPECT_EQ(refusal("subsection\n"), "f.prm:1: 'subsection' has no name");
  EXPECT_EQ(refusal("title = 3\n"),
            "f.prm:1: 'title = 3' is not 'set KEY = VALUE', "
            "'subsection NAME', 'end', 'include FILE' or a comment");
  EXPECT_EQ(refusal(std::string("set title = a\0b\n", 16)).substr(0, 37),
            "f.prm:1: the line is not UTF-8 text (");
  EXPECT_EQ(refusal("# \xe4\nset title = a\n").substr(0, 36),
            "f.prm:1: the line is not UTF-8 text ");
}

TEST(PrmFile, MissingKeysAreNamedWhereTheyBelong)
{
  const PrmFile prm = parse("set title = a\nsubsection Step\nset count = 1\nend\n");
  try
  {
    prm.get_number("Step", "length");
    FAIL();
  }
  catch(const InputError &error)
  {
    EXPECT_STREQ(error.what(),
                 "f.prm:2: key 'length' in subsection 'Step' is missing: it "
                 "needs a number greater than 0 (s)");
  }
  EXPECT_THROW(prm.require("Step", "factor", "of a reason"), InputError);
  EXPECT_NO_THROW(prm.require("Step", "count", "of a reason"));
  EXPECT_THROW(prm.forbid("Step", "count", "of a reason"), InputError);
  EXPECT_NO_THROW(prm.forbid("Step", "factor", "of a reason"));
}

TEST(PrmFile, FilesThatCannotBeReadAreOutputErrors)
{
  PrmFile prm = sample_keys();
  EXPECT_THROW(prm.read("/nonexistent/a.prm"), OutputError);
  EXPECT_THROW(prm.read("/"), OutputError);
  EXPECT_THROW(prm.read("/dev/zero"), OutputError);
  EXPECT_THROW(prm.read(std::string(5000, 'a')), OutputError);
  EXPECT_THROW(prm.read(""), OutputError);
}

TEST(PrmFile, ReferenceNamesEveryKey)
{
  const std::string reference = sample_keys().reference();
  for(const char *key : {"set title", "set factor = 0.5", "set length", "set count = 3",
                         "set name = euler", "set weights", "set line 1 .. 3"})
    EXPECT_NE(reference.find(key), std::string::npos) << key;
}

TEST(PrmFile, LongMessagesStayOneReadableLine)
{
  const std::string message = refusal("set " + std::string(100000, 'x') + " = 1\n");
  EXPECT_LT(message.size(), 250u);
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_LT(refusal(std::string(100000, '=')).size(), 250u);
  EXPECT_LT(refusal("set \xc3\xbc\x01 = 1").size(), 250u);
}

namespace
{
  /** A text must either be read or refused with one line that names the file. */
  void survive(const std::string &text)
  {
    try
    {
      read(text);
    }
    catch(const InputError &error)
    {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with("a.prm:")) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_LT(message.size(), 1000u);
    }
  }
} // namespace

TEST(PrmFuzz, EveryTruncationIsReadOrRefused)
{
  for(std::size_t length = 0; length <= slab.size(); length += 2)
    survive(slab.substr(0, length));
}

TEST(PrmFuzz, RandomBytesAreRefused)
{
  std::mt19937 random(1);
  for(int i = 0; i < 100; ++i)
  {
    std::string text(random() % 2000, ' ');
    for(char &c : text)
      c = static_cast<char>(i % 2 == 0 ? random() % 256 : 32 + random() % 95);
    survive(text);
  }
}

TEST(PrmFuzz, DamagedFilesAreReadOrRefused)
{
  std::mt19937 random(2);
  const std::string alphabet = "0123456789.-+e =#\\\n\r\tsetendx()^*/,<>\x80\xff";
  for(int i = 0; i < 600; ++i)
  {
    std::string text = i % 2 == 0 ? slab : square;
    for(unsigned changes = 1 + random() % 4; changes > 0; --changes)
    {
      const std::size_t at = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      switch(random() % 3)
      {
      case 0:
        text[at] = c;
        break;
      case 1:
        text.insert(at, 1, c);
        break;
      default:
        text.erase(at, 1 + random() % 20);
      }
    }
    survive(text);
  }
}

TEST(PrmFuzz, HugeAndDeepFilesAreRefusedQuickly)
{
  survive("set title = " + std::string(3000000, 'x') + "\n");
  survive(std::string(3000000, '\n'));
  std::string deep, open;
  for(int i = 0; i < 50000; ++i)
    deep += "subsection Scene\n";
  survive(deep);
  for(int i = 0; i < 100000; ++i)
    open += "set title = a\\\n";
  survive(open);
}
