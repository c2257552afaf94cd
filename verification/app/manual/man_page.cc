#include <cases/case_file/case_file.h>
#include <verification/app/manual/man_page.h>
#include <verification/app/methods.h>
#include <verification/matrix/matrix_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace meltfront::verification
{
  namespace
  {
    /** Text that roff takes as it is. */
    std::string roff(const std::string &plain)
    {
      std::string text;
      for(const char c : plain)
        if(c == '\\')
          text += "\\e";
        else if(c == '-')
          text += "\\-";
        else if(text.empty() && (c == '.' || c == '\''))
          text += std::string("\\&") + c;
        else
          text += c;
      return text;
    }

    std::string option_entry(const CommandOption &option)
    {
      return fmt::format(".TP\n.B {}{}\n{}\n", roff(option.name),
                         option.takes_value && !option.is_word ? " VALUE" : "",
                         roff(option.description));
    }

    std::vector<std::string> names_of_methods()
    {
      std::vector<std::string> names;
      for(const auto &method : methods())
        names.push_back(method->name());
      return names;
    }

    /** The lines of a `case` of the shell that offer words behind an option. */
    std::string offer(const std::string &options, const std::vector<std::string> &words)
    {
      return fmt::format(
          "    {}) COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n", options,
          fmt::join(words, " "));
    }

    std::string words_offered(const CommandDescription &command)
    {
      std::vector<std::string> words;
      for(const CommandOption &option : command.options)
        if(!option.is_word)
          words.push_back(option.name);
        else
          words.insert(words.end(), option.choices.begin(), option.choices.end());
      return fmt::format("{}", fmt::join(words, " "));
    }

    bool takes_word(const CommandDescription &command, const std::string &name)
    {
      return std::ranges::any_of(command.options, [&](const CommandOption &option)
                                 { return option.is_word && option.name == name; });
    }
  } // namespace

  std::string usage_of(const CommandDescription &command)
  {
    std::string usage = "meltfront " + command.name;
    bool more = false;
    for(const CommandOption &option : command.options)
    {
      std::string name = option.name;
      if(option.is_word)
      {
        std::ranges::transform(name, name.begin(),
                               [](unsigned char c) { return std::toupper(c); });
        usage += option.required ? " " + name : " [" + name + "]";
      }
      else if(option.required)
      {
        std::string value = name.substr(2);
        std::ranges::transform(value, value.begin(),
                               [](unsigned char c) { return std::toupper(c); });
        usage += fmt::format(" {} {}", name, value);
      }
      else
        more = true;
    }
    return more ? usage + " [OPTIONS]" : usage;
  }

  std::string man_page(const std::vector<CommandDescription> &commands)
  {
    std::string text = ".TH MELTFRONT 1\n.SH NAME\nmeltfront \\- the Stefan problem by "
                       "particles and finite elements, measured against exact "
                       "solutions\n.SH SYNOPSIS\n";
    for(const CommandDescription &command : commands)
      text += fmt::format(".B {}\n.br\n", roff(usage_of(command)));
    text += ".SH COMMANDS\n";
    for(const CommandDescription &command : commands)
    {
      text += fmt::format(".SS {}\n{}\n", roff(command.name), roff(command.description));
      for(const CommandOption &option : command.options)
        text += option_entry(option);
      for(const std::string &example : command.examples)
        text += fmt::format(".PP\nExample:\n.B {}\n", roff(example));
    }
    return text
           + ".SH EXIT STATUS\n0 all well, 1 an acceptance criterion failed, 2 bad "
             "arguments or case file, 3 a run failed numerically, 4 input or output "
             "failed.\n.SH SEE ALSO\n.B meltfront manual\nwrites the whole manual as one "
             "page.\n";
  }

  std::string bash_completion(const std::vector<CommandDescription> &commands)
  {
    std::vector<std::string> names;
    for(const CommandDescription &command : commands)
      names.push_back(command.name);
    std::string text
        = "# Read by: source <(./meltfront manual --format bash)\n"
          "_meltfront()\n{\n"
          "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
          "  COMPREPLY=()\n"
          "  if ((COMP_CWORD == 1)); then\n";
    text += fmt::format("    COMPREPLY=($(compgen -W '{}' -- \"$word\")); return\n  fi\n",
                        fmt::join(names, " "));
    text += "  case $before in\n";
    text += offer("--method|--methods", names_of_methods());
    text += offer("--like", cases::library_names());
    for(const CommandDescription &command : commands)
      for(const CommandOption &option : command.options)
        if(!option.is_word && !option.choices.empty())
          text += offer(option.name, option.choices);
    text += "  esac\n  case ${COMP_WORDS[1]} in\n";
    for(const CommandDescription &command : commands)
    {
      std::vector<std::string> words{words_offered(command)};
      if(takes_word(command, "case"))
        words.push_back(fmt::format("{}", fmt::join(cases::library_names(), " ")));
      if(takes_word(command, "matrix"))
        words.push_back(fmt::format("full {}", fmt::join(matrix_names(), " ")));
      text += offer(command.name, words);
    }
    return text + "  esac\n}\ncomplete -o default -F _meltfront meltfront ./meltfront\n";
  }
} // namespace meltfront::verification
