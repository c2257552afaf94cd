#ifndef meltfront_verification_report_plots_plot_folder_h
#define meltfront_verification_report_plots_plot_folder_h

#include <verification/report/page/markup.h>
#include <verification/report/plots/plot.h>

#include <string>

namespace meltfront::verification
{
  /** Writes plots as SVG files of their own and returns them as figures of the page. */
  class PlotFolder
  {
  public:
    explicit PlotFolder(const std::string &directory);

    /** A figure with its caption; a sentence in its place if there is nothing to draw. */
    Markup figure(const std::string &name, const Plot &plot, const Markup &caption) const;

    /** A figure drawn by a script of its own. */
    Markup figure(const std::string &name, const std::string &script,
                  const std::string &description, const Markup &caption) const;

  private:
    std::string directory;
  };

  /** Write a file. @throws cases::OutputError if it cannot be written. */
  void write_file(const std::string &path, const std::string &content);

  /** Create a directory and its parents. @throws cases::OutputError if it cannot. */
  void make_directory(const std::string &path);
} // namespace meltfront::verification

#endif
