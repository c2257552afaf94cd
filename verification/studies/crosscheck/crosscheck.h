#ifndef meltfront_verification_studies_crosscheck_crosscheck_h
#define meltfront_verification_studies_crosscheck_crosscheck_h

#include <verification/studies/crosscheck/scene_check.h>
#include <verification/studies/crosscheck/shrink.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdio>
#include <functional>

namespace meltfront::verification
{
  struct CrosscheckSettings
  {
    int scenes = 20;
    std::uint64_t seed = 1;
    int dimension = 0; ///< 0: any
    std::string directory;
    int jobs = 0;       ///< processes at once; 0: one for each core
    double within = 20; ///< longest time of a run (processor s)
    std::vector<const cases::Method *> methods;
    std::string program_version;
    std::string program_hash;      ///< empty: program_hash()
    std::FILE *progress = nullptr; ///< null: say nothing
    ShrinkBudget shrink{};
  };

  /** Reads a case from the text of a file of this name. @throws cases::InputError */
  using CaseReader
      = std::function<cases::Case(const std::string &text, const std::string &file)>;

  /** Makes the scene of a seed and an index. */
  using SceneMaking
      = std::function<SceneDraft(std::uint64_t seed, int index, int dimension)>;

  /**
   * Random scenes through every method that takes them; who contradicts the others?
   *
   * Written to the directory: scenes/scene-SEED-INDEX.prm and the verdict on it beside
   * it, .json; suspects/scene-SEED-INDEX.prm, the smallest scene found that shows the
   * same contradiction, with a comment that says what contradicts what; summary.json. A
   * scene whose verdict is there, of the same program, text, methods and time limit, is
   * not run again.
   *
   * @return what summary.json holds: `scenes`, `agreed`, `refused`, `failed`, `suspect`
   * (numbers of scenes), `suspects` [{scene, methods, quantity, values, bars, time,
   * suspected, file}], `failures`, `too_coarse` and `out_of_time` [{scene, method, n,
   * reason}],
   * `refusals` (by method and reason: number of scenes) and `compared` (by method: number
   * of scenes) and `median_bars` (by method, over scenes: relative_bars())
   * @throws InputError for fewer than two methods, OutputError if the directory cannot be
   * written to or another process is at work in it
   */
  nlohmann::json crosscheck(const CrosscheckSettings &settings, const CaseReader &read,
                            const SceneMaking &make);
} // namespace meltfront::verification

#endif
