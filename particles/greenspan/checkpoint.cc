#include <cases/error.h>
#include <particles/greenspan/checkpoint.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <functional>

namespace meltfront::particles::greenspan
{
  namespace
  {
    using nlohmann::json;

    /** Calls visit(name, member) for each member that a step changes. */
    template <typename State, typename Visit>
    void visit_state(State &state, const Visit &visit)
    {
      visit("dimension", state.dimension);
      visit("step", state.step);
      visit("staggered", state.staggered);
      visit("position", state.position);
      visit("velocity", state.velocity);
      visit("kinetic_sum", state.kinetic_sum);
    }

    template <typename Record, typename Visit>
    void visit_record(Record &record, const Visit &visit)
    {
      visit("first_break", record.first_break);
      visit("first_fluid", record.first_fluid);
      visit("unheated", record.unheated);
      visit("all_fluid", record.all_fluid);
      visit("solid", record.solid);
      visit("least_solid", record.least_solid);
      visit("highest_y", record.highest_y);
    }

    template <typename Object, typename VisitAll>
    json json_of(const Object &object, const VisitAll &visit_all)
    {
      json result;
      visit_all(object,
                [&](const char *name, const auto &value) { result[name] = value; });
      return result;
    }

    json json_of(const Checkpoint &checkpoint)
    {
      const auto state
          = [](const auto &object, const auto &visit) { visit_state(object, visit); };
      const auto record
          = [](const auto &object, const auto &visit) { visit_record(object, visit); };
      json result{{"run", checkpoint.run},
                  {"state", json_of(checkpoint.state, state)},
                  {"record", json_of(checkpoint.memory.record, record)},
                  {"positions", checkpoint.memory.positions},
                  {"last_solid", checkpoint.memory.last_solid},
                  {"initial_energy", checkpoint.initial_energy},
                  {"energy_error", checkpoint.energy_error}};
      for(const RunRecord::Corner &corner : checkpoint.memory.record.corners)
        result["corners"].push_back({corner.step, corner.temperature});
      return result;
    }

    Checkpoint checkpoint_in(const json &source)
    {
      const auto take = [](const json &from)
      { return [&from](const char *name, auto &value) { from.at(name).get_to(value); }; };
      Checkpoint checkpoint;
      source.at("run").get_to(checkpoint.run);
      visit_state(checkpoint.state, take(source.at("state")));
      visit_record(checkpoint.memory.record, take(source.at("record")));
      source.at("positions").get_to(checkpoint.memory.positions);
      source.at("last_solid").get_to(checkpoint.memory.last_solid);
      source.at("initial_energy").get_to(checkpoint.initial_energy);
      source.at("energy_error").get_to(checkpoint.energy_error);
      for(const auto &corner : source.value("corners", json::array()))
        checkpoint.memory.record.corners.push_back({corner.at(0), corner.at(1)});
      return checkpoint;
    }

    /** The bits of all values, so that no two starts look alike. */
    std::size_t hash_of(const std::array<std::vector<double>, 3> &arrays)
    {
      std::size_t hash = 0;
      for(const std::vector<double> &values : arrays)
        for(const double value : values)
          hash = 31 * hash + std::hash<double>()(value);
      return hash;
    }
  } // namespace

  std::string run_fingerprint(const Experiment &experiment)
  {
    const MotionParameters &p = experiment.parameters;
    std::string text = fmt::format(
        "{} {} {} {} {} {} {} {} {} {} {} {} {}", experiment.name, experiment.steps,
        experiment.interval, static_cast<int>(experiment.test), p.force.attraction,
        p.force.repulsion, p.force.attraction_exponent, p.force.repulsion_exponent,
        p.force.cutoff, p.force.shifted, p.time_step, p.gravity, p.drag);
    if(p.base)
      text += fmt::format(" base {} {} {} {}", p.base->restitution,
                          p.base->hot_half_width, p.base->hot_left, p.base->hot_slope);
    if(p.source)
    {
      text += fmt::format(" source {} {} {}", fmt::join(p.source->position, " "),
                          p.source->power, p.source->reach);
      for(const HeatStage &stage : p.source->stages)
        text += fmt::format(" {} x {}", stage.steps, stage.strength);
    }
    text += fmt::format(" corners {}", fmt::join(experiment.corners, " "));
    return text
           + fmt::format(" start {} {} {}", experiment.start.size(),
                         hash_of(experiment.start.position),
                         hash_of(experiment.start.velocity));
  }

  void write_checkpoint(const std::string &path, const Checkpoint &checkpoint)
  {
    const std::vector<std::uint8_t> bytes = json::to_cbor(json_of(checkpoint));
    const std::string temporary = path + ".part";
    {
      std::ofstream file(temporary, std::ios::binary);
      file.write(reinterpret_cast<const char *>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
      if(!file.flush())
        throw cases::OutputError(
            fmt::format("{}: the checkpoint cannot be written", temporary));
    }
    std::error_code failure;
    std::filesystem::rename(temporary, path, failure);
    if(failure)
      throw cases::OutputError(fmt::format(
          "{}: the checkpoint cannot be put in its place: {}", path, failure.message()));
  }

  std::optional<Checkpoint> read_checkpoint(const std::string &path,
                                            const Experiment &experiment)
  {
    std::ifstream file(path, std::ios::binary);
    if(!file)
      return {};
    Checkpoint checkpoint;
    try
    {
      checkpoint = checkpoint_in(json::from_cbor(file));
    }
    catch(const json::exception &)
    {
      throw cases::InputError(fmt::format("{}: is no checkpoint of a particle solid; "
                                          "remove it to start anew",
                                          path));
    }
    if(checkpoint.run != run_fingerprint(experiment))
      throw cases::InputError(fmt::format("{}: is the checkpoint of another run; name "
                                          "another file, or remove it to start anew",
                                          path));
    return checkpoint;
  }
} // namespace meltfront::particles::greenspan
