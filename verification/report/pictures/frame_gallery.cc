#include <verification/report/pictures/particle_frames.h>
#include <verification/report/plots/plot_data.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    constexpr std::size_t fewest_pictures = 10, most_pictures = 61;
    constexpr std::size_t most_particles_animated = 20000; // in all pictures together
    constexpr double seconds_per_picture = 0.22;

    Attributes view_of(const FrameDrawing &drawing, const std::string &words)
    {
      return {{"viewBox",
               fmt::format("0 0 {:.0f} {:.0f}", drawing.width(), drawing.height())},
              {"role", "img"},
              {"aria-label", words}};
    }

    std::string name_of(const StoredCase &record, const ParticleFrame &frame)
    {
      return fmt::format("{}, step {}", record.name(), frame.step);
    }

    /** As many frames as make a page of reasonable size. */
    std::vector<std::size_t> animated_frames(const std::vector<ParticleFrame> &frames)
    {
      if(frames.empty() || frames.front().x.empty())
        return {};
      const std::size_t most
          = std::min(most_pictures, most_particles_animated / frames.front().x.size());
      return most < fewest_pictures ? std::vector<std::size_t>()
                                    : thinned(frames.size(), most);
    }
  } // namespace

  const RunRecord *run_with_frames(const std::vector<const RunRecord *> &runs)
  {
    const auto found = std::ranges::find_if(
        runs, [](const RunRecord *run)
        { return run->status == RunStatus::finished && !run->particle_frames.empty(); });
    return found == runs.end() ? nullptr : *found;
  }

  Markup frames_in_page(const StoredCase &record, const RunRecord &run)
  {
    const FrameDrawing drawing(record, run.particle_frames, DrawingColours::of_page());
    Markup figures;
    for(const ParticleFrame &frame : run.particle_frames)
      figures += element("svg", view_of(drawing, name_of(record, frame)),
                         Markup(drawing.background() + drawing.frame(frame)))
                 + Markup("\n");
    return element("div", {{"class", "frames"}}, figures);
  }

  std::string frames_as_file(const StoredCase &record,
                             const std::vector<ParticleFrame> &frames)
  {
    const DrawingColours colours = DrawingColours::of_file();
    const FrameDrawing drawing(record, frames, colours);
    const int count = static_cast<int>(frames.size());
    const int columns = std::min(3, std::max(1, count));
    const int rows = (count + columns - 1) / columns;
    const double width = columns * drawing.width(), height = rows * drawing.height();
    std::string svg = fmt::format(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n"
        "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"{2}\"/>\n",
        width, height, colours.page);
    for(int i = 0; i < count; ++i)
      // A picture of its own, so that nothing reaches into its neighbours.
      svg += fmt::format("<svg x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" "
                         "height=\"{:.0f}\">{}{}</svg>\n",
                         (i % columns) * drawing.width(),
                         (i / columns) * drawing.height(), drawing.width(),
                         drawing.height(), drawing.background(),
                         drawing.frame(frames[static_cast<std::size_t>(i)]));
    return svg + "</svg>\n";
  }

  Markup animation_in_page(const StoredCase &record, const RunRecord &run)
  {
    const std::vector<std::size_t> shown = animated_frames(run.animation);
    if(shown.size() < fewest_pictures)
      return {};
    const FrameDrawing drawing(record, run.animation, DrawingColours::of_page());
    const std::size_t count = shown.size();
    const double period = seconds_per_picture * static_cast<double>(count);
    const std::string name = fmt::format("turn-{}", count);
    std::string svg = fmt::format(
        "<style>@keyframes {}{{0%{{visibility:visible}}{:.4f}%{{visibility:hidden}}}}"
        "</style>",
        name, 100. / static_cast<double>(count));
    svg += drawing.background();
    for(std::size_t i = 0; i < count; ++i)
      // A delay before the start: every picture is in step from the first moment on.
      svg += fmt::format(
          "<g class=\"turn\" style=\"animation:{} {:.2f}s {:.2f}s step-end "
          "infinite\">{}</g>\n",
          name, period, seconds_per_picture * static_cast<double>(i) - period,
          drawing.frame(run.animation[shown[i]]));
    return element("div", {{"class", "animation"}},
                   element("svg", view_of(drawing, record.name() + ", the run in motion"),
                           Markup(svg)));
  }

  const char *frame_style()
  {
    return R"css(
.frames{display:grid;grid-template-columns:repeat(auto-fill,minmax(300px,1fr));gap:.4rem 1rem;margin:.8rem 0}
.frames svg,.animation svg{display:block;width:100%;height:auto;overflow:hidden}
.animation svg{max-width:720px}
.frames text,.animation text{stroke:var(--page);stroke-width:2.5px;stroke-linejoin:round;paint-order:stroke}
.turn{visibility:hidden}
@media (prefers-reduced-motion:reduce){
 .turn{animation:none!important}
 .turn:last-child{visibility:visible}
}
@media print{
 .frames{grid-template-columns:repeat(3,1fr)} .frames svg{break-inside:avoid}
 .turn{animation:none!important} .turn:last-child{visibility:visible}
}
)css";
  }
} // namespace meltfront::verification
