#include <verification/report/plots/gnuplot.h>

#include <cases/error.h>
#include <verification/record/temporary_directory.h>

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include <sys/wait.h>

namespace meltfront::verification
{
  namespace
  {
    std::string shell_quoted(const std::string &path)
    {
      std::string quoted = "'";
      for(const char c : path)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
      return quoted + "'";
    }

    std::string content_of(const std::string &path)
    {
      std::ifstream file(path, std::ios::binary);
      return {std::istreambuf_iterator<char>(file), {}};
    }

    std::string first_lines(const std::string &text)
    {
      std::string result;
      for(const char c : text.substr(0, 400))
        result += c == '\n' ? ' ' : c;
      return result;
    }
  } // namespace

  std::string run_gnuplot(const std::string &script)
  {
    const TemporaryDirectory directory;
    const std::string input = directory.path("script"),
                      messages = directory.path("messages");
    std::ofstream(input) << script;
    const std::string command
        = fmt::format("gnuplot {} 2>{}", shell_quoted(input), shell_quoted(messages));
    FILE *pipe = popen(command.c_str(), "r");
    if(!pipe)
      throw cases::OutputError("cannot start gnuplot, which draws the plots");
    std::string output;
    char buffer[1 << 16];
    while(const std::size_t count = fread(buffer, 1, sizeof buffer, pipe))
      output.append(buffer, count);
    const int status = pclose(pipe);
    constexpr int command_not_found = 127;
    if(WIFEXITED(status) && WEXITSTATUS(status) == command_not_found)
      throw cases::OutputError("gnuplot, which draws the plots, is not installed "
                               "(Debian package gnuplot-nox)");
    if(status != 0)
      throw cases::OutputError("gnuplot could not draw a plot: "
                               + first_lines(content_of(messages)));
    return output;
  }

  std::string gnuplot_text(const std::string &plain)
  {
    std::string quoted = "'";
    for(const char c : plain)
      if(c == '\'')
        quoted += "''";
      else if(static_cast<unsigned char>(c) < 0x20)
        quoted += ' ';
      else
      {
        if(std::string_view("\\{}^_@&~").find(c) != std::string_view::npos)
          quoted += '\\';
        quoted += c;
      }
    return quoted + "'";
  }
} // namespace meltfront::verification
