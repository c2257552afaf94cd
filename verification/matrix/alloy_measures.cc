#include <cases/numbers.h>
#include <verification/matrix/alloy_measures.h>
#include <verification/matrix/end_profile.h>
#include <verification/measure/mush_error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;
    constexpr const char *errors[]
        = {"temperature_rms", "solid_fraction_rms", "concentration_rms", "ice_error"};
  } // namespace

  AlloyMeasures::AlloyMeasures(const cases::Case &c, const cases::Scene &simulated,
                               double spacing)
    : the_case(c)
    , mush(c.exact && c.exact->mushy() ? c.exact.get() : nullptr)
    , solutes(simulated.alloy ? simulated.alloy->solutes.size() : 0)
    , spacing(spacing)
    , lower(simulated.domain.round() ? simulated.domain.inner_radius
                                     : simulated.domain.lower[0])
    , upper(simulated.domain.round() ? simulated.domain.radius
                                     : simulated.domain.upper[0])
    , time_tolerance(1e-9 * (simulated.end_time - simulated.start_time))
  {
    for(const std::string &name : quantity_names())
      values[name] = nan;
    if(c.measurement.absolute_zero)
      entropy_meter.emplace(simulated, *c.measurement.absolute_zero);
  }

  void AlloyMeasures::EntropyCourse::add(double value)
  {
    if(samples++ == 0)
      first = value;
    else
    {
      largest_fall = std::max(largest_fall, last - value);
      largest_gain = std::max(largest_gain, value - first);
    }
    last = value;
    if(std::isnan(value))
      largest_gain = largest_fall = nan;
  }

  double AlloyMeasures::EntropyCourse::fall() const
  {
    return samples > 1 && largest_gain > 0 ? largest_fall / largest_gain : nan;
  }

  void AlloyMeasures::add(const cases::Snapshot &snapshot,
                          const std::vector<double> &coordinates)
  {
    const auto keep_worst = [this](const std::string &name, double defect)
    { values[name] = std::fmax(values[name], defect); };
    for(std::size_t s = 0; s < solutes; ++s)
      keep_worst("solute_defect", snapshot.solute[s].defect());
    if(solutes > 0)
      keep_worst("mass_defect", snapshot.mass.defect());
    if(entropy_meter)
    {
      const Entropy entropy = entropy_meter->of(snapshot);
      total.add(entropy.total);
      mixing.add(entropy.mixing);
    }
    const std::vector<double> &marks = the_case.measurement.marks;
    while(next_mark < marks.size() && snapshot.time >= marks[next_mark] - time_tolerance)
    {
      ++next_mark;
      compare(snapshot, coordinates, fmt::format("_{}", next_mark));
      if(solutes > 0 || static_cast<int>(next_mark) == the_case.measurement.picture_mark)
        mark_profiles.push_back(
            make_end_profile(snapshot, coordinates, the_case.exact.get(), spacing));
    }
  }

  void AlloyMeasures::measure_end(const cases::Snapshot &snapshot,
                                  const std::vector<double> &coordinates)
  {
    compare(snapshot, coordinates, "");
  }

  void AlloyMeasures::compare(const cases::Snapshot &snapshot,
                              const std::vector<double> &coordinates,
                              const std::string &suffix)
  {
    if(!mush)
      return;
    const MushError error
        = mush_error(snapshot, coordinates, *mush, the_case.measurement.temperature_from,
                     the_case.measurement.temperature_to, lower, upper);
    const double found[] = {error.temperature_rms, error.solid_fraction_rms,
                            error.concentration_rms, error.ice_error};
    for(std::size_t i = 0; i < std::size(found); ++i)
      values[errors[i] + suffix] = found[i];
  }

  std::map<std::string, double> AlloyMeasures::quantities() const
  {
    std::map<std::string, double> result = values;
    result["entropy_fall"] = total.fall();
    result["mixing_entropy_fall"] = mixing.fall();
    return result;
  }

  const std::vector<RunProfile> &AlloyMeasures::profiles() const
  {
    return mark_profiles;
  }

  const std::vector<std::string> &AlloyMeasures::quantity_names()
  {
    static const std::vector<std::string> names = []
    {
      std::vector<std::string> list;
      for(const char *error : errors)
      {
        list.push_back(error);
        for(int mark = 1; mark <= cases::most_marks; ++mark)
          list.push_back(fmt::format("{}_{}", error, mark));
      }
      for(const char *name :
          {"mass_defect", "solute_defect", "entropy_fall", "mixing_entropy_fall"})
        list.push_back(name);
      return list;
    }();
    return names;
  }
} // namespace meltfront::verification
