#include <cases/error.h>
#include <cases/options.h>
#include <verification/matrix/matrix.h>
#include <verification/run/run_one.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    using OptionValues = std::map<std::string, std::string>;

    /** Every combination of the values that a block gives to one method's options. */
    std::vector<OptionValues> combinations(const MatrixBlock &block,
                                           const std::string &method)
    {
      std::vector<OptionValues> result{{}};
      for(const OptionAxis &axis : block.options)
      {
        if(axis.method != method)
          continue;
        std::vector<OptionValues> extended;
        for(const OptionValues &values : result)
          for(const std::string &value : axis.values)
          {
            extended.push_back(values);
            extended.back()[axis.key] = value;
          }
        result = std::move(extended);
      }
      return result;
    }

    void check(const Matrix &matrix, const MatrixBlock &block)
    {
      const auto fail = [&](const std::string &problem)
      { throw cases::InputError(fmt::format("matrix '{}': {}", matrix.name, problem)); };
      if(block.cases.empty() || block.methods.empty() || block.resolutions.empty()
         || block.seeds.empty() || block.threads.empty())
        fail("a block needs at least one case, one method, one resolution, one seed and "
             "one "
             "number of threads");
      for(const int n : block.resolutions)
        if(n < 1)
          fail(fmt::format("a resolution must be at least 1, not {}", n));
      for(const int threads : block.threads)
        if(threads < 1)
          fail(fmt::format("a run needs at least 1 thread, not {}", threads));
      for(const OptionAxis &axis : block.options)
      {
        if(std::ranges::find(block.methods, axis.method) == block.methods.end())
          fail(
              fmt::format("option {}.{} belongs to a method that its block does not name",
                          axis.method, axis.key));
        if(axis.values.empty())
          fail(fmt::format("option {}.{} has no value", axis.method, axis.key));
      }
    }

    /** What a varied key is called in a case's name: its last words, with the subsection
     * before them where another axis has the same; blanks and slashes would be awkward in
     * the names of files. */
    std::string short_key(const MatrixBlock &block, const CaseAxis &axis)
    {
      const auto last_part
          = [](const std::string &path) { return path.substr(path.rfind('/') + 1); };
      std::string name = last_part(axis.key);
      const auto alike
          = std::ranges::count_if(block.variations, [&](const CaseAxis &other)
                                  { return last_part(other.key) == name; });
      if(alike > 1)
        name = axis.key;
      std::ranges::replace(name, ' ', '_');
      std::ranges::replace(name, '/', '.');
      return name;
    }

    std::string varied_name(const MatrixBlock &block, const PlannedCase &planned)
    {
      if(planned.settings.empty())
        return short_case_name(planned.base);
      std::map<std::string, std::string> values;
      for(std::size_t i = 0; i < block.variations.size(); ++i)
        values[short_key(block, block.variations[i])] = planned.settings[i].second;
      std::string inside;
      for(const auto &[key, value] : values)
        inside += fmt::format("{}{}={}", inside.empty() ? "" : ",", key, value);
      std::ranges::replace(inside, '/', '_');
      return fmt::format("{}[{}]", short_case_name(planned.base), inside);
    }

    /** A case with every combination of the values that a block gives to its keys. */
    std::vector<PlannedCase> planned_cases(const MatrixBlock &block,
                                           const std::string &case_name)
    {
      std::vector<PlannedCase> result{{"", case_name, {}}};
      for(const CaseAxis &axis : block.variations)
      {
        std::vector<PlannedCase> extended;
        for(const PlannedCase &planned : result)
          for(const std::string &value : axis.values)
          {
            extended.push_back(planned);
            extended.back().settings.emplace_back(axis.key, value);
          }
        result = std::move(extended);
      }
      for(PlannedCase &planned : result)
        planned.name = varied_name(block, planned);
      return result;
    }

    bool runs_at(const MatrixBlock &block, const PlannedCase &planned)
    {
      return std::ranges::find(block.cases, planned.base) != block.cases.end()
             && std::ranges::any_of(planned_cases(block, planned.base),
                                    [&planned](const PlannedCase &of_block)
                                    { return of_block.settings == planned.settings; });
    }

    void add_runs(const MatrixBlock &block, const std::string &case_name,
                  const MethodLookup &methods, std::vector<PlannedRun> &runs)
    {
      for(const std::string &name : block.methods)
      {
        const cases::Method &method = methods(name);
        for(const OptionValues &values : combinations(block, name))
          for(const int threads : block.threads)
          {
            cases::Options options(method.option_declarations());
            for(const auto &[key, value] : values)
              options.set(key, value);
            for(const int n : block.resolutions)
              for(const std::uint64_t seed : block.seeds)
                runs.push_back({case_name, name, run_label(name, values, threads),
                                cases::Resolution{n, options, seed, threads}});
          }
      }
    }
  } // namespace

  std::string PlannedRun::identity() const
  {
    std::string folder = label;
    std::ranges::replace(folder, '/', '_');
    return fmt::format("{}/{}/n={}{}", case_name, folder, resolution.n,
                       resolution.seed == 1 ? ""
                                            : fmt::format(",seed={}", resolution.seed));
  }

  std::string PlannedRun::file() const
  {
    return fmt::format("runs/{}/run.json", identity());
  }

  std::string short_case_name(const std::string &name_or_path)
  {
    if(name_or_path.ends_with(".prm") || name_or_path.find('/') != std::string::npos)
      return std::filesystem::path(name_or_path).stem().string();
    return name_or_path;
  }

  std::vector<std::string> case_names(const Matrix &matrix)
  {
    std::vector<std::string> names;
    for(const MatrixBlock &block : matrix.blocks)
      for(const std::string &name : block.cases)
        if(std::ranges::find(names, name) == names.end())
          names.push_back(name);
    return names;
  }

  std::vector<PlannedCase> planned_cases(const Matrix &matrix)
  {
    std::vector<PlannedCase> result;
    std::set<std::string> known;
    for(const std::string &name : case_names(matrix))
      for(const MatrixBlock &block : matrix.blocks)
      {
        if(std::ranges::find(block.cases, name) == block.cases.end())
          continue;
        for(const CaseAxis &axis : block.variations)
          if(axis.values.empty())
            throw cases::InputError(fmt::format(
                "matrix '{}': '{}' is varied without a value", matrix.name, axis.key));
        for(PlannedCase &planned : planned_cases(block, name))
          if(known.insert(planned.base + "\n" + planned.name).second)
            result.push_back(std::move(planned));
      }
    return result;
  }

  std::map<std::string, std::set<int>> planned_labels(const Matrix &matrix,
                                                      const PlannedCase &planned)
  {
    std::map<std::string, std::set<int>> labels;
    for(const MatrixBlock &block : matrix.blocks)
      if(runs_at(block, planned))
        for(const std::string &method : block.methods)
          for(const OptionValues &values : combinations(block, method))
            for(const int threads : block.threads)
              labels[run_label(method, values, threads)].insert(block.resolutions.begin(),
                                                                block.resolutions.end());
    return labels;
  }

  std::vector<PlannedRun> plan_runs(const Matrix &matrix, const MethodLookup &methods)
  {
    for(const MatrixBlock &block : matrix.blocks)
      check(matrix, block);
    std::vector<PlannedRun> runs;
    for(const PlannedCase &planned : planned_cases(matrix))
      for(const MatrixBlock &block : matrix.blocks)
        if(runs_at(block, planned))
          add_runs(block, planned.name, methods, runs);
    std::set<std::string> known;
    std::erase_if(runs, [&](const PlannedRun &run)
                  { return !known.insert(run.file()).second; });
    return runs;
  }

  const PlannedRun &find_run(const std::vector<PlannedRun> &plan,
                             const std::string &identity_or_number)
  {
    std::size_t number = 0;
    const char *const end = identity_or_number.data() + identity_or_number.size();
    const auto [stop, failure] = std::from_chars(identity_or_number.data(), end, number);
    if(failure == std::errc() && stop == end && number >= 1 && number <= plan.size())
      return plan[number - 1];
    std::vector<std::string> identities;
    for(const PlannedRun &run : plan)
      if(run.identity() == identity_or_number)
        return run;
      else
        identities.push_back(run.identity());
    throw cases::InputError(
        fmt::format("the matrix has no run '{}'; the nearest of its {} is '{}'",
                    cases::quotable(identity_or_number), plan.size(),
                    cases::nearest_name(identity_or_number, identities)));
  }
} // namespace meltfront::verification
