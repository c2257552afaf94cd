#include <cases/error.h>
#include <verification/measure/measure.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  MeasureKind run_size(), front_error(), tracked_points(), solid_volume_over_time(),
      front_square(), front_mode(), front_backsteps(), front_row(), timed_events(),
      mirror_asymmetry(), advected_interface(), particle_solid(), temperature(), mush(),
      budgets(), entropy_fall(), unseen_layers(), run_cost();

  const std::vector<MeasureKind> &measures()
  {
    static const std::vector<MeasureKind> all{run_size(),
                                              front_error(),
                                              tracked_points(),
                                              solid_volume_over_time(),
                                              front_square(),
                                              front_mode(),
                                              front_backsteps(),
                                              front_row(),
                                              timed_events(),
                                              mirror_asymmetry(),
                                              advected_interface(),
                                              particle_solid(),
                                              temperature(),
                                              mush(),
                                              budgets(),
                                              entropy_fall(),
                                              unseen_layers(),
                                              run_cost()};
    return all;
  }

  Quantity value_quantity(const std::string &name, const std::string &heading,
                          const std::string &unit, Shown shown, int csv_rank)
  {
    return {.name = name,
            .heading = heading,
            .unit = unit,
            .shown = shown,
            .csv_rank = csv_rank};
  }

  Quantity error_quantity(const std::string &name, const std::string &heading,
                          const std::string &unit, Shown shown, int csv_rank)
  {
    Quantity quantity = value_quantity(name, heading, unit, shown, csv_rank);
    quantity.error = true;
    return quantity;
  }

  Quantity hidden_quantity(const std::string &name)
  {
    return {.name = name, .shown = Shown::nowhere};
  }

  Quantity told(Quantity quantity, double (*of_run)(const RunFigures &))
  {
    quantity.of_run = of_run;
    return quantity;
  }

  std::vector<Quantity> with_differences(Quantity quantity)
  {
    std::vector<Quantity> list{quantity};
    list[0].compared = true;
    for(const char *suffix : {"_error", "_bars"})
      list.push_back({.name = quantity.name + suffix,
                      .shown = Shown::nowhere,
                      .from_reference = true});
    return list;
  }

  void Measure::keep_largest(const std::string &name, double value)
  {
    const auto at = values.try_emplace(name, value).first;
    at->second = std::fmax(at->second, value);
  }

  std::vector<std::unique_ptr<Measure>> measures_for(MeasuredScenes scenes,
                                                     const MeasuredRun &run)
  {
    std::vector<std::unique_ptr<Measure>> started;
    for(const MeasureKind &kind : measures())
      if(kind.scenes == scenes)
        if(auto measure = kind.start(run))
          started.push_back(std::move(measure));
    return started;
  }

  const std::vector<Quantity> &all_quantities()
  {
    static const std::vector<Quantity> quantities = []
    {
      std::vector<Quantity> list;
      for(const MeasureKind &kind : measures())
        list.insert(list.end(), kind.quantities.begin(), kind.quantities.end());
      return list;
    }();
    return quantities;
  }

  void require_quantity(const std::string &name)
  {
    std::vector<std::string> names;
    for(const Quantity &quantity : all_quantities())
      names.push_back(quantity.name);
    if(std::ranges::find(names, name) == names.end())
      throw cases::InputError(
          fmt::format("there is no quantity '{}'; the nearest is '{}'", name,
                      cases::nearest_name(name, names)));
  }

  std::vector<std::string> Sighting::suffixes(const std::string &end) const
  {
    std::vector<std::string> list;
    for(const int intermediate : intermediate_times)
      list.push_back(fmt::format("_{}", intermediate));
    if(at_end)
      list.push_back(end);
    return list;
  }
} // namespace meltfront::verification
