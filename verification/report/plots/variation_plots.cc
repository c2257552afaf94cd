#include <verification/report/plots/variation_plots.h>

#include <verification/report/plots/gnuplot.h>
#include <verification/report/tables/convergence_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    using Script = std::back_insert_iterator<std::string>;

    constexpr double chart_width = 640, row_height = 84, column_heads = 62;
    /** Relative errors between which shades go from none to the darkest. */
    constexpr double faintest = 1e-7, darkest = 1e-1;
    constexpr double strongest_shade = 0.75;
    constexpr std::size_t shade_colour = 1;

    /** gnuplot's enhanced text of a number: `1.2·10^{-6}`. */
    std::string enhanced(double value, int digits)
    {
      const NumberText number = prose_number(value, digits);
      return number.exponent.empty()
                 ? with_minus_sign(number.digits)
                 : fmt::format("{}·10^{{{}}}", number.digits, number.exponent);
    }

    /** A heading whose `_` sets an index. */
    std::string quoted(const std::string &heading)
    {
      return "'" + heading + "'";
    }

    /** `h^{1.98}`, or what is wrong with the sequence of errors. */
    std::string order_words(const OrderFit &fit, const std::string &symbol)
    {
      return fit.verdict == OrderVerdict::clean
                 ? fmt::format("{}^{{{:.2f}}}", symbol, fit.order)
                 : fmt::format("{{/*0.8 {}}}", to_string(fit.verdict));
    }

    double shade(double error)
    {
      const double share = std::log(error / faintest) / std::log(darkest / faintest);
      return strongest_shade * std::clamp(share, 0., 1.);
    }

    void write_cell(Script out, const Variation &variation, const LabelRuns &runs,
                    std::size_t row)
    {
      const StoredCase &record = *variation.runs->record;
      const double x = static_cast<double>(variation.place[1]) + 0.5,
                   y = static_cast<double>(row) + 0.5;
      const RunRecord *finest = runs.finest();
      if(!finest)
      {
        fmt::format_to(out, "set label 'no run' at {},{} center\n", x, y);
        return;
      }
      const double error = relative_front_error(record, runs.levels.back());
      const OrderFit fit = order_of(record, runs, "front_rms");
      fmt::format_to(out,
                     "set object rectangle from {},{} to {},{} fc rgb '{}' fs "
                     "transparent solid {:.3f} noborder\n",
                     x - 0.48, y - 0.47, x + 0.48, y + 0.47,
                     palette()[shade_colour].light,
                     std::isfinite(error) ? shade(error) : 0);
      fmt::format_to(out, "set label '{}' at {},{} center offset 0,1.25\n",
                     enhanced(error, 2), x, y);
      fmt::format_to(out, "set label '{}' at {},{} center\n",
                     order_words(fit, runs.refinement.symbol()), x, y);
      fmt::format_to(out, "set label '{{/*0.85 ({})}}' at {},{} center offset 0,-1.25\n",
                     enhanced(front_peclet_number(record, *finest), 2), x, y);
    }

    void write_tics(Script out, char name, const VariationAxis &axis, bool downwards)
    {
      std::string tics;
      for(std::size_t i = 0; i < axis.values.size(); ++i)
      {
        const std::size_t place = downwards ? axis.values.size() - 1 - i : i;
        tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", axis.values[i],
                            static_cast<double>(place) + 0.5);
      }
      fmt::format_to(out, "set {0}tics ({1}) scale 0\nset {0}range [0:{2}]\n", name, tics,
                     axis.values.size());
    }
  } // namespace

  double relative_front_error(const StoredCase &record, const Level &level)
  {
    return level.value("front_rms") / front_size_at_end(record);
  }

  std::string variation_map_script(const VariationGroup &group, const std::string &label)
  {
    const std::size_t rows = group.axes[0].values.size();
    const double height = row_height * static_cast<double>(rows) + column_heads;
    std::string script;
    const Script out = std::back_inserter(script);
    fmt::format_to(out,
                   "set encoding utf8\n"
                   "set terminal svg size {},{} dynamic enhanced font 'sans-serif,13'\n"
                   "set lmargin at screen 0.12\nset rmargin at screen 0.995\n"
                   "set tmargin at screen 0.995\nset bmargin at screen {:.4f}\n"
                   "unset key\nunset border\n"
                   "set xlabel {} offset 0,0.3\nset ylabel {}\n",
                   chart_width, height, column_heads / height,
                   quoted(group.axes[1].heading), quoted(group.axes[0].heading));
    write_tics(out, 'x', group.axes[1], false);
    write_tics(out, 'y', group.axes[0], true);
    for(const Variation &variation : group.variations)
      if(const LabelRuns *runs = variation.runs->find(label))
        write_cell(out, variation, *runs, rows - 1 - variation.place[0]);
    return script + "plot NaN notitle\n";
  }

  Plot error_against_peclet(const VariationGroup &group, const std::string &label)
  {
    Plot plot;
    plot.description = "Relative error of the front against V h/α, " + group.base;
    plot.x = {.label = "V h/α at the front", .logarithmic = true};
    plot.y = {.label = "front error, RMS over the exact front", .logarithmic = true};
    plot.guides = {{2, "(V h/α)"}};
    const std::vector<std::string> &names = group.axes[0].values;
    const MethodStyles styles(names);
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      Curve &curve = plot.curves.emplace_back();
      curve.label = names[i];
      curve.style = styles.style(names[i]);
      curve.line = false;
      for(const Variation &variation : group.variations)
        if(const LabelRuns *runs = variation.runs->find(label);
           runs && variation.place[0] == i)
          for(const Level &level : runs->levels)
            if(level.finished)
            {
              curve.x.push_back(
                  front_peclet_number(*variation.runs->record, *level.finished));
              curve.y.push_back(relative_front_error(*variation.runs->record, level));
            }
    }
    return plot;
  }
} // namespace meltfront::verification
