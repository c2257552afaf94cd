#include <cases/error.h>
#include <verification/matrix/directory_lock.h>
#include <verification/matrix/progress.h>
#include <verification/record/hash.h>
#include <verification/record/json_values.h>
#include <verification/record/provenance.h>
#include <verification/studies/crosscheck/crosscheck.h>
#include <verification/studies/crosscheck/scene_generator.h>
#include <verification/studies/crosscheck/verdict_record.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    namespace fs = std::filesystem;

    std::vector<std::string> names_of(const std::vector<const cases::Method *> &methods)
    {
      std::vector<std::string> names;
      for(const cases::Method *method : methods)
        names.push_back(method->name());
      return names;
    }

    /** The methods of a contradiction. */
    std::vector<const cases::Method *>
    those_that_state(const Contradiction &contradiction,
                     const std::vector<const cases::Method *> &methods)
    {
      std::vector<const cases::Method *> result;
      for(const cases::Method *method : methods)
        if(std::ranges::any_of(contradiction.statements, [&](const Statement &s)
                               { return s.method == method->name(); }))
          result.push_back(method);
      return result;
    }

    class Crosscheck
    {
    public:
      Crosscheck(const CrosscheckSettings &given, const CaseReader &read,
                 const SceneMaking &make)
        : settings(given)
        , read(read)
        , make(make)
      {
        if(settings.methods.size() < 2)
          throw cases::InputError("crosscheck needs two methods or more: one has nobody "
                                  "to contradict it");
        if(settings.jobs <= 0)
          settings.jobs
              = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
        if(settings.program_hash.empty())
          settings.program_hash = verification::program_hash();
      }

      nlohmann::json run()
      {
        for(const char *folder : {"scenes", "suspects"})
          make_folder(path(folder));
        const DirectoryLock lock(settings.directory);
        std::vector<int> waiting;
        std::vector<RunKind> kinds;
        for(int index = 0; index < settings.scenes; ++index)
          if(!known(index))
          {
            waiting.push_back(index);
            kinds.push_back(kind_of(index));
          }
        Progress progress(settings.progress, kinds, settings.scenes - waiting.size(), 1);
        for(const int index : waiting)
          check(index, progress);
        const nlohmann::json summary = summarised();
        write_json(path("summary.json"), summary);
        return summary;
      }

    private:
      std::string path(const std::string &name) const
      {
        return settings.directory + "/" + name;
      }

      std::string name_of(int index) const
      {
        return scene_name(settings.seed, index);
      }

      RunKind kind_of(int index) const
      {
        return {name_of(index), "", "", 1};
      }

      std::string verdict_file(int index) const
      {
        return path("scenes/" + name_of(index) + ".json");
      }

      static void make_folder(const std::string &folder)
      {
        std::error_code error;
        fs::create_directories(folder, error);
        if(error)
          throw cases::OutputError(
              fmt::format("cannot make the directory {}: {}", folder, error.message()));
      }

      /** What a verdict depends on. */
      nlohmann::json conditions(const SceneDraft &draft) const
      {
        return {{"program_version", settings.program_version},
                {"program_hash", settings.program_hash},
                {"text_hash", sha256(draft.text())},
                {"methods", names_of(settings.methods)},
                {"within", settings.within}};
      }

      bool known(int index) const
      {
        if(!fs::exists(verdict_file(index)))
          return false;
        try
        {
          return read_json(verdict_file(index)).at("conditions")
                 == conditions(make(settings.seed, index, settings.dimension));
        }
        catch(const std::exception &)
        {
          // Not a verdict as this program writes it: it is made anew.
          return false;
        }
      }

      LevelLimits limits(Progress *progress, const std::string &scene) const
      {
        LevelLimits result{settings.jobs, settings.within};
        if(progress)
          result.show = [progress, scene](const std::string &running)
          { progress->show_running(scene + ": " + running); };
        return result;
      }

      void check(int index, Progress &progress)
      {
        const auto start = std::chrono::steady_clock::now();
        const std::string name = name_of(index);
        const std::string file = path("scenes/" + name + ".prm");
        const SceneDraft draft = make(settings.seed, index, settings.dimension);
        write_atomically(file, draft.text());
        SceneVerdict verdict;
        try
        {
          verdict = check_scene(read(draft.text(), file), settings.methods,
                                limits(&progress, name));
        }
        catch(const cases::InputError &error)
        {
          verdict.outcome = SceneOutcome::failed;
          verdict.failures.push_back({"scene generator", 0, error.what()});
        }
        const std::string kept = path("suspects/" + name + ".prm");
        fs::remove(kept);
        if(verdict.contradiction)
          keep_smallest(draft, *verdict.contradiction, kept, progress);
        write_json(verdict_file(index), {{"scene", name},
                                         {"conditions", conditions(draft)},
                                         {"verdict", json_of(verdict)}});
        const std::chrono::duration<double> spent
            = std::chrono::steady_clock::now() - start;
        progress.run_ended(kind_of(index), spent.count(), name, said_of(verdict),
                           verdict.outcome == SceneOutcome::agreed
                               || verdict.outcome == SceneOutcome::refused);
      }

      /** Write the smallest scene in which one of the same methods contradicts. */
      void keep_smallest(const SceneDraft &draft, const Contradiction &contradiction,
                         const std::string &file, Progress &progress)
      {
        const auto methods = those_that_state(contradiction, settings.methods);
        Contradiction smallest = contradiction;
        const auto shows = [&](const SceneDraft &candidate)
        {
          const SceneVerdict verdict = check_scene(read(candidate.text(), file), methods,
                                                   limits(&progress, "shrinking"));
          if(!verdict.contradiction
             || !std::ranges::includes(contradiction.suspects,
                                       verdict.contradiction->suspects))
            return false;
          smallest = *verdict.contradiction;
          return true;
        };
        const SceneDraft result = shrunk(draft, shows, settings.shrink);
        write_atomically(file, result.text(said_of(smallest)));
      }

      nlohmann::json summarised() const
      {
        SummaryOfVerdicts summary;
        for(int index = 0; index < settings.scenes; ++index)
          summary.add(name_of(index), read_json(verdict_file(index)).at("verdict"));
        nlohmann::json json = summary.json();
        json["seed"] = settings.seed;
        json["dimension"] = settings.dimension;
        json["program_version"] = settings.program_version;
        return json;
      }

      CrosscheckSettings settings;
      const CaseReader &read;
      const SceneMaking &make;
    };
  } // namespace

  nlohmann::json crosscheck(const CrosscheckSettings &settings, const CaseReader &read,
                            const SceneMaking &make)
  {
    return Crosscheck(settings, read, make).run();
  }
} // namespace meltfront::verification
