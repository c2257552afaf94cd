#include <cases/error.h>
#include <verification/record/json_values.h>
#include <verification/record/run_record.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;
    using verification::json_of;

    cases::Effect effect_named(const std::string &name)
    {
      for(const cases::Effect effect : cases::all_effects())
        if(name == cases::to_string(effect))
          return effect;
      throw cases::InputError(fmt::format("there is no effect '{}'", name));
    }

    RunStatus status_named(const std::string &name)
    {
      for(const RunStatus status :
          {RunStatus::finished, RunStatus::refused, RunStatus::failed})
        if(name == to_string(status))
          return status;
      throw cases::InputError(fmt::format("a run cannot have the status '{}'", name));
    }

    json json_of(const cases::RunDescription &description)
    {
      json parameters = json::array();
      for(const cases::Parameter &p : description.parameters)
        parameters.push_back({{"name", p.name}, {"value", p.value}, {"unit", p.unit}});
      return {{"dimension", description.dimension},
              {"spacing", json_of(description.spacing)},
              {"smoothing_length", json_of(description.smoothing_length)},
              {"time_step", json_of(description.time_step)},
              {"unknowns", description.unknowns},
              {"parameters", parameters}};
    }

    cases::RunDescription description_in(const json &json)
    {
      cases::RunDescription description;
      description.dimension = json.at("dimension");
      description.spacing = number_in(json.at("spacing"));
      description.smoothing_length = number_in(json.at("smoothing_length"));
      description.time_step = number_in(json.at("time_step"));
      description.unknowns = json.at("unknowns");
      for(const auto &p : json.at("parameters"))
        description.parameters.push_back({p.at("name"), p.at("value"), p.at("unit")});
      return description;
    }

    json json_of(const std::vector<cases::EffectDecision> &decisions)
    {
      json list = json::array();
      for(const cases::EffectDecision &decision : decisions)
        list.push_back({{"effect", cases::to_string(decision.effect)},
                        {"on", decision.on},
                        {"reason", decision.reason}});
      return list;
    }

    std::vector<cases::EffectDecision> decisions_in(const json &json)
    {
      std::vector<cases::EffectDecision> decisions;
      for(const auto &d : json)
        decisions.push_back({effect_named(d.at("effect")), d.at("on"), d.at("reason")});
      return decisions;
    }

    json json_of(const cases::Cost &cost)
    {
      json effects = json::array();
      for(const cases::EffectCost &effect : cost.effects)
        effects.push_back({{"effect", cases::to_string(effect.effect)},
                           {"calls", effect.calls},
                           {"bytes", effect.bytes},
                           {"seconds", json_of(effect.seconds)}});
      return {{"setup_wall", json_of(cost.setup_wall)},
              {"setup_cpu", json_of(cost.setup_cpu)},
              {"stepping_wall", json_of(cost.stepping_wall)},
              {"stepping_cpu", json_of(cost.stepping_cpu)},
              {"steps", cost.steps},
              {"unknowns", cost.unknowns},
              {"work", cost.work},
              {"solver_iterations", cost.solver_iterations},
              {"most_iterations", cost.most_iterations},
              {"capped_steps", cost.capped_steps},
              {"effects", effects},
              {"evidence", json_of(cost.evidence)}};
    }

    cases::Cost cost_in(const json &json)
    {
      cases::Cost cost;
      cost.setup_wall = number_in(json.at("setup_wall"));
      cost.setup_cpu = number_in(json.at("setup_cpu"));
      cost.stepping_wall = number_in(json.at("stepping_wall"));
      cost.stepping_cpu = number_in(json.at("stepping_cpu"));
      cost.steps = json.at("steps");
      cost.unknowns = json.at("unknowns");
      cost.work = json.at("work");
      cost.solver_iterations = json.at("solver_iterations");
      cost.most_iterations = json.value("most_iterations", 0L);
      cost.capped_steps = json.at("capped_steps");
      cost.evidence = named_numbers_in(json.value("evidence", nlohmann::json::object()));
      for(const auto &effect : json.at("effects"))
        cost.effects.push_back({effect_named(effect.at("effect")), effect.at("calls"),
                                effect.at("bytes"), number_in(effect.at("seconds"))});
      return cost;
    }

    json json_of(const std::vector<FrontFrame> &frames)
    {
      json list = json::array();
      for(const FrontFrame &frame : frames)
        list.push_back({{"time", json_of(frame.time)},
                        {"x", json_of(frame.x)},
                        {"y", json_of(frame.y)}});
      return list;
    }

    json json_of(const std::vector<ParticleFrame> &frames)
    {
      json list = json::array();
      for(const ParticleFrame &frame : frames)
        list.push_back({{"time", json_of(frame.time)},
                        {"step", frame.step},
                        {"x", json_of(frame.x)},
                        {"y", json_of(frame.y)},
                        {"velocity_x", json_of(frame.velocity_x)},
                        {"velocity_y", json_of(frame.velocity_y)},
                        {"solid", json_of(frame.solid)}});
      return list;
    }

    std::vector<ParticleFrame> particle_frames_in(const json &json)
    {
      std::vector<ParticleFrame> frames;
      for(const auto &frame : json)
        frames.push_back(
            {number_in(frame.at("time")), frame.at("step"), numbers_in(frame.at("x")),
             numbers_in(frame.at("y")), numbers_in(frame.at("velocity_x")),
             numbers_in(frame.at("velocity_y")), numbers_in(frame.at("solid"))});
      return frames;
    }

    std::vector<FrontFrame> frames_in(const json &json)
    {
      std::vector<FrontFrame> frames;
      for(const auto &frame : json)
        frames.push_back({number_in(frame.at("time")), numbers_in(frame.at("x")),
                          numbers_in(frame.at("y"))});
      return frames;
    }

    json json_of(const std::vector<RunEvent> &events)
    {
      json list = json::array();
      for(const RunEvent &event : events)
        list.push_back({{"time", json_of(event.time)}, {"what", event.what}});
      return list;
    }

    std::vector<RunEvent> events_in(const json &json)
    {
      std::vector<RunEvent> events;
      for(const auto &event : json)
        events.push_back({number_in(event.at("time")), event.at("what")});
      return events;
    }

    json json_of(const std::vector<Check> &checks)
    {
      json list = json::array();
      for(const Check &check : checks)
        list.push_back({{"name", check.name},
                        {"value", json_of(check.value)},
                        {"bound", json_of(check.bound)},
                        {"passed", check.passed}});
      return list;
    }

    std::vector<Check> checks_in(const json &json)
    {
      std::vector<Check> checks;
      for(const auto &check : json)
        checks.push_back({check.at("name"), number_in(check.at("value")),
                          number_in(check.at("bound")), check.at("passed")});
      return checks;
    }

    /** A list that records of runs made before it was kept lack. */
    json list_in(const json &json, const char *name)
    {
      return json.value(name, json::array());
    }

    /** Calls visit(name, member) for each member of the series or the profile. */
    template <typename Series, typename Visit>
    void visit_series(Series &series, const Visit &visit)
    {
      visit("time", series.time);
      visit("front", series.front);
      visit("front_isotherm", series.front_isotherm);
      visit("front_exact", series.front_exact);
      visit("solid_volume", series.solid_volume);
      visit("budget_defect", series.budget_defect);
      visit("temperature_min", series.temperature_min);
      visit("temperature_max", series.temperature_max);
    }

    template <typename Profile, typename Visit>
    void visit_profile(Profile &profile, const Visit &visit)
    {
      visit("coordinate", profile.coordinate);
      visit("temperature", profile.temperature);
      visit("solid_fraction", profile.solid_fraction);
      visit("temperature_exact", profile.temperature_exact);
      visit("concentration", profile.concentration);
      visit("concentration_exact", profile.concentration_exact);
      visit("solid_fraction_exact", profile.solid_fraction_exact);
      visit("picture_x", profile.picture_x);
      visit("picture_y", profile.picture_y);
      visit("picture_solid_fraction", profile.picture_solid_fraction);
      visit("picture_temperature", profile.picture_temperature);
    }

    json json_of(const RunProfile &profile)
    {
      json result = {{"time", json_of(profile.time)}};
      visit_profile(profile, [&](const char *name, const std::vector<double> &values)
                    { result[name] = json_of(values); });
      return result;
    }

    RunProfile profile_in(const json &json)
    {
      RunProfile profile;
      profile.time = number_in(json.at("time"));
      visit_profile(profile, [&](const char *name, std::vector<double> &values)
                    { values = numbers_in(list_in(json, name)); });
      return profile;
    }

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
    json["case"] = record.case_name;
    json["method"] = record.method;
    json["label"] = record.label;
    json["n"] = record.n;
    json["seed"] = record.seed;
    json["threads"] = record.threads;
    json["options"] = record.options;
    json["status"] = to_string(record.status);
    json["message"] = record.message;
    json["description"] = json_of(record.description);
    json["effects"] = json_of(record.effects);
    json["cost"] = json_of(record.cost);
    json["peak_memory_mb"] = json_of(record.peak_memory_mb);
    json["repeats"] = record.repeats;
    json["quantities"] = json_of(record.quantities);
    auto &series = json["series"];
    visit_series(record.series, [&](const char *name, const std::vector<double> &values)
                 { series[name] = json_of(values); });
    json["profile"] = json_of(record.profile);
    json["mark_profiles"] = nlohmann::json::array();
    for(const RunProfile &profile : record.mark_profiles)
      json["mark_profiles"].push_back(json_of(profile));
    json["frames"] = json_of(record.frames);
    if(!record.particle_frames.empty())
      json["particle_frames"] = json_of(record.particle_frames);
    if(!record.animation.empty())
      json["animation"] = json_of(record.animation);
    json["events"] = json_of(record.events);
    json["checks"] = json_of(record.checks);
    json["unchecked"] = record.unchecked;
    json["provenance"] = record.provenance;
  }

  void from_json(const nlohmann::json &json, RunRecord &record)
  {
    record = {};
    record.case_name = json.at("case");
    record.method = json.at("method");
    record.label = json.at("label");
    record.n = json.at("n");
    record.seed = json.at("seed");
    record.threads = json.at("threads");
    json.at("options").get_to(record.options);
    record.status = status_named(json.at("status"));
    record.message = json.at("message");
    record.description = description_in(json.at("description"));
    record.effects = decisions_in(json.at("effects"));
    record.cost = cost_in(json.at("cost"));
    record.peak_memory_mb = number_in(json.at("peak_memory_mb"));
    record.repeats = json.at("repeats");
    record.quantities = named_numbers_in(json.at("quantities"));
    visit_series(record.series, [&](const char *name, std::vector<double> &values)
                 { values = numbers_in(list_in(json.at("series"), name)); });
    record.profile = profile_in(json.at("profile"));
    for(const auto &profile : list_in(json, "mark_profiles"))
      record.mark_profiles.push_back(profile_in(profile));
    record.frames = frames_in(list_in(json, "frames"));
    record.particle_frames = particle_frames_in(list_in(json, "particle_frames"));
    record.animation = particle_frames_in(list_in(json, "animation"));
    record.events = events_in(list_in(json, "events"));
    record.checks = checks_in(list_in(json, "checks"));
    record.unchecked = json.value("unchecked", record.unchecked);
    json.at("provenance").get_to(record.provenance);
  }
} // namespace meltfront::verification
