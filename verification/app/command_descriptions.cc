#include <cases/data_folder.h>
#include <verification/app/command_descriptions.h>

#include <fmt/format.h>

#include <map>
#include <stdexcept>

namespace meltfront::verification
{
  namespace
  {
    // What follows the program's name. Each runs as it stands in a fresh clone; a test
    // does so.
    const std::map<std::string, std::vector<std::string>> examples{
        {"verify",
         {"verify scenes", "verify default --against results/reference",
          "verify default --list-runs"}},
        {"stability", {"stability --jobs 2"}},
        {"run",
         {"run plane-freezing --method sph --n 80 --out results/first",
          "run pipe-freezing --method fem-fitted --n 32 --set "
          "'Scene/Material/latent heat=300 kJ/kg'",
          "run corner-freezing --method fem-enthalpy --set "
          "fem-enthalpy.steps=200 --memory 4 --time-limit 600"}},
        {"compare", {"compare plane-freezing --within 30"}},
        {"advise", {"advise plane-freezing --front-error 1e-4 --within 60"}},
        {"crosscheck", {"crosscheck --scenes 20 --seed 1 --dimension 1"}},
        {"ablate", {"ablate plane-freezing-water --within 60"}},
        {"sensitivity", {"sensitivity plane-freezing-water --within 60"}},
        {"calibrate", {"calibrate greenspan --substance rectangle"}},
        {"list", {"list cases", "list keys", "list capabilities --json"}},
        {"new", {"new cold-pipe --like pipe-freezing"}},
        {"manual",
         {"manual --out results/manual.html",
          "manual --format bash --out results/meltfront.bash"}},
        {"report", {"report results/default"}},
        {"test", {"test"}}};

    std::vector<std::string> examples_of(const std::string &command)
    {
      const auto found = examples.find(command);
      if(found == examples.end())
        throw std::logic_error(fmt::format("the command '{}' has no example", command));
      std::vector<std::string> lines;
      for(const std::string &example : found->second)
        lines.push_back(cases::program_call() + " " + example);
      return lines;
    }

    /** The choices that stand in an option's type, `TEXT:{quick,careful}`. */
    std::vector<std::string> choices_of(const CLI::Option &option)
    {
      const std::string type = option.get_type_name();
      const std::size_t open = type.find('{'), close = type.rfind('}');
      std::vector<std::string> choices;
      if(open == std::string::npos || close == std::string::npos)
        return choices;
      for(const std::string &choice :
          CLI::detail::split(type.substr(open + 1, close - open - 1), ','))
        choices.push_back(choice);
      return choices;
    }

    CommandOption described(const CLI::Option &option)
    {
      CommandOption result;
      result.is_word = option.get_positional();
      result.name = option.get_name(result.is_word);
      result.description = option.get_description();
      result.takes_value = option.get_items_expected_max() > 0;
      result.required = option.get_required();
      result.choices = choices_of(option);
      return result;
    }
  } // namespace

  void add_examples(CLI::App &app)
  {
    for(CLI::App *command : app.get_subcommands({}))
    {
      const std::vector<std::string> lines = examples_of(command->get_name());
      std::string text = lines.size() > 1 ? "Examples:" : "Example:";
      for(const std::string &example : lines)
        text += "\n  " + example;
      command->footer(text);
    }
  }

  std::vector<CommandDescription> descriptions_of(const CLI::App &app)
  {
    std::vector<CommandDescription> commands;
    for(const CLI::App *command : app.get_subcommands({}))
    {
      CommandDescription one{command->get_name(),
                             command->get_description(),
                             examples_of(command->get_name()),
                             {}};
      for(const CLI::Option *option : command->get_options())
        if(option->get_name() != "--help" && option->get_name() != "-h,--help")
          one.options.push_back(described(*option));
      commands.push_back(std::move(one));
    }
    return commands;
  }
} // namespace meltfront::verification
