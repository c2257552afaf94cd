#include <verification/report/page/case_runs.h>
#include <verification/report/page/report.h>
#include <verification/report/pictures/advected_picture.h>
#include <verification/report/pictures/particle_frames.h>
#include <verification/report/pictures/scene_picture.h>
#include <verification/report/plots/gnuplot.h>
#include <verification/report/plots/plot_folder.h>
#include <verification/report/plots/profile_plots.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    std::string front_csv(const RunSeries &series)
    {
      std::string csv
          = "time,front,front_isotherm,front_exact,budget_defect,solid_volume\n";
      for(std::size_t i = 0; i < series.time.size(); ++i)
      {
        csv += fmt::format("{:.16g}", series.time[i]);
        for(const std::vector<double> *column :
            {&series.front, &series.front_isotherm, &series.front_exact,
             &series.budget_defect, &series.solid_volume})
        {
          const double value = i < column->size() ? (*column)[i] : std::nan("");
          csv += std::isnan(value) ? ",nan" : fmt::format(",{:.16g}", value);
        }
        csv += "\n";
      }
      return csv;
    }

    /** Sites that fill an area, not only a line. */
    bool fills_a_plane(const RunRecord &run, const StoredCase &record)
    {
      return run.description.dimension > 1
             && record.scene.domain.shape != cases::DomainShape::slab
             && !run.profile.picture_x.empty();
    }
  } // namespace

  void write_run_page(const RunRecord &run, const StoredCase &record,
                      const std::string &directory)
  {
    make_directory(directory);
    write_file(directory + "/front.csv", front_csv(run.series));
    if(moves_particles(record) && !run.particle_frames.empty())
    {
      write_file(directory + "/picture.svg",
                 frames_as_file(record, {run.particle_frames.back()}));
      return;
    }
    std::string script;
    if(carries_front(record) && record.scene.domain.dimension == 2)
      script = advected_interface_script(record, run.frames);
    else if(fills_a_plane(run, record))
    {
      SceneContent content{&run, {}, {}};
      content.front = run.series.front.empty() ? std::nan("") : run.series.front.back();
      if(!run.frames.empty())
        content.tracked = {run.frames.back()};
      script = scene_picture_script(record, content);
    }
    else
      script = plot_script(run_profile(run, record));
    write_file(directory + "/picture.svg", run_gnuplot(script));
  }
} // namespace meltfront::verification
