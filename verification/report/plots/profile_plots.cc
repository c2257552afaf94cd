#include <verification/report/plots/curve_labels.h>
#include <verification/report/plots/plot_data.h>
#include <verification/report/plots/profile_plots.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    std::string coordinate_name(const StoredCase &record)
    {
      return radial_front(record) ? "r" : "x";
    }

    /** What a quantity is called and where a profile keeps it. */
    struct ProfileColumn
    {
      const char *name;
      const char *unit;
      const std::vector<double> RunProfile::*values;
      const std::vector<double> RunProfile::*exact;
    };

    const ProfileColumn &column_of(ProfileQuantity quantity)
    {
      static const ProfileColumn columns[]
          = {{"temperature", "K or °C", &RunProfile::temperature,
              &RunProfile::temperature_exact},
             {"solid fraction", "by mass", &RunProfile::solid_fraction,
              &RunProfile::solid_fraction_exact},
             {"concentration in the liquid", "by mass", &RunProfile::concentration,
              &RunProfile::concentration_exact}};
      return columns[static_cast<std::size_t>(quantity)];
    }

    /** The profile at an intermediate time, or at the end; null where the run has none.
     */
    const RunProfile *profile_of(const RunRecord &run, int intermediate)
    {
      if(intermediate == profile_at_end)
        return &run.profile;
      const auto i = static_cast<std::size_t>(intermediate);
      return i < run.intermediate_profiles.size() ? &run.intermediate_profiles[i]
                                                  : nullptr;
    }

    void add_profile(Plot &plot, const std::vector<double> &coordinate,
                     const std::vector<double> &values, Curve curve)
    {
      for(const std::size_t i : thinned(coordinate.size()))
      {
        curve.x.push_back(coordinate[i]);
        curve.y.push_back(entry(values, i));
      }
      plot.curves.push_back(std::move(curve));
    }

    Curve exact_curve()
    {
      Curve curve;
      curve.label = "exact";
      curve.markers = false;
      return curve;
    }
  } // namespace

  Plot profile_plot(const CaseRuns &runs, const MethodStyles &styles,
                    ProfileQuantity quantity, int intermediate)
  {
    const ProfileColumn &column = column_of(quantity);
    Plot plot;
    plot.description = fmt::format("{} over {}, {}", column.name,
                                   coordinate_name(*runs.record), runs.record->name());
    plot.x.label = with_unit(coordinate_name(*runs.record), unit_of(*runs.record, "m"));
    plot.y.label = with_unit(column.name, unit_of(*runs.record, column.unit));
    const RunProfile *exact = nullptr;
    for(const LabelRuns &label : runs.labels)
    {
      const RunRecord *run = label.finest();
      const RunProfile *profile = run ? profile_of(*run, intermediate) : nullptr;
      if(!profile || (profile->*column.values).empty())
        continue;
      Curve curve;
      curve.label = label.label;
      curve.style = styles.style(label.label);
      curve.line = run->description.dimension == 1; // else sites scatter
      add_profile(plot, profile->coordinate, profile->*column.values, curve);
      if(!(profile->*column.exact).empty()
         && (!exact || profile->coordinate.size() > exact->coordinate.size()))
        exact = profile;
    }
    shorten_labels(plot);
    if(exact)
      add_profile(plot, exact->coordinate, exact->*column.exact, exact_curve());
    return plot;
  }

  Plot run_profile(const RunRecord &run, const StoredCase &record)
  {
    const MethodStyles styles({run.label});
    const RunProfile &profile = run.profile;
    Plot plot;
    plot.description = "Temperature at the end, " + record.name();
    plot.x.label = with_unit(coordinate_name(record), unit_of(record, "m"));
    plot.y.label = with_unit("temperature", unit_of(record, "K or °C"));
    if(!profile.temperature_exact.empty())
      add_profile(plot, profile.coordinate, profile.temperature_exact, exact_curve());
    // Solid filled, liquid open, as in pictures of particles.
    for(const bool solid : {true, false})
    {
      Curve curve;
      curve.label = solid ? "solid" : "liquid";
      curve.style = styles.style(run.label);
      curve.style.open = !solid;
      curve.line = false;
      std::vector<double> temperature = profile.temperature;
      for(std::size_t i = 0; i < temperature.size(); ++i)
        if((entry(profile.solid_fraction, i) >= 0.5) != solid)
          temperature[i] = std::nan("");
      add_profile(plot, profile.coordinate, temperature, curve);
    }
    return plot;
  }
} // namespace meltfront::verification
