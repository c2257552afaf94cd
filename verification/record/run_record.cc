#include <cases/error.h>
#include <verification/record/json_fields.h>
#include <verification/record/run_record.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  using enum Presence;

  template <>
  void read_stored(const nlohmann::json &json, cases::Effect &value)
  {
    const std::string name = json;
    for(const cases::Effect effect : cases::all_effects())
      if(name == cases::to_string(effect))
      {
        value = effect;
        return;
      }
    throw cases::InputError(fmt::format("there is no effect '{}'", name));
  }

  template <>
  void read_stored(const nlohmann::json &json, RunStatus &value)
  {
    const std::string name = json;
    for(const RunStatus status :
        {RunStatus::finished, RunStatus::refused, RunStatus::failed})
      if(name == to_string(status))
      {
        value = status;
        return;
      }
    throw cases::InputError(fmt::format("a run cannot have the status '{}'", name));
  }

  void fields(const auto &visit, Like<cases::Parameter> auto &parameter)
  {
    visit("name", parameter.name);
    visit("value", parameter.value);
    visit("unit", parameter.unit);
  }

  void fields(const auto &visit, Like<cases::RunDescription> auto &description)
  {
    visit("dimension", description.dimension);
    visit("spacing", description.spacing);
    visit("smoothing_length", description.smoothing_length);
    visit("time_step", description.time_step);
    visit("unknowns", description.unknowns);
    visit("parameters", description.parameters);
  }

  void fields(const auto &visit, Like<cases::EffectDecision> auto &decision)
  {
    visit("effect", decision.effect);
    visit("on", decision.on);
    visit("reason", decision.reason);
  }

  void fields(const auto &visit, Like<cases::EffectCost> auto &cost)
  {
    visit("effect", cost.effect);
    visit("calls", cost.calls);
    visit("bytes", cost.bytes);
    visit("seconds", cost.seconds);
  }

  void fields(const auto &visit, Like<cases::Cost> auto &cost)
  {
    visit("setup_wall", cost.setup_wall);
    visit("setup_cpu", cost.setup_cpu);
    visit("stepping_wall", cost.stepping_wall);
    visit("stepping_cpu", cost.stepping_cpu);
    visit("steps", cost.steps);
    visit("unknowns", cost.unknowns);
    visit("work", cost.work);
    visit("solver_iterations", cost.solver_iterations);
    visit("most_iterations", cost.most_iterations, since_later);
    visit("capped_steps", cost.capped_steps);
    visit("effects", cost.effects);
    visit("evidence", cost.evidence, since_later);
  }

  void fields(const auto &visit, Like<FrontFrame> auto &frame)
  {
    visit("time", frame.time);
    visit("x", frame.x);
    visit("y", frame.y);
  }

  void fields(const auto &visit, Like<ParticleFrame> auto &frame)
  {
    visit("time", frame.time);
    visit("step", frame.step);
    visit("x", frame.x);
    visit("y", frame.y);
    visit("velocity_x", frame.velocity_x);
    visit("velocity_y", frame.velocity_y);
    visit("solid", frame.solid);
  }

  void fields(const auto &visit, Like<RunEvent> auto &event)
  {
    visit("time", event.time);
    visit("what", event.what);
  }

  void fields(const auto &visit, Like<Check> auto &check)
  {
    visit("name", check.name);
    visit("value", check.value);
    visit("bound", check.bound);
    visit("passed", check.passed);
  }

  void fields(const auto &visit, Like<RunSeries> auto &series)
  {
    visit("time", series.time, since_later);
    visit("front", series.front, since_later);
    visit("front_isotherm", series.front_isotherm, since_later);
    visit("front_exact", series.front_exact, since_later);
    visit("solid_volume", series.solid_volume, since_later);
    visit("heat", series.heat, since_later);
    visit("budget_defect", series.budget_defect, since_later);
    visit("temperature_min", series.temperature_min, since_later);
    visit("temperature_max", series.temperature_max, since_later);
  }

  void fields(const auto &visit, Like<TemperatureProbe> auto &probe)
  {
    visit("coordinate", probe.coordinate);
    visit("place", probe.place);
    visit("temperature", probe.temperature);
    visit("temperature_exact", probe.temperature_exact);
  }

  void fields(const auto &visit, Like<RunProfile> auto &profile)
  {
    visit("time", profile.time);
    visit("coordinate", profile.coordinate, since_later);
    visit("temperature", profile.temperature, since_later);
    visit("solid_fraction", profile.solid_fraction, since_later);
    visit("temperature_exact", profile.temperature_exact, since_later);
    visit("concentration", profile.concentration, since_later);
    visit("concentration_exact", profile.concentration_exact, since_later);
    visit("solid_fraction_exact", profile.solid_fraction_exact, since_later);
    visit("picture_x", profile.picture_x, since_later);
    visit("picture_y", profile.picture_y, since_later);
    visit("picture_solid_fraction", profile.picture_solid_fraction, since_later);
    visit("picture_temperature", profile.picture_temperature, since_later);
  }

  void fields(const auto &visit, Like<RunTimes> auto &times)
  {
    visit("careful", times.careful);
    visit("cpu", times.cpu);
    visit("wall", times.wall);
  }

  void fields(const auto &visit, Like<RunRecord> auto &record)
  {
    visit("case", record.case_name);
    visit("method", record.method);
    visit("label", record.label);
    visit("n", record.n);
    visit("seed", record.seed);
    visit("threads", record.threads);
    visit("options", record.options);
    visit("status", record.status);
    visit("message", record.message);
    visit("description", record.description);
    visit("effects", record.effects);
    visit("cost", record.cost);
    visit("peak_memory_mb", record.peak_memory_mb);
    visit("repeats", record.repeats);
    visit("times", record.times, since_later);
    visit("quantities", record.quantities);
    visit("series", record.series);
    visit("profile", record.profile);
    visit("probes", record.probes, if_any);
    visit("solid_volume_exact", record.solid_volume_exact, since_later);
    visit("heat_exact", record.heat_exact, since_later);
    visit("intermediate_profiles", record.intermediate_profiles, since_later);
    visit("frames", record.frames, since_later);
    visit("particle_frames", record.particle_frames, if_any);
    visit("animation", record.animation, if_any);
    visit("events", record.events, since_later);
    visit("checks", record.checks, since_later);
    visit("unchecked", record.unchecked, since_later);
    visit("provenance", record.provenance);
  }

  namespace
  {
    using nlohmann::json;

    /** The run's row of the convergence table at the top level, for readers of the file;
     * from_json() reads the parts that it is made of. */
    void add_table_row(json &json, const RunRecord &record)
    {
      for(const auto &[name, value] : record.quantities)
        json[name] = json_of(value);
      json["h"] = json_of(record.description.spacing);
      json["unknowns"] = record.cost.unknowns;
      json["steps"] = record.cost.steps;
      json["work"] = record.cost.work;
      json["cpu_seconds"] = json_of(record.cost.setup_cpu + record.cost.stepping_cpu);
      json["wall_seconds"] = json_of(record.cost.setup_wall + record.cost.stepping_wall);
    }
  } // namespace

  const char *to_string(RunStatus status)
  {
    switch(status)
    {
    case RunStatus::finished:
      return "finished";
    case RunStatus::refused:
      return "refused";
    default:
      return "failed";
    }
  }

  void to_json(nlohmann::json &json, const RunRecord &record)
  {
    json = nlohmann::json::object();
    if(record.status == RunStatus::finished)
      add_table_row(json, record);
    fields(JsonFieldWriter{json}, record);
  }

  void from_json(const nlohmann::json &json, RunRecord &record)
  {
    record = {};
    fields(JsonFieldReader{json}, record);
  }
} // namespace meltfront::verification
