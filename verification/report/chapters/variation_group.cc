#include <verification/report/chapters/variation_group.h>

#include <verification/report/page/number_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    std::string last_part(const std::string &key)
    {
      return key.substr(key.rfind('/') + 1);
    }

    /** Heat capacity of the phase at the wall x = 0 times that wall's difference from the
     * melting point, over the latent heat; NaN without a plane exact solution. */
    double stefan_number(const cases::Case &c)
    {
      if(!c.exact || !c.exact->has_front() || !c.scene.changes_phase()
         || c.exact->symmetry() != cases::Symmetry::planar)
        return std::nan("");
      const cases::Material &material = c.scene.material;
      const cases::PhaseProperties &phase
          = c.exact->solid_at_origin() ? material.solid : material.liquid;
      const double wall = c.exact->temperature(0., c.scene.end_time);
      return phase.specific_heat_capacity * std::abs(wall - material.melting_temperature)
             / material.latent_heat;
    }

    /** How an axis is shown: by the pure number that a key decides, where there is one,
     * else by the key's own value. */
    struct ShownValue
    {
      std::string heading;
      std::string value;
    };

    ShownValue shown(const StoredCase &record,
                     const std::pair<std::string, std::string> &setting)
    {
      const auto &[key, value] = setting;
      const cases::Material &material = record.scene.material;
      const auto number = [](double ratio) { return plain_number(ratio, 4); };
      if(const double stefan = stefan_number(record);
         key == "Scene/Material/latent heat" && std::isfinite(stefan))
        return {"Stefan number", number(stefan)};
      if(key.ends_with("/conductivity"))
        return {"k_s/k_l",
                number(material.solid.conductivity / material.liquid.conductivity)};
      if(key.ends_with("/density"))
        return {"ρ_s/ρ_l", number(material.solid.density / material.liquid.density)};
      return {last_part(key), value};
    }

    bool same_keys(const VariationGroup &group, const StoredCase &record)
    {
      return group.base == record.variation_of
             && std::ranges::equal(group.axes, record.variation,
                                   [](const auto &axis, const auto &setting)
                                   { return axis.key == setting.first; });
    }

    VariationGroup &group_of(std::vector<VariationGroup> &groups,
                             const StoredCase &record)
    {
      for(VariationGroup &group : groups)
        if(same_keys(group, record))
          return group;
      VariationGroup &group = groups.emplace_back();
      group.base = record.variation_of;
      for(const auto &setting : record.variation)
        group.axes.push_back({setting.first, shown(record, setting).heading, {}});
      return group;
    }

    std::size_t place_on(VariationAxis &axis, const std::string &value)
    {
      const auto found = std::ranges::find(axis.values, value);
      if(found != axis.values.end())
        return static_cast<std::size_t>(found - axis.values.begin());
      axis.values.push_back(value);
      return axis.values.size() - 1;
    }
  } // namespace

  std::string VariationGroup::title() const
  {
    std::string words;
    for(const VariationAxis &axis : axes)
      words += (words.empty() ? " by " : " and ") + axis.heading;
    return base + words;
  }

  std::string VariationGroup::file_name() const
  {
    std::string words = base;
    for(const VariationAxis &axis : axes)
      words += fmt::format("-{}", last_part(axis.key));
    return plain_name(words);
  }

  std::vector<VariationGroup> variation_groups(const std::vector<CaseRuns> &variations)
  {
    std::vector<VariationGroup> groups;
    for(const CaseRuns &runs : variations)
    {
      const StoredCase &record = *runs.record;
      VariationGroup &group = group_of(groups, record);
      Variation &variation = group.variations.emplace_back();
      variation.runs = &runs;
      for(std::size_t i = 0; i < group.axes.size(); ++i)
        variation.place.push_back(
            place_on(group.axes[i], shown(record, record.variation[i]).value));
      for(const LabelRuns &label : runs.labels)
        if(std::ranges::find(group.labels, label.label) == group.labels.end())
          group.labels.push_back(label.label);
    }
    return groups;
  }

  double front_peclet_number(const StoredCase &record, const RunRecord &run)
  {
    const auto diffusivity = [](const cases::PhaseProperties &phase)
    { return phase.conductivity / (phase.density * phase.specific_heat_capacity); };
    const RunSeries &series = run.series;
    const std::vector<double> &front
        = series.front_exact.empty() ? series.front : series.front_exact;
    double speed = std::nan("");
    for(std::size_t i = 1; i < std::min(front.size(), series.time.size()); ++i)
      speed = std::fmax(speed, std::abs(front[i] - front[i - 1])
                                   / (series.time[i] - series.time[i - 1]));
    return speed * run.description.spacing
           / std::min(diffusivity(record.scene.material.solid),
                      diffusivity(record.scene.material.liquid));
  }

  std::vector<RunWarning> warnings_of(const LabelRuns &label)
  {
    std::vector<RunWarning> warnings;
    for(const Level &level : label.levels)
      for(const RunRecord *run : level.runs)
        for(const RunEvent &event : run->events)
        {
          const std::string words = event.what.substr(0, event.what.find(':'));
          auto kind = std::ranges::find(warnings, words, &RunWarning::words);
          if(kind == warnings.end())
            kind = warnings.insert(warnings.end(), {words, ""});
          const std::string n = std::to_string(level.n);
          if(!kind->resolutions.ends_with(n))
            kind->resolutions.append(kind->resolutions.empty() ? "" : ", ").append(n);
        }
    return warnings;
  }
} // namespace meltfront::verification
