#include <cases/error.h>
#include <cases/options.h>
#include <verification/app/command_line.h>
#include <verification/app/methods.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace
{
  using namespace meltfront::verification;

  /** What the user may have meant by a first word that is no command; empty otherwise. */
  std::string nearest_command(const CLI::App &app, int argc, char **argv)
  {
    if(argc < 2 || argv[1][0] == '-')
      return {};
    std::vector<std::string> names;
    for(const CLI::App *command : app.get_subcommands({}))
      names.push_back(command->get_name());
    const std::string word = argv[1];
    if(std::find(names.begin(), names.end(), word) != names.end())
      return {};
    return fmt::format("there is no command '{}'; the nearest is '{}'", word,
                       meltfront::cases::nearest_name(word, names));
  }

  /** How the program ends; `sentence` says what is wrong. */
  struct End
  {
    int status;
    std::string sentence{};
  };

  End carry_out(CommandLine &command_line, int ranks)
  {
    try
    {
      if(ranks > 1 && !command_line.is_run)
        throw meltfront::cases::InputError(
            fmt::format("'run' is the one command that several ranks share, and this is "
                        "started on {}",
                        ranks));
      add_plugins(command_line.plugins);
      const int status = command_line.action ? command_line.action() : int(all_well);
      if(std::fflush(stdout) != 0)
        throw meltfront::cases::OutputError("standard output cannot be written to");
      return {status};
    }
    catch(const meltfront::cases::InputError &error)
    {
      return {bad_input, error.what()};
    }
    catch(const meltfront::cases::Refusal &error)
    {
      return {bad_input, error.what()};
    }
    catch(const meltfront::cases::NumericalError &error)
    {
      return {run_failed, error.what()};
    }
    catch(const std::exception &error)
    {
      return {output_failed, error.what()};
    }
  }

  End parse_and_carry_out(CommandLine &command_line, int argc, char **argv, int ranks)
  {
    if(const std::string problem = nearest_command(command_line.app, argc, argv);
       !problem.empty())
      return {bad_input, problem};
    try
    {
      command_line.app.parse(argc, argv);
    }
    catch(const CLI::ParseError &error)
    {
      return {command_line.app.exit(error) == 0 ? all_well : bad_input};
    }
    return carry_out(command_line, ranks);
  }

  int run_program(int argc, char **argv)
  {
    set_command_line(argc, argv);
    CommandLine command_line;
    const int ranks = started_ranks();
    if(ranks > 1)
      command_line.session.emplace(argc, argv);
    const End end = parse_and_carry_out(command_line, argc, argv, ranks);
    if(!end.sentence.empty())
    {
      std::fflush(stdout);
      fmt::print(stderr, "meltfront: {}\n", end.sentence);
    }
    if(command_line.session)
      command_line.session->end_together(end.sentence, end.status);
    return end.status;
  }
} // namespace

int main(int argc, char **argv)
{
  try
  {
    return run_program(argc, argv);
  }
  catch(const std::exception &error)
  {
    // Before there is a command: the program's own files are missing.
    fmt::print(stderr, "meltfront: {}\n", error.what());
    return output_failed;
  }
}
