#ifndef meltfront_verification_external_tests_fixture_h
#define meltfront_verification_external_tests_fixture_h

#include <verification/external/external.h>
#include <verification/run/run_one.h>
#include <verification/run/tests/fakes.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification::tests
{
  /** A manifest of the tests' program, told how to answer. */
  inline nlohmann::json manifest_of(const std::string &how)
  {
    return {{"protocol", 1},
            {"name", "test"},
            {"command", {MELTFRONT_EXTERNAL_PROGRAM, how}},
            {"effects", {"phase_change", "wall_temperature"}},
            {"shapes",
             {{{"shape", "slab"},
               {"dimensions", {1}},
               {"walls", {"fixed temperature", "insulated"}}}}},
            {"front_origins", {"none", "wall"}}};
  }

  /** A run of `external` on slab_case() with a manifest that is written to a file. */
  class ExternalTrial
  {
  public:
    explicit ExternalTrial(const nlohmann::json &manifest)
      : ExternalTrial(manifest.dump())
    {
    }

    explicit ExternalTrial(const std::string &manifest)
      : resolution{20, cases::Options(make_external()->option_declarations())}
    {
      std::ofstream(path()) << manifest;
      resolution.options.set("manifest", path());
    }

    std::string path() const
    {
      return scratch.path("manifest.json");
    }

    RunRecord run(const cases::Case &c = slab_case("slab")) const
    {
      const auto method = make_external();
      return run_one(c, *method, resolution, "external", {}, nullptr, {1, 0, 0});
    }

    ScratchDirectory scratch;
    cases::Resolution resolution;
  };
} // namespace meltfront::verification::tests

#endif
