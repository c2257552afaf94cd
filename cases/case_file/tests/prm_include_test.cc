#include <cases/case_file/case_file.h>
#include <cases/case_file/prm_file.h>
#include <cases/case_file/tests/sample_case.h>
#include <cases/case_file/vary_case.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace meltfront::cases;

namespace
{
  namespace fs = std::filesystem;

  /** A folder with a library in it. */
  class Include : public ::testing::Test
  {
  protected:
    Include()
      : folder(fs::temp_directory_path()
               / ("meltfront-include-" + std::to_string(getpid())))
    {
      fs::create_directories(folder / "library/materials");
      write("library/materials/wax.prm", "# Wax\n"
                                         "set latent heat = 7\n"
                                         "subsection Solid\n"
                                         "  set conductivity = 2\n"
                                         "end\n");
    }

    ~Include() override
    {
      fs::remove_all(folder);
    }

    std::string write(const std::string &name, const std::string &text) const
    {
      std::ofstream(folder / name) << text;
      return (folder / name).string();
    }

    PrmFile keys() const
    {
      PrmFile prm((folder / "library").string());
      for(const char *key : {"latent heat", "melting temperature"})
        prm.declare("Material", {.key = key,
                                 .kind = PrmKind::number,
                                 .default_value = {},
                                 .unit = {},
                                 .description = "A datum."});
      prm.declare("Material/Solid", {.key = "conductivity",
                                     .kind = PrmKind::number,
                                     .default_value = {},
                                     .unit = {},
                                     .description = "A datum."});
      return prm;
    }

    PrmFile read(const std::string &text) const
    {
      PrmFile prm = keys();
      prm.read(write("main.prm", text));
      return prm;
    }

    /** The complaint about a file, without the folder's name. */
    std::string complaint(const std::string &text) const
    {
      try
      {
        read(text);
      }
      catch(const InputError &error)
      {
        std::string message = error.what();
        const std::string name = folder.string() + "/";
        for(std::size_t at = message.find(name); at != std::string::npos;
            at = message.find(name))
          message.erase(at, name.size());
        return message;
      }
      return "accepted";
    }

    fs::path folder;
  };

  const std::string wax = "subsection Material\n"
                          "  include materials/wax.prm\n"
                          "  set melting temperature = 3\n"
                          "end\n";
} // namespace

TEST_F(Include, PutsAFileOfTheLibraryInThePlaceOfTheLine)
{
  const PrmFile prm = read(wax);
  EXPECT_EQ(prm.get_number("Material", "latent heat"), 7);
  EXPECT_EQ(prm.get_number("Material/Solid", "conductivity"), 2);
  EXPECT_EQ(prm.get_number("Material", "melting temperature"), 3);
  EXPECT_EQ(prm.text(), "subsection Material\n"
                        "# include materials/wax.prm\n"
                        "# Wax\n"
                        "set latent heat = 7\n"
                        "subsection Solid\n"
                        "  set conductivity = 2\n"
                        "end\n"
                        "# end of materials/wax.prm\n"
                        "  set melting temperature = 3\n"
                        "end\n");
}

TEST_F(Include, LeavesATextThatStandsByItself)
{
  const std::string text = read(wax).text();
  PrmFile again;
  for(const char *key : {"latent heat", "melting temperature"})
    again.declare("Material", {key, PrmKind::number, {}, {}, {}});
  again.declare("Material/Solid", {"conductivity", PrmKind::number, {}, {}, {}});
  again.read_text(text, "record");
  EXPECT_EQ(again.text(), text);
  EXPECT_EQ(again.get_number("Material", "latent heat"), 7);
}

TEST_F(Include, LooksBesideTheFileFirst)
{
  fs::create_directories(folder / "materials");
  write("materials/wax.prm", "set latent heat = 8\ninclude more.prm\n");
  write("materials/more.prm", "subsection Solid\nset conductivity = 5\nend");
  const PrmFile prm = read(wax);
  EXPECT_EQ(prm.get_number("Material", "latent heat"), 8);
  EXPECT_EQ(prm.get_number("Material/Solid", "conductivity"), 5);
}

TEST_F(Include, LetsTheLaterFileCount)
{
  const PrmFile after = read("subsection Material\n"
                             "  include materials/wax.prm\n"
                             "  set latent heat = \\\n"
                             "    9\n"
                             "end\n");
  EXPECT_EQ(after.get_number("Material", "latent heat"), 9);
  EXPECT_NE(after.text().find("# set latent heat = 7\n"), std::string::npos);
  const PrmFile before = read("subsection Material\n"
                              "  set latent heat = \\\n"
                              "    9\n"
                              "  include materials/wax.prm\n"
                              "end\n");
  EXPECT_EQ(before.get_number("Material", "latent heat"), 7);
  PrmFile again = keys();
  again.read_text(before.text(), "record");
  EXPECT_EQ(again.get_number("Material", "latent heat"), 7);
}

TEST_F(Include, KeepsAKeyThatOneFileSetsTwiceAMistake)
{
  EXPECT_EQ(complaint("subsection Material\n"
                      "  include materials/wax.prm\n"
                      "  set latent heat = 1\n"
                      "  set latent heat = 2\n"
                      "end\n"),
            "main.prm:4: key 'latent heat' in subsection 'Material' is set a second "
            "time, after line 3");
  EXPECT_EQ(complaint("subsection Material\n"
                      "  set latent heat = 1\n"
                      "  include materials/wax.prm\n"
                      "  set latent heat = 2\n"
                      "end\n"),
            "main.prm:4: key 'latent heat' in subsection 'Material' is set a second "
            "time, after line 2");
}

TEST_F(Include, LosesNoEntryOfAList)
{
  write("bounds.prm", "set criterion 1 = sph: front_rms at n=20 <= 1\n");
  EXPECT_EQ(complaint("subsection Acceptance\n"
                      "  set criterion 1 = sph: front_rms at n=40 <= 1\n"
                      "  include bounds.prm\n"
                      "end\n"),
            "bounds.prm:1: key 'criterion 1' in subsection 'Acceptance' is set in "
            "main.prm:2 too: number it otherwise");
}

TEST_F(Include, NamesTheFileAndLineOfAMistake)
{
  write("library/materials/wax.prm", "\nset latent heat = much\n");
  EXPECT_EQ(complaint(wax), "library/materials/wax.prm:2: key 'latent heat' in "
                            "subsection 'Material' needs a number, not 'much'");
  write("library/materials/wax.prm", "set latent hat = 1\n");
  EXPECT_NE(complaint(wax).find("materials/wax.prm:1: key 'latent hat'"),
            std::string::npos);
  write("library/materials/wax.prm", "set latent heat = 1\n");
  EXPECT_NE(complaint(wax + "set x = 1\n").find("main.prm:5: key 'x'"),
            std::string::npos);
  write("library/materials/wax.prm", "end\n");
  EXPECT_EQ(complaint(wax),
            "library/materials/wax.prm:1: 'end' closes no subsection of this file");
  write("library/materials/wax.prm", "\nsubsection Solid\n");
  EXPECT_EQ(complaint(wax), "library/materials/wax.prm:2: 'subsection Solid' has no "
                            "'end' in this file");
}

TEST_F(Include, NamesTheNearestFileOfTheLibrary)
{
  EXPECT_EQ(
      complaint("\ninclude materials/wacks.prm\n"),
      "main.prm:2: there is no file 'materials/wacks.prm' to include, neither beside "
      "this file nor in the library; the nearest of the library is "
      "'materials/wax.prm'");
  EXPECT_EQ(complaint("include\n"), "main.prm:1: 'include' names no file");
}

TEST_F(Include, RefusesCircles)
{
  EXPECT_EQ(complaint("include main.prm\n"), "main.prm:1: 'main.prm' includes itself");
  write("a.prm", "include b.prm\n");
  write("b.prm", "\ninclude ./a.prm\n");
  EXPECT_EQ(complaint("include a.prm\n"), "b.prm:2: './a.prm' includes itself");
}

TEST_F(Include, RefusesWhatGrowsWithoutEnd)
{
  write("x0.prm", std::string(1 << 18, '#'));
  for(int i = 1; i <= 12; ++i)
  {
    const std::string line = "include x" + std::to_string(i - 1) + ".prm\n";
    write("x" + std::to_string(i) + ".prm", line + line);
  }
  EXPECT_NE(complaint("include x12.prm\n").find("larger than 4 MB"), std::string::npos);
}

TEST_F(Include, LeavesContinuedLinesAndCommentsAlone)
{
  const PrmFile prm = read("# include nothing.prm\n"
                           "subsection Material\n"
                           "  set latent heat = \\\n"
                           "  1\n"
                           "end\n");
  EXPECT_EQ(prm.get_number("Material", "latent heat"), 1);
  write("open.prm", "set latent heat = \\\n");
  EXPECT_NE(complaint("subsection Material\ninclude open.prm\nend\n").find("a number"),
            std::string::npos)
      << "what a file leaves open does not go on in the file that includes it";
}

TEST_F(Include, LetsACaseBeVaried)
{
  const Case water = load_case("plane-freezing-water");
  const Case varied = vary_case(
      water, "w",
      {{"Scene/Material/Liquid/conductivity", "0.7"}, {"Scene/end time", "60"}});
  EXPECT_EQ(varied.scene.material.liquid.conductivity, 0.7);
  EXPECT_EQ(varied.scene.material.solid.conductivity, 2.2);
  EXPECT_EQ(read_case_text(water.text, "again.prm").text, water.text);
}
