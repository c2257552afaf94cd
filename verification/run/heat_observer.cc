#include <cases/error.h>
#include <cases/numbers.h>
#include <verification/measure/checks/unresolved_data.h>
#include <verification/measure/formulas/front_shape.h>
#include <verification/run/end_profile.h>
#include <verification/run/heat_observer.h>
#include <verification/run/temperature_probes.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::nan;
  } // namespace

  HeatObserver::HeatObserver(const cases::Case &c, const cases::Scene &simulated,
                             const std::string &method,
                             const cases::Capabilities &capabilities,
                             cases::Observer *second)
    : RunObserver(c, simulated, method, second)
    , exact(c.exact.get())
    , capabilities(capabilities)
    , intermediate_times(c.measurement.intermediate_times)
  {
    if(!(scene.end_time > scene.start_time))
      throw cases::InputError(fmt::format(
          "{}: the end time {} is not after the start time {}, so that there is "
          "nothing to measure",
          scene.name, scene.end_time, scene.start_time));
    if(samples < ErrorStatistics::fewest_times)
      throw cases::InputError(fmt::format("{}: {} samples are too few for a root mean "
                                          "square over time; take {} or more, or "
                                          "0 for every step",
                                          scene.name, samples,
                                          ErrorStatistics::fewest_times));
  }

  void HeatObserver::start()
  {
    const double spacing = description.spacing;
    const auto or_spacing = [&](double given) { return given > 0 ? given : spacing; };
    for(const std::string &unresolved :
        {unresolved_walls(scene, spacing, or_spacing(description.resolved_width)),
         unresolved_data(scene, or_spacing(description.node_distance))})
      if(!unresolved.empty())
        throw cases::Refusal(unresolved);
    checks.emplace(scene, capabilities, method, description.spacing);
    reader.emplace(scene, exact, description.spacing, description.smoothing_length);
    start_measures(MeasuredScenes::with_heat, nullptr);
  }

  bool HeatObserver::asks_for(long step, double time)
  {
    intermediate_times.pass(step, time);
    return the_case.measurement.samples == 0 || sample_is_due(step, time)
           || intermediate_times.near_one();
  }

  double HeatObserver::exact_front(double time) const
  {
    return exact && time >= exact->start_time() ? exact->front(time) : nan;
  }

  /** Of a scene that is the exact solution's whole domain, at one density. */
  double HeatObserver::exact_heat() const
  {
    const cases::Material &material = scene.material;
    if(!exact || !exact->depends_on_one_coordinate()
       || scene.symmetry == cases::Symmetry::none
       || scene.start_time < exact->start_time()
       || material.solid.density != material.liquid.density)
      return nan;
    const auto [lower, upper] = coordinate_range(scene, exact);
    return exact->heat_content(lower, upper, scene.end_time)
           - exact->heat_content(lower, upper, scene.start_time);
  }

  void HeatObserver::see(Sighting sighting)
  {
    const cases::Snapshot &snapshot = sighting.snapshot;
    checks->judge(snapshot);
    const auto [lowest, highest] = std::ranges::minmax(snapshot.temperature);
    sighting.lowest = lowest;
    sighting.highest = highest;
    sighting.bounds = checks->bounds();
    // Where no phase changes there is no front to read.
    const bool changes_phase = scene.changes_phase();
    const bool one_coordinate = !exact || exact->depends_on_one_coordinate();
    sighting.solid_volume = changes_phase ? solid_volume(snapshot) : nan;
    sighting.front = changes_phase && one_coordinate ? reader->read(snapshot)
                                                     : FrontReading{nan, nan, nan, nan};
    sighting.coordinates = &reader->coordinates(snapshot);
    sighting.exact_front = exact_front(snapshot.time);
    // Steps that are wanted for an intermediate time only would weigh its neighbourhood.
    sighting.front_counts = (sighting.in_series || the_case.measurement.samples == 0)
                            && (!one_coordinate || !std::isnan(sighting.exact_front))
                            && !(snapshot.step == 0 && sighting.exact_front == 0);
    observe_with_all(sighting);
    if(sighting.in_series)
      add_to_series(sighting);
    keep_pictures(sighting);
  }

  void HeatObserver::add_to_series(const Sighting &sighting)
  {
    run_series.time.push_back(sighting.snapshot.time);
    run_series.front.push_back(sighting.front.latent_heat);
    run_series.front_isotherm.push_back(sighting.front.isotherm);
    run_series.solid_volume.push_back(sighting.solid_volume);
    const cases::HeatBudget &heat = sighting.snapshot.heat;
    run_series.heat.push_back(heat.stored + heat.latent - heat.initial);
    run_series.budget_defect.push_back(sighting.snapshot.heat.defect());
    run_series.temperature_min.push_back(sighting.lowest);
    run_series.temperature_max.push_back(sighting.highest);
    if(exact)
      run_series.front_exact.push_back(sighting.exact_front);
  }

  void HeatObserver::keep_pictures(const Sighting &sighting)
  {
    const cases::Snapshot &snapshot = sighting.snapshot;
    const auto profile = [&] {
      return make_end_profile(snapshot, *sighting.coordinates, exact,
                              description.spacing);
    };
    // Marks before the first snapshot with points are not drawn late.
    if(!sighting.intermediate_times.empty())
      keep_front(snapshot);
    for(const int intermediate : sighting.intermediate_times)
      if(scene.alloy || intermediate == the_case.measurement.picture_time)
        profiles.push_back(profile());
    if(!sighting.at_end)
      return;
    end_profile = profile();
    probes
        = read_probes(scene, snapshot, *sighting.coordinates, exact, description.spacing);
    if(exact && scene.changes_phase())
      exact_volume = exact->solid_volume(snapshot.time);
    if(front_frames.empty() || front_frames.back().time < snapshot.time)
      keep_front(snapshot);
  }

  void HeatObserver::keep_course(RunRecord &record) const
  {
    RunObserver::keep_course(record);
    if(!checks)
      return;
    record.checks = checks->checks();
    record.unchecked = checks->unchecked();
  }

  void HeatObserver::keep_results(RunRecord &record) const
  {
    RunObserver::keep_results(record);
    record.profile = end_profile;
    record.probes = probes;
    record.solid_volume_exact = exact_volume;
    record.heat_exact = exact_heat();
    record.intermediate_profiles = profiles;
  }

  Results HeatObserver::quantities() const
  {
    Results values = RunObserver::quantities();
    for(const MeasureKind &kind : measures())
      for(const Quantity &quantity : kind.quantities)
        if(kind.scenes == MeasuredScenes::with_heat && !quantity.from_reference)
          values.try_emplace(quantity.name, nan);
    return values;
  }

  const RunProfile &HeatObserver::profile() const
  {
    return end_profile;
  }
} // namespace meltfront::verification
