#include <verification/report/plots/plot_folder.h>

#include <cases/error.h>
#include <verification/report/plots/gnuplot.h>

#include <filesystem>
#include <fstream>

namespace meltfront::verification
{
  PlotFolder::PlotFolder(const std::string &directory)
    : directory(directory)
  {
  }

  Markup PlotFolder::figure(const std::string &name, const Plot &plot,
                            const Markup &caption) const
  {
    if(nothing_to_draw(plot))
      return element("p", {{"class", "nothing"}},
                     caption + text(" No finished run has a value to draw."));
    return figure(name, plot_script(plot), plot.description, caption);
  }

  Markup PlotFolder::figure(const std::string &name, const std::string &script,
                            const std::string &description, const Markup &caption) const
  {
    const std::string svg = run_gnuplot(script);
    write_file(directory + "/" + plain_name(name) + ".svg", svg);
    Markup content = element("div", {{"class", "plot"}}, inline_svg(svg, description));
    if(!caption.empty())
      content += element("figcaption", caption);
    return element("figure", content) + Markup("\n");
  }

  void write_file(const std::string &path, const std::string &content)
  {
    std::ofstream file(path, std::ios::binary);
    file << content;
    file.close();
    if(!file)
      throw cases::OutputError("cannot write " + path);
  }

  void make_directory(const std::string &path)
  {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if(error)
      throw cases::OutputError("cannot create the directory " + path + ": "
                               + error.message());
  }
} // namespace meltfront::verification
