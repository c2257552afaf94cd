#include <cases/case_file/prm_file.h>
#include <cases/case_file/prm_library.h>
#include <cases/data_folder.h>
#include <cases/error.h>
#include <verification/judge/finding_reader.h>
#include <verification/matrix/criteria_reader.h>
#include <verification/matrix/matrix_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    using cases::PrmFile;
    using cases::PrmKind;

    cases::PrmLibrary library()
    {
      return {cases::data_path("verification/matrix/library"), "matrix"};
    }

    constexpr int most_blocks = 64;

    std::string block_name(int number)
    {
      return fmt::format("Block {}", number);
    }

    PrmFile matrix_keys()
    {
      PrmFile prm(library().folder);
      prm.declare("", {"title", PrmKind::text, "", "", "One line."});
      prm.declare("", {"description", PrmKind::text, "", "", "What the matrix shows."});
      prm.declare("", {"hard cases", PrmKind::boolean, "false", "",
                       "The report judges each run: held, refused or failed."});
      prm.declare("", {"time limit", PrmKind::number, "600", "s",
                       "A run that takes longer has failed.", cases::above_zero});
      prm.declare("", {"timing", PrmKind::text, "quick", "",
                       "quick: short runs are repeated a few times at once; careful: all "
                       "below 10 s in turn, five to fifteen times, until the three least "
                       "times agree within 3 percent."});
      for(int i = 1; i <= most_blocks; ++i)
      {
        const auto declare
            = [&](const char *key, const char *value, const char *sentence) {
                prm.declare(block_name(i), {key, PrmKind::text, value, "", sentence});
              };
        declare("cases", "", "Names of cases, or paths of case files, with commas.");
        declare("methods", "", "Names of methods, with commas.");
        declare("resolutions", "", "Particles or cells along the side, with commas.");
        declare("options", "",
                "Values of options, METHOD.KEY = VALUE | VALUE, with semicolons; every "
                "combination is run.");
        declare("variations", "",
                "Values of keys of the cases, SUBSECTION/KEY = VALUE | VALUE, with "
                "semicolons; every combination is a case of its own.");
        declare("seeds", "1",
                "Seeds of random arrangements, with commas; 1..200 for all between.");
        declare("threads", "1", "Threads of a run; several numbers with commas.");
      }
      declare_criteria(prm);
      declare_findings(prm);
      return prm;
    }

    std::vector<std::string> words(const PrmFile &prm, const std::string &block,
                                   const std::string &key)
    {
      prm.require(block, key, "every block names its cases, methods and resolutions");
      return cases::split_list(prm.get_text(block, key), ',');
    }

    template <typename Integer>
    std::vector<Integer> integers(const PrmFile &prm, const std::string &block,
                                  const std::string &key)
    {
      std::vector<Integer> values;
      for(const std::string &word : cases::split_list(prm.get_text(block, key), ','))
      {
        Integer value{};
        const auto [end, failure]
            = std::from_chars(word.data(), word.data() + word.size(), value);
        if(failure != std::errc() || end != word.data() + word.size() || value < 1)
          throw prm.error(block, key,
                          fmt::format("holds '{}', which is not a whole number from 1 on",
                                      cases::quotable(word)));
        values.push_back(value);
      }
      return values;
    }

    /** `1, 2, 5` and `1..200`, at most 10000 of them. */
    std::vector<std::uint64_t> seeds_of(const PrmFile &prm, const std::string &block)
    {
      constexpr std::uint64_t most = 10000;
      const std::string text = prm.get_text(block, "seeds");
      const std::size_t dots = text.find("..");
      if(dots == std::string::npos)
        return integers<std::uint64_t>(prm, block, "seeds");
      std::uint64_t first = 0, last = 0;
      const auto read = [](const std::string &word, std::uint64_t &value)
      {
        const auto [end, failure]
            = std::from_chars(word.data(), word.data() + word.size(), value);
        return failure == std::errc() && end == word.data() + word.size();
      };
      if(!read(cases::trimmed(text.substr(0, dots)), first)
         || !read(cases::trimmed(text.substr(dots + 2)), last) || first < 1
         || last < first || last - first >= most)
        throw prm.error(block, "seeds",
                        fmt::format("holds '{}', which is not FIRST..LAST with whole "
                                    "numbers from 1 on, at most {} of them",
                                    cases::quotable(text), most));
      std::vector<std::uint64_t> seeds;
      for(std::uint64_t seed = first; seed <= last; ++seed)
        seeds.push_back(seed);
      return seeds;
    }

    /** `METHOD.KEY = VALUE | VALUE` */
    OptionAxis option_axis(const PrmFile &prm, const std::string &block,
                           const std::string &text)
    {
      const std::size_t equals = text.find('=');
      const std::size_t point = text.find('.');
      if(equals == std::string::npos || point == std::string::npos || point > equals)
        throw prm.error(block, "options",
                        fmt::format("holds '{}', which is not of the form METHOD.KEY = "
                                    "VALUE | VALUE",
                                    cases::quotable(text)));
      OptionAxis axis{cases::trimmed(text.substr(0, point)),
                      cases::trimmed(text.substr(point + 1, equals - point - 1)),
                      cases::split_list(text.substr(equals + 1), '|')};
      if(std::ranges::any_of(axis.values, &std::string::empty))
        throw prm.error(block, "options",
                        fmt::format("gives no value to '{}.{}'", axis.method, axis.key));
      return axis;
    }

    /** `SUBSECTION/KEY = VALUE | VALUE` */
    CaseAxis case_axis(const PrmFile &prm, const std::string &block,
                       const std::string &text)
    {
      const std::size_t equals = text.find('=');
      if(equals == std::string::npos || equals == 0)
        throw prm.error(block, "variations",
                        fmt::format("holds '{}', which is not of the form SUBSECTION/KEY "
                                    "= VALUE | VALUE",
                                    cases::quotable(text)));
      CaseAxis axis{cases::trimmed(text.substr(0, equals)),
                    cases::split_list(text.substr(equals + 1), '|')};
      if(std::ranges::any_of(axis.values, &std::string::empty))
        throw prm.error(block, "variations",
                        fmt::format("gives no value to '{}'", cases::quotable(axis.key)));
      return axis;
    }

    std::vector<CaseAxis> read_variations(const PrmFile &prm, const std::string &block)
    {
      std::vector<CaseAxis> axes;
      if(prm.get_text(block, "variations").empty())
        return axes;
      for(const std::string &text :
          cases::split_list(prm.get_text(block, "variations"), ';'))
      {
        CaseAxis axis = case_axis(prm, block, text);
        if(std::ranges::find(axes, axis.key, &CaseAxis::key) != axes.end())
          throw prm.error(
              block, "variations",
              fmt::format("names '{}' a second time", cases::quotable(axis.key)));
        axes.push_back(std::move(axis));
      }
      return axes;
    }

    MatrixBlock read_block(const PrmFile &prm, const std::string &name)
    {
      MatrixBlock block;
      block.cases = words(prm, name, "cases");
      block.methods = words(prm, name, "methods");
      prm.require(name, "resolutions",
                  "every block names its cases, methods and resolutions");
      block.resolutions = integers<int>(prm, name, "resolutions");
      if(!prm.get_text(name, "options").empty())
        for(const std::string &text :
            cases::split_list(prm.get_text(name, "options"), ';'))
          block.options.push_back(option_axis(prm, name, text));
      block.variations = read_variations(prm, name);
      block.seeds = seeds_of(prm, name);
      block.threads = integers<int>(prm, name, "threads");
      return block;
    }

    Matrix assemble(const PrmFile &prm, const std::string &file)
    {
      Matrix matrix;
      matrix.name = short_case_name(file);
      prm.require("", "title", "every matrix has one");
      matrix.title = prm.get_text("", "title");
      matrix.description = prm.get_text("", "description");
      matrix.hard_cases = prm.get_boolean("", "hard cases");
      matrix.time_limit = prm.get_number("", "time limit");
      const std::string timing = prm.get_text("", "timing");
      if(timing != "quick" && timing != "careful")
        throw prm.error("", "timing",
                        fmt::format("is '{}', which is neither quick nor careful",
                                    cases::quotable(timing)));
      matrix.careful_timing = timing == "careful";
      for(int i = 1; i <= most_blocks; ++i)
        if(prm.opened(block_name(i)))
          matrix.blocks.push_back(read_block(prm, block_name(i)));
      matrix.findings = read_findings(prm);
      matrix.pictures = read_pictures(prm);
      if(matrix.blocks.empty())
        throw cases::InputError(
            fmt::format("{}: the matrix has no subsection 'Block 1', so "
                        "that there is nothing to run",
                        file));
      matrix.criteria = read_criteria(prm, matrix);
      return matrix;
    }
  } // namespace

  Matrix read_matrix(const std::string &path)
  {
    PrmFile prm = matrix_keys();
    prm.read(path);
    return assemble(prm, path);
  }

  Matrix read_matrix_text(const std::string &text, const std::string &file)
  {
    PrmFile prm = matrix_keys();
    prm.read_text(text, file);
    return assemble(prm, file);
  }

  std::vector<std::string> matrix_names()
  {
    return library().names();
  }

  Matrix load_matrix(const std::string &name_or_path)
  {
    const std::string path = library().find(name_or_path);
    if(!std::filesystem::exists(path))
      throw cases::InputError(fmt::format("there is no matrix file '{}'; a matrix of the "
                                          "library is named without a path",
                                          cases::quotable(path)));
    return read_matrix(path);
  }

  std::string matrix_file_reference()
  {
    return matrix_keys().reference();
  }
} // namespace meltfront::verification
