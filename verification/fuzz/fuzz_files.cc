// Reads mutated case, matrix, record and checkpoint files, and says which of them the
// program does not answer with a value or a sentence.
//   fuzz_files [COUNT [SEED [KIND]]]   COUNT texts of each kind (1000), from SEED on (1)
#include <cases/case_file/case_file.h>
#include <cases/data_folder.h>
#include <cases/effects.h>
#include <cases/error.h>
#include <verification/app/methods.h>
#include <verification/fuzz/trials.h>
#include <verification/matrix/matrix_file.h>
#include <verification/record/json_values.h>
#include <verification/record/run_record.h>
#include <verification/record/temporary_directory.h>
#include <verification/run/checkpoint/checkpoint_keeper.h>
#include <verification/run/run_one.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace meltfront::verification
{
  namespace
  {
    std::string text_of_file(const std::string &path)
    {
      std::ifstream in(path, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    void write(const std::string &path, const std::string &text)
    {
      std::ofstream(path, std::ios::binary) << text;
    }

    /** A case, and what every method says to it before it runs. */
    FileKind case_files()
    {
      FileKind kind{"case", {}, {}};
      for(const std::string &name : cases::library_names())
        if(std::string text = text_of_file(cases::library_path(name)); !text.empty())
          kind.originals.push_back(std::move(text));
      kind.read = [](const std::string &text)
      {
        const cases::Case c = cases::read_case_text(text, "mutated.prm");
        const cases::EffectSet effects = cases::effects_called_for(c.scene);
        const cases::Scene scene = cases::simulated_scene(c.scene, effects);
        for(const auto &method : methods())
          try
          {
            const cases::Options options(method->option_declarations());
            cases::require_capable(*method, scene, effects, 1, options);
            method->demand(scene, effects, {20, options, 1, 1});
          }
          catch(const cases::Refusal &)
          {
          }
      };
      return kind;
    }

    FileKind matrix_files()
    {
      FileKind kind{"matrix", {}, {}};
      for(const std::string &name : matrix_names())
        kind.originals.push_back(text_of_file(
            cases::data_path(fmt::format("verification/matrix/library/{}.prm", name))));
      kind.read = [](const std::string &text) { read_matrix_text(text, "mutated.prm"); };
      return kind;
    }

    /** A small run of each of two methods. */
    std::vector<RunRecord> some_records(const CheckpointFolder *folder)
    {
      std::vector<RunRecord> result;
      const cases::Case c = cases::load_case("plane-freezing-started");
      for(const char *name : {"sph", "fem-enthalpy"})
      {
        const cases::Method &method = method_named(name);
        cases::Resolution resolution{10, cases::Options(method.option_declarations()), 1,
                                     1};
        if(folder && method.name() != "fem-enthalpy")
          continue;
        if(folder)
          resolution.options.set("checkpoint", "1e-9");
        RepeatPolicy once;
        once.most = 1;
        std::map<std::string, double> evidence;
        const auto keep
            = [&](cases::Observer &observer) -> std::unique_ptr<cases::Observer>
        {
          if(!folder)
            return nullptr;
          return std::make_unique<CheckpointKeeper>(*folder, 1e-9, observer, evidence);
        };
        result.push_back(run_one(c, method, resolution, name, {}, nullptr, once, keep));
      }
      return result;
    }

    FileKind record_files()
    {
      FileKind kind{"record", {}, {}};
      for(const RunRecord &record : some_records(nullptr))
        kind.originals.push_back(nlohmann::json(record).dump(1));
      kind.read = [](const std::string &text)
      {
        try
        {
          nlohmann::json::parse(text).get<RunRecord>();
        }
        catch(const nlohmann::json::exception &error)
        {
          throw cases::OutputError(error.what()); // as those who read files do
        }
      };
      return kind;
    }

    struct Nobody : cases::Observer
    {
      bool wants(long, double) override
      {
        return false;
      }
      void observe(const cases::Snapshot &) override
      {
      }
    };

    /** @param file of the folder whose text is mutated */
    FileKind checkpoint_files(const std::string &directory, const std::string &file)
    {
      const std::string whole = directory + "/checkpoint/" + file;
      FileKind kind{"checkpoint " + file, {text_of_file(whole)}, {}};
      kind.read = [=](const std::string &text)
      {
        write(whole, text);
        const CheckpointFolder folder = CheckpointFolder::in(directory);
        folder.request({});
        Nobody nobody;
        if(const auto last = folder.last())
          ObservationLog::tell(folder.observations(), last->observed_bytes, nobody);
      };
      return kind;
    }

    int fuzz(unsigned long count, unsigned long seed, const std::string &only)
    {
      const TemporaryDirectory scratch;
      const std::string directory = scratch.path().string();
      const CheckpointFolder folder = CheckpointFolder::in(directory);
      folder.begin({{"case", "plane-freezing-started"}});
      some_records(&folder);
      std::vector<FileKind> kinds{case_files(), matrix_files(), record_files()};
      const auto unharmed = [&](const std::string &file)
      { return text_of_file(directory + "/checkpoint/" + file); };
      int found = 0;
      const auto try_kind = [&](const FileKind &kind)
      {
        if(!only.empty() && kind.name.find(only) == std::string::npos)
          return;
        for(const Offence &offence : offences(kind, seed, count))
        {
          const std::string file
              = fmt::format("mutated-{}-{}", offence.kind, offence.seed);
          write(file, offence.text);
          fmt::print("{} {}: {} (written to {})\n", offence.kind, offence.seed,
                     offence.what, file);
          ++found;
        }
        fmt::print("{}: {} texts read\n", kind.name, count);
        std::fflush(stdout);
      };
      for(const FileKind &kind : kinds)
        try_kind(kind);
      for(const char *file : {"state.bin", "observed.bin", "request.json"})
      {
        const std::string text = unharmed(file);
        try_kind(checkpoint_files(directory, file));
        write(directory + "/checkpoint/" + file, text);
      }
      return found == 0 ? 0 : 1;
    }
  } // namespace
} // namespace meltfront::verification

int main(int argc, char **argv)
{
  try
  {
    return meltfront::verification::fuzz(
        argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1000,
        argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1, argc > 3 ? argv[3] : "");
  }
  catch(const std::exception &error)
  {
    fmt::print(stderr, "fuzz_files: {}\n", error.what());
    return 1;
  }
}
