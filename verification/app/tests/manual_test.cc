#include <cases/case_file/case_file.h>
#include <cases/case_file/key_list.h>
#include <verification/app/methods.h>
#include <verification/app/tests/run_program.h>
#include <verification/matrix/matrix_file.h>
#include <verification/measure/measure.h>
#include <verification/report/tests/well_formed.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

using namespace meltfront;
using namespace meltfront::verification;
using namespace meltfront::verification::tests;

namespace
{
  std::string text_of_file(const fs::path &path)
  {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void replace_each(std::string &text, const std::string &what, const std::string &by)
  {
    for(std::size_t at = text.find(what); at != std::string::npos;
        at = text.find(what, at + by.size()))
      text.replace(at, what.size(), by);
  }

  /** The manual, written once for all tests. */
  const std::string &manual_page()
  {
    static const std::string page = []
    {
      const TemporaryDirectory directory;
      const fs::path file = directory.path("manual.html");
      const Outcome outcome = run_program("manual --out " + file.string());
      EXPECT_EQ(outcome.status, 0) << outcome.output;
      return text_of_file(file);
    }();
    return page;
  }

  struct Block
  {
    std::string language, text;
  };

  /** What stands in preformatted blocks, as plain text. */
  std::vector<Block> blocks_of(const std::string &page)
  {
    std::vector<Block> blocks;
    const std::regex pattern(
        "<pre>(?:<code(?: class=\"language-(\\w+)\")?>)?([^<]*)(?:</code>)?</pre>");
    for(std::sregex_iterator found(page.begin(), page.end(), pattern), end; found != end;
        ++found)
    {
      Block block{(*found)[1], (*found)[2]};
      for(const auto &[what, by] : {std::pair{"&lt;", "<"},
                                    {"&gt;", ">"},
                                    {"&quot;", "\""},
                                    {"&#39;", "'"},
                                    {"&amp;", "&"}})
        replace_each(block.text, what, by);
      blocks.push_back(block);
    }
    return blocks;
  }

  std::vector<std::string> lines_in(const std::string &text)
  {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for(std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }

  /** Words that stand for what a reader has to fill in: MATRIX, DIR. */
  bool has_placeholder(const std::string &command)
  {
    return std::regex_search(command, std::regex("(^|[ =\\[])[A-Z]{1,}($|[ .=/\\]])"))
           || command.find("...") != std::string::npos;
  }

  /** The arguments behind `./meltfront` in a line, without the remark behind them; empty
   * for another line. */
  std::string arguments_in(const std::string &line)
  {
    const std::string program = "./meltfront ";
    const std::size_t begin = line.find(program);
    if(begin == std::string::npos || line.find_first_not_of(' ') != begin)
      return {};
    const std::string arguments
        = line.substr(begin + program.size(), line.find("  #") - begin - program.size());
    return arguments.substr(0, arguments.find_last_not_of(' ') + 1);
  }

  /** The same command with less to do. */
  std::string lessened(std::string arguments)
  {
    arguments = std::regex_replace(arguments, std::regex("--within \\d+"), "--within 1");
    arguments = std::regex_replace(arguments, std::regex("--scenes \\d+"), "--scenes 1");
    arguments = std::regex_replace(arguments, std::regex("--n (\\d)\\d+"), "--n 16");
    if(arguments.starts_with("stability"))
      arguments = "verify" + arguments;
    if(arguments.starts_with("verify")
       && arguments.find("--list-runs") == std::string::npos
       && arguments.find("--only") == std::string::npos)
      arguments += " --list-runs";
    return std::regex_replace(arguments, std::regex("^verifystability"),
                              "verify stability");
  }

  Outcome run_in(const fs::path &folder, const std::string &arguments)
  {
    const fs::path before = fs::current_path();
    fs::current_path(folder);
    const Outcome outcome = run_program(arguments);
    fs::current_path(before);
    return outcome;
  }

  /** What a chapter tells the reader to do with his files. */
  void follow(const Block &block, const fs::path &folder)
  {
    const fs::path scene = folder / "pond.prm";
    if(block.language == "csv")
      std::ofstream(folder / "air.csv") << block.text;
    if(block.language != "prm" || !fs::exists(scene))
      return;
    std::string text = text_of_file(scene);
    if(block.text.starts_with("set temperature"))
      text = std::regex_replace(text, std::regex("set temperature = -10[^\\n]*"),
                                block.text.substr(0, block.text.find('\n')));
    else if(block.text.starts_with("subsection Output"))
      text += block.text;
    std::ofstream(scene) << text;
  }
} // namespace

TEST(Manual, NamesAllThatThereIsOnOnePage)
{
  const std::string &page = manual_page();
  std::set<std::string> names;
  for(const auto &method : methods())
  {
    names.insert(method->name());
    for(const auto &option : method->option_declarations())
      names.insert(method->name() + "." + option.key);
  }
  for(const cases::PrmKey &key : cases::case_file_keys())
    names.insert("<code>" + key.key);
  for(const std::string &name : cases::library_names())
    names.insert("<code>" + name);
  for(const std::string &name : matrix_names())
    names.insert("verify " + name);
  for(const cases::Effect effect : cases::all_effects())
    names.insert(std::string("<code>") + to_string(effect));
  for(const std::string &name : names)
    EXPECT_NE(page.find(name), std::string::npos) << name;
  EXPECT_EQ(fixture::first_mistake(page), "");
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
}

/** Names of figures that the tables show are explained in words and formulas. */
TEST(Manual, ExplainsEveryQuantityThatTablesShow)
{
  const std::string &page = manual_page();
  const std::size_t begin = page.find("id=\"measures\"");
  const std::string chapter = page.substr(begin, page.find("<details", begin) - begin);
  for(const Quantity &quantity : all_quantities())
  {
    std::string name
        = std::regex_replace(quantity.name, std::regex("_(error|bars)$"), "");
    name = std::regex_replace(name, std::regex("_[1-8]$"), "");
    const bool written = chapter.find("<code>" + name + "</code>") != std::string::npos
                         || chapter.find("<code>" + name + "_") != std::string::npos
                         || chapter.find("<code>" + quantity.name) != std::string::npos;
    EXPECT_TRUE(written || quantity.heading.empty()) << quantity.name;
  }
}

TEST(Manual, EveryKeyInItsCaseFilesExists)
{
  std::set<std::string> keys;
  for(const cases::PrmKey &key : cases::case_file_keys())
  {
    keys.insert(key.key);
    for(int i = 1; i <= key.count; ++i)
      keys.insert(key.key + " " + std::to_string(i));
  }
  int found = 0;
  for(const Block &block : blocks_of(manual_page()))
    if(block.language == "prm")
    {
      bool constants = false;
      for(const std::string &line : lines_in(block.text))
      {
        std::smatch match;
        constants = (constants || line.find("subsection Constants") != std::string::npos)
                    && line.find("end") != 0;
        if(constants || !std::regex_search(line, match, std::regex("set ([^=]+) =")))
          continue;
        ++found;
        EXPECT_TRUE(keys.contains(match[1])) << line;
      }
    }
  EXPECT_GE(found, 6);
}

/** In a scratch folder, in the manual's order, with small sizes. */
TEST(Manual, EveryCommandRuns)
{
  const TemporaryDirectory directory;
  const fs::path folder = directory.path();
  std::ofstream(folder / "two.prm")
      << "set title = two\nsubsection Block 1\n  set cases = plane-freezing\n  set "
         "methods "
         "= sph, fem-enthalpy\n  set resolutions = 10\nend\n";
  ASSERT_EQ(run_in(folder, "verify two.prm --out results/default").status, 0);
  std::set<std::string> done;
  for(const Block &block : blocks_of(manual_page()))
  {
    follow(block, folder);
    for(const std::string &line : lines_in(block.text))
    {
      const std::string arguments = arguments_in(line);
      // The script's own commands; a reader's own solver; minutes of particles.
      if(arguments.empty() || arguments.starts_with("test")
         || arguments.starts_with("bench") || arguments.starts_with("package")
         || arguments.starts_with("calibrate") || has_placeholder(arguments)
         || arguments.find("external.manifest") != std::string::npos
         || !done.insert(arguments).second)
        continue;
      const std::string less = lessened(arguments);
      if(!done.insert("less: " + less).second)
        continue;
      const Outcome outcome = run_in(folder, less);
      // Within a second methods may not come to agree.
      const bool may_disagree = less.starts_with("compare") || less.starts_with("advise");
      EXPECT_TRUE(outcome.status == 0 || (may_disagree && outcome.status == 1))
          << less << "\n"
          << outcome.status << " " << outcome.output;
    }
  }
  EXPECT_GE(done.size(), 30u);
  // By now the scene has all that the manual adds to it.
  const Outcome outcome
      = run_in(folder, "run pond.prm --method fem-enthalpy --n 20 --out results/pond");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_TRUE(fs::exists(folder / "results/pond/probes.csv"));
  EXPECT_TRUE(fs::exists(folder / "results/pond/line-1.csv"));
}

TEST(Manual, IsAPageForManAndWhatBashCompletes)
{
  const TemporaryDirectory directory;
  const Outcome man = run_program("manual --format man");
  EXPECT_EQ(man.status, 0);
  EXPECT_TRUE(man.output.starts_with(".TH MELTFRONT 1")) << man.output.substr(0, 80);
  for(const char *command : {".SS verify", ".SS run", ".SS manual", ".B \\-\\-within"})
    expect_text(man, command);
  const std::string file = directory.path("meltfront.bash").string();
  ASSERT_EQ(run_program("manual --format bash --out " + file).status, 0);
  const auto completed = [&](const std::string &words, int at)
  {
    const std::string script = directory.path("ask.sh").string();
    std::ofstream(script) << "source " << file << "\nCOMP_WORDS=(" << words
                          << ")\nCOMP_CWORD=" << at
                          << "\n_meltfront\necho \"${COMPREPLY[@]}\"\n";
    std::FILE *pipe = popen(("bash " + script + " 2>&1").c_str(), "r");
    char buffer[4096] = {};
    const std::size_t size = std::fread(buffer, 1, sizeof(buffer) - 1, pipe);
    pclose(pipe);
    return std::string(buffer, size);
  };
  EXPECT_EQ(completed("meltfront cro", 1), "crosscheck\n");
  EXPECT_EQ(completed("meltfront run pipe-fr", 2), "pipe-freezing\n");
  EXPECT_EQ(completed("meltfront run pipe-freezing --method fem-f", 4), "fem-fitted\n");
  EXPECT_EQ(completed("meltfront verify scen", 2), "scenes\n");
  EXPECT_EQ(completed("meltfront run --mem", 2), "--memory\n");
}

TEST(Manual, HelpOfEveryCommandHasAnExample)
{
  for(const char *command :
      {"verify", "stability", "run", "compare", "advise", "crosscheck", "ablate",
       "sensitivity", "calibrate", "list", "new", "manual", "report", "test"})
    expect_text(run_program(std::string(command) + " --help"),
                std::string("./meltfront ") + command);
}

/** Two methods that share no code say the same at the same places. */
TEST(Manual, ProbesAndLinesAreWrittenForAnyMethod)
{
  const TemporaryDirectory directory;
  const std::string file = directory.path("slab.prm").string();
  std::ofstream(file) << "include plane-freezing.prm\nsubsection Output\n  set probe 1 = "
                         "0.1\n  set probe 2 = 0.3\n  set line 1 = 0, 0.5\n  set line "
                         "points = 11\nend\n";
  std::vector<std::vector<double>> last;
  for(const std::string method : {"sph", "fem-enthalpy"})
  {
    const std::string out = directory.path(method).string();
    const Outcome outcome
        = run_program("run " + file + " --method " + method + " --n 80 --out " + out);
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    expect_text(outcome, "probes.csv, line-1.csv");
    const std::vector<std::string> rows = lines_in(text_of_file(out + "/probes.csv"));
    ASSERT_GT(rows.size(), 50u);
    EXPECT_EQ(rows[0],
              "time,temperature_1,solid_fraction_1,temperature_2,solid_fraction_2");
    std::vector<double> numbers;
    std::istringstream in(rows.back());
    for(std::string cell; std::getline(in, cell, ',');)
      numbers.push_back(std::stod(cell));
    ASSERT_EQ(numbers.size(), 5u);
    last.push_back(numbers);
    EXPECT_EQ(lines_in(text_of_file(out + "/line-1.csv")).size(), 12u);
  }
  for(std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(last[0][i], last[1][i], i % 2 == 1 ? 2e-3 : 1e-9) << i;
}
