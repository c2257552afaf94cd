#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/app/commands.h>
#include <verification/app/crosscheck_command.h>
#include <verification/app/methods.h>
#include <verification/studies/crosscheck/crosscheck.h>
#include <verification/studies/crosscheck/scene_generator.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    /** A form as published is there to repeat what is printed, faults included; what a
     * method takes that its options tell, none does by default. */
    std::vector<const cases::Method *> all_but_published_forms()
    {
      std::vector<const cases::Method *> list;
      for(const auto &method : methods())
        if(method->corrected_form().empty() && !method->capabilities().empty())
          list.push_back(method.get());
      return list;
    }

    std::vector<const cases::Method *> named(const std::vector<std::string> &names)
    {
      std::vector<const cases::Method *> list;
      for(const std::string &name : std::set<std::string>(names.begin(), names.end()))
        list.push_back(&method_named(name));
      return list;
    }

    void print_remarks(const nlohmann::json &remarks, const char *title)
    {
      for(const nlohmann::json &remark : remarks)
        fmt::print("  {} {}: {}\n", title, remark.at("scene").get<std::string>(),
                   remark.at("reason").get<std::string>());
    }

    void print(const nlohmann::json &summary, const std::string &directory)
    {
      fmt::print("{} scenes: {} agreed, {} refused, {} failed, {} suspect\n",
                 summary.at("scenes").get<int>(), summary.at("agreed").get<int>(),
                 summary.at("refused").get<int>(), summary.at("failed").get<int>(),
                 summary.at("suspect").get<int>());
      print_remarks(summary.at("failures"), "failed ");
      if(const std::size_t count = summary.at("too_coarse").size(); count > 0)
        fmt::print("  {} runs failed at resolutions that were too coarse for them; "
                   "three finer ones finished\n",
                   count);
      for(const nlohmann::json &suspect : summary.at("suspects"))
        fmt::print(
            "  suspect {}: {} in '{}', {:.3g} times the bars: {}/{}\n",
            suspect.at("scene").get<std::string>(),
            fmt::join(suspect.at("suspected").get<std::vector<std::string>>(), ", "),
            suspect.at("quantity").get<std::string>(), suspect.at("excess").get<double>(),
            directory, suspect.at("file").get<std::string>());
      fmt::print("Written to {}\n", std::filesystem::absolute(directory + "/summary.json")
                                        .lexically_normal()
                                        .string());
    }
  } // namespace

  int crosscheck(const CrosscheckArguments &arguments)
  {
    CrosscheckSettings settings;
    settings.scenes = arguments.scenes;
    settings.seed = arguments.seed;
    settings.dimension = arguments.dimension;
    settings.directory = !arguments.output.empty()
                             ? arguments.output
                             : fmt::format("results/crosscheck-{}{}", arguments.seed,
                                           arguments.dimension > 0
                                               ? fmt::format("-{}d", arguments.dimension)
                                               : "");
    settings.jobs = arguments.jobs;
    settings.within = arguments.within;
    settings.methods = arguments.methods.empty() ? all_but_published_forms()
                                                 : named(arguments.methods);
    settings.program_version = MELTFRONT_VERSION;
    settings.progress = stderr;
    const nlohmann::json summary
        = crosscheck(settings, cases::read_case_text, random_scene);
    print(summary, settings.directory);
    return summary.at("suspect").get<int>() > 0 ? criterion_failed : all_well;
  }
} // namespace meltfront::verification
