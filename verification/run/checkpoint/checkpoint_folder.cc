#include <verification/run/checkpoint/checkpoint_folder.h>

#include <cases/error.h>
#include <verification/record/hash.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    /** Of state.bin: one line of JSON, then the state. */
    constexpr int format = 1;
  } // namespace

  CheckpointFolder::CheckpointFolder(std::string path)
    : path(std::move(path))
  {
  }

  CheckpointFolder CheckpointFolder::in(const std::string &directory)
  {
    return CheckpointFolder(directory + "/checkpoint");
  }

  bool CheckpointFolder::holds_run() const
  {
    return std::filesystem::exists(path + "/request.json");
  }

  std::string CheckpointFolder::observations() const
  {
    return path + "/observed.bin";
  }

  void CheckpointFolder::begin(const nlohmann::json &request) const
  {
    if(last())
      throw cases::InputError(fmt::format(
          "{} holds the checkpoint of a run that has not ended: go on with it by "
          "`meltfront run --resume {}`, or remove {}",
          path, std::filesystem::path(path).parent_path().string(), path));
    remove();
    if(!request.is_null())
      write_json(path + "/request.json", request);
  }

  nlohmann::json CheckpointFolder::request(const nlohmann::json &program) const
  {
    if(!holds_run())
      throw cases::InputError(
          fmt::format("{} holds no run to resume: runs with checkpoints (option "
                      "`checkpoint`) leave one there until they have ended",
                      path));
    nlohmann::json result;
    try
    {
      result = read_json(path + "/request.json");
    }
    catch(const cases::OutputError &damaged)
    {
      throw cases::InputError(damaged.what());
    }
    const auto damaged_unless = [&](bool sound)
    {
      if(!sound)
        throw cases::InputError(
            fmt::format("{}/request.json is damaged: it does not hold what was asked for "
                        "and by which program",
                        path));
    };
    damaged_unless(result.is_object());
    const nlohmann::json before = result.value("program", nlohmann::json::object());
    damaged_unless(before.is_object());
    for(const auto &[name, value] : program.items())
      if(before.value(name, nlohmann::json()) != value)
        throw cases::InputError(fmt::format(
            "{} is of another build of the program, whose results may differ ({}: {} "
            "there, {} here): run the case anew",
            path, name, before.value(name, nlohmann::json()).dump(), value.dump()));
    return result;
  }

  std::string CheckpointFolder::request_hash() const
  {
    return sha256_of_file(path + "/request.json");
  }

  void CheckpointFolder::write(const Checkpoint &checkpoint) const
  {
    const nlohmann::json header{{"format", format},
                                {"request", request_hash()},
                                {"step", checkpoint.step},
                                {"time", json_of(checkpoint.time)},
                                {"observed_bytes", checkpoint.observed_bytes},
                                {"kept", checkpoint.kept},
                                {"resumptions", checkpoint.resumptions},
                                {"state_hash", sha256(checkpoint.state)}};
    write_atomically(path + "/state.bin", header.dump() + '\n' + checkpoint.state);
  }

  std::optional<Checkpoint> CheckpointFolder::last() const
  {
    const std::string file = path + "/state.bin";
    if(!holds_run() || !std::filesystem::exists(file))
      return {};
    const auto damaged = [&file](const std::string &how)
    { return cases::InputError(fmt::format("{} {}: run the case anew", file, how)); };
    std::ifstream in(file, std::ios::binary);
    std::string line;
    std::getline(in, line);
    Checkpoint result;
    result.state.assign(std::istreambuf_iterator<char>(in), {});
    try
    {
      const nlohmann::json header = nlohmann::json::parse(line);
      if(header.at("format") != format)
        throw damaged("is a checkpoint of another version of the program");
      if(header.at("request") != request_hash())
        throw damaged("is the checkpoint of another run than request.json beside it");
      if(header.at("state_hash") != sha256(result.state))
        throw damaged("is damaged or cut off");
      result.step = whole_number_in<long>(header.at("step"));
      result.time = number_in(header.at("time"));
      result.observed_bytes
          = whole_number_in<std::uintmax_t>(header.at("observed_bytes"));
      result.kept = whole_number_in<long>(header.at("kept"));
      result.resumptions = whole_number_in<int>(header.at("resumptions"));
    }
    catch(const nlohmann::json::exception &)
    {
      throw damaged("is no checkpoint");
    }
    std::error_code failure;
    if(std::filesystem::file_size(observations(), failure) < result.observed_bytes
       || failure)
      throw cases::InputError(
          fmt::format("{} is cut off: run the case anew", observations()));
    return result;
  }

  void CheckpointFolder::remove() const
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
} // namespace meltfront::verification
