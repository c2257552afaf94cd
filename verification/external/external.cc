#include <cases/error.h>
#include <cases/option_binder.h>
#include <cases/run.h>
#include <cases/scene.h>
#include <verification/external/answer.h>
#include <verification/external/command.h>
#include <verification/external/external.h>
#include <verification/external/manifest.h>
#include <verification/external/program.h>
#include <verification/external/protocol.h>
#include <verification/record/hash.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

namespace meltfront::verification
{
  namespace external
  {
    namespace
    {
      using cases::Stopwatch;

      const char *const without_manifest
          = "takes nothing without a manifest, a JSON file that names the program's "
            "command and declares what it takes (verification/external/README.md says "
            "how "
            "to write one): external.manifest=FILE";

      struct ExternalOptions
      {
        std::string command, manifest, options;
        double answer_limit = 1;

        void bind(cases::OptionBinder &binder)
        {
          binder.add("command", command,
                     "Command that starts the program, instead of the manifest's: words "
                     "between blanks, quotes keep blanks, no shell.");
          binder.add("manifest", manifest,
                     "Path of the JSON file that declares what the program takes, or the "
                     "name of an example or a benchmark.");
          binder.add("options", options,
                     "Options of the program, KEY=VALUE with blanks between them.");
          binder.add("answer_limit", answer_limit,
                     "Most that the program may write (GB).", 1e-6, 1000);
        }
      };

      ExternalOptions options_in(const cases::Options &options)
      {
        return options.declarations().empty()
                   ? ExternalOptions()
                   : cases::read_options(ExternalOptions(), options);
      }

      /** What the program is called in messages. */
      std::string name_of(const Manifest &manifest)
      {
        return fmt::format("external ({})", manifest.name);
      }

      std::vector<std::string> command_of(const ExternalOptions &options,
                                          const Manifest &manifest)
      {
        const auto words
            = options.command.empty() ? manifest.command : words_of(options.command);
        if(words.empty())
          throw cases::InputError(
              fmt::format("neither the manifest of '{}' nor external.command=... names a "
                          "command",
                          manifest.name));
        return words;
      }

      /** The manifest's options with the values that a user gives. */
      cases::Options options_of_program(const ExternalOptions &options,
                                        const Manifest &manifest)
      {
        cases::Options result(manifest.options);
        std::istringstream in(options.options);
        for(std::string setting; in >> setting;)
        {
          const std::size_t equals = setting.find('=');
          if(equals == std::string::npos)
            throw cases::InputError(
                fmt::format("external.options holds '{}', which is not of the form "
                            "KEY=VALUE",
                            quoted(setting)));
          result.set(setting.substr(0, equals), setting.substr(equals + 1));
        }
        return result;
      }

      /** The last thing that a program wrote beside its answer; all of it, or its end,
       * goes to the run's log. */
      std::string last_words(const UnnamedFile &messages)
      {
        constexpr double longest = 1 << 16;
        std::ifstream in(messages.path(), std::ios::binary);
        if(messages.bytes() > longest)
          in.seekg(-static_cast<std::streamoff>(longest), std::ios::end);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        std::fputs(text.c_str(), stderr);
        std::istringstream lines(text);
        std::string last;
        for(std::string line; std::getline(lines, line);)
          if(line.find_first_not_of(" \t\r") != std::string::npos)
            last = line;
        return last.empty() ? "" : fmt::format("; it said: {}", quoted(last));
      }

      class ExternalRun : public cases::Run
      {
      public:
        ExternalRun(const cases::Scene &scene, const cases::EffectSet &effects,
                    const cases::Resolution &resolution)
          : scene(scene)
          , effects(effects)
          , resolution(resolution)
          , options(options_in(resolution.options))
          , manifest(read_manifest(manifest_path(options.manifest)))
          , command(command_of(options, manifest))
          , of_program(options_of_program(options, manifest))
        {
        }

        cases::RunDescription describe() const override
        {
          return answer->description();
        }

        cases::Cost cost() const override
        {
          return counted;
        }

      private:
        void take_steps() override
        {
          const bool steady = scene.problem == cases::ProblemKind::poisson;
          const std::vector<double> times
              = steady ? std::vector{scene.end_time} : wanted_times();
          work_elsewhere([&] { return ask(times); });
          for(std::size_t i = 0; i < times.size(); ++i)
            reached(static_cast<long>(i) + (steady ? 1 : 0), times[i]);
          work_elsewhere(
              [this]
              {
                counted = answer->end();
                return Stopwatch::Seconds();
              });
        }

        cases::Snapshot snapshot(long step, double time) override
        {
          const bool steady = scene.problem == cases::ProblemKind::poisson;
          const ToldState &told
              = answer->state(static_cast<std::size_t>(step - (steady ? 1 : 0)));
          cases::Snapshot result;
          result.step = step;
          result.time = time;
          result.dimension = answer->dimension();
          for(int d = 0; d < 3; ++d)
          {
            result.positions[d] = told.positions[d];
            result.front[d] = told.front[d];
          }
          result.weights = told.weights;
          result.temperature = told.temperature;
          result.solid_fraction = told.solid_fraction;
          result.heat = told.heat;
          result.obeys_maximum_principle = manifest.capabilities.overshoot.at_twenty == 0;
          return result;
        }

        /** What keeps the program from being run on this machine; empty for nothing. */
        std::string what_is_missing() const
        try
        {
          find_program(with_folder(command, manifest.folder).front());
          for(const auto &requirement : manifest.requirements)
          {
            const UnnamedFile nothing, answered, messages;
            const auto words = with_folder(requirement, manifest.folder);
            const ProgramEnd end
                = run_program(words, nothing, answered, messages, false, most_bytes());
            const std::string said = last_words(messages);
            if(end.too_much || !end.problem().empty())
              return fmt::format("'{}' {}{}", fmt::join(words, " "),
                                 end.too_much ? "does not end" : end.problem(), said);
          }
          return {};
        }
        catch(const cases::Refusal &refusal)
        {
          return refusal.what();
        }

        double most_bytes() const
        {
          return 1e9 * options.answer_limit;
        }

        /** Ask for states at these times, and read how the answer begins. */
        Stopwatch::Seconds ask(const std::vector<double> &times)
        try
        {
          if(const std::string missing = what_is_missing(); !missing.empty())
            throw cases::Refusal(fmt::format("{} is left out on this machine: {}",
                                             name_of(manifest), missing));
          const nlohmann::json question = request_json(
              scene, effects, resolution, of_program, times, manifest.sampling);
          request.write(question.dump() + "\n");
          const auto words = filled_in(with_folder(command, manifest.folder), question);
          const ProgramEnd end = run_program(words, request, answered, messages,
                                             names_answer(command), most_bytes());
          if(end.too_much)
            throw ProgramError(fmt::format(
                "{} wrote more than {:.3g} GB (external.answer_limit) and was stopped",
                name_of(manifest), options.answer_limit));
          const std::string said = last_words(messages);
          if(!end.problem().empty())
            throw ProgramError(
                fmt::format("{} {}{}", name_of(manifest), end.problem(), said));
          answer.emplace(answered.path(),
                         Expected{name_of(manifest), scene, manifest.capabilities,
                                  scene.domain.side() / resolution.n, times,
                                  most_bytes()});
          return {end.wall, end.cpu};
        }
        catch(const cases::Refusal &refusal)
        {
          const std::string reason = refusal.what(), name = name_of(manifest);
          throw cases::Refusal(reason.starts_with(name) ? reason : name + ": " + reason);
        }

        const cases::Scene &scene;
        const cases::EffectSet &effects;
        cases::Resolution resolution;
        ExternalOptions options;
        Manifest manifest;
        std::vector<std::string> command;
        cases::Options of_program;
        UnnamedFile request, answered, messages;
        std::optional<Answer> answer;
        cases::Cost counted;
      };

      class External : public cases::Method
      {
      public:
        External()
          : Method("external", "Any program that speaks the protocol of "
                               "verification/external/README.md.")
        {
        }

        std::vector<cases::Capabilities> capabilities() const override
        {
          return {};
        }

        std::vector<cases::Capabilities>
        capabilities_with(const cases::Options &options) const override
        {
          const std::string manifest = options_in(options).manifest;
          if(manifest.empty())
            throw cases::Refusal(fmt::format("{} {}", name(), without_manifest));
          return {read_manifest(manifest_path(manifest)).capabilities};
        }

        std::vector<cases::OptionDeclaration> option_declarations() const override
        {
          return cases::options_of(ExternalOptions());
        }

        /** Of the manifest, and of every file that is a word of the command. */
        std::map<std::string, std::string>
        further_provenance(const cases::Options &given) const override
        try
        {
          const ExternalOptions options = options_in(given);
          if(options.manifest.empty())
            return {};
          const Manifest manifest = read_manifest(manifest_path(options.manifest));
          std::map<std::string, std::string> result{
              {"manifest_hash", sha256(manifest.text)}};
          std::string hashes;
          for(const std::string &word :
              with_folder(command_of(options, manifest), manifest.folder))
            if(std::error_code none; std::filesystem::is_regular_file(word, none))
              hashes += sha256_of_file(word);
          result["command_hash"] = sha256(hashes);
          return result;
        }
        catch(const cases::InputError &)
        {
          // The run itself says what is wrong.
          return {{"manifest_hash", "unknown"}};
        }

      protected:
        std::unique_ptr<cases::Run>
        set_up(const cases::Scene &scene, const cases::EffectSet &effects,
               const cases::Resolution &resolution) const override
        {
          return std::make_unique<ExternalRun>(scene, effects, resolution);
        }
      };
    } // namespace
  }   // namespace external

  std::unique_ptr<cases::Method> make_external()
  {
    return std::make_unique<external::External>();
  }
} // namespace meltfront::verification
