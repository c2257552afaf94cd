#ifndef meltfront_verification_matrix_tests_runner_fixture_h
#define meltfront_verification_matrix_tests_runner_fixture_h

#include <verification/matrix/runner.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <thread>

namespace meltfront::verification::tests
{
  inline void pause_for(int milliseconds)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }

  /** Two runs at once, each timed once. */
  inline RunnerOptions options_in(const std::string &directory)
  {
    RunnerOptions options;
    options.directory = directory;
    options.jobs = 2;
    options.program_version = "1";
    options.repeats.most = 1;
    return options;
  }

  /** Methods of a test, the log of their runs, and a matrix of them. */
  class RunnerTest : public ::testing::Test
  {
  protected:
    RunnerTest()
    {
      options = options_in(scratch.path("out"));
      add("good", [](const auto &, const auto &) {});
      add("diverging", [](const auto &, const auto &)
          { throw cases::NumericalError("diverging", 3, 0.5, "temperature", "is bad"); });
      add("refusing",
          [](const auto &, const auto &) { throw cases::Refusal("not for this scene"); });
      add("crashing", [](const auto &, const auto &) { std::raise(SIGSEGV); });
      add("leaving", [](const auto &, const auto &) { std::_Exit(7); });
      add("hanging", [](const auto &, const auto &) { pause_for(1000000); });
      add("busy",
          [](const auto &, const auto &)
          {
            const std::clock_t start = std::clock();
            while(std::clock() - start < CLOCKS_PER_SEC / 500)
            {
            }
          });
      add("slow", [](const auto &, const auto &) { pause_for(15); });
      add("large",
          [](const auto &, const cases::Resolution &resolution)
          {
            std::vector<char> bytes(static_cast<std::size_t>(resolution.n) << 20);
            for(std::size_t i = 0; i < bytes.size(); i += 4096)
              bytes[i] = 1;
            std::fputs(bytes[12345] == 7 ? "seven\n" : "noise\n", stdout);
          });
    }

    void add(const std::string &name, const FakeMethod::Act &act)
    {
      methods[name] = std::make_unique<FakeMethod>(
          name,
          [act, this](const cases::Scene &scene, const cases::Resolution &resolution)
          {
            tests::append_line(scratch.path("started"),
                               fmt::format("{} n={} seed={}", scene.name, resolution.n,
                                           resolution.seed));
            act(scene, resolution);
          });
    }

    MatrixResult run(const Matrix &matrix)
    {
      return run_matrix(
          matrix, options,
          [this](const std::string &name)
          {
            if(name == "wrong")
              throw cases::InputError("there is no case 'wrong'");
            cases::Case c = tests::slab_case(name);
            c.text += case_text;
            return c;
          },
          [this](const std::string &name) -> const cases::Method &
          { return *methods.at(name); });
    }

    static Matrix matrix_of(const std::vector<std::string> &methods,
                            const std::vector<int> &resolutions,
                            const std::vector<std::string> &cases = {"x"})
    {
      return {"test", "A test", "",
              false,  600,      {{cases, methods, resolutions, {}, {1}, {1}}}};
    }

    std::size_t starts() const
    {
      return tests::lines_of(scratch.path("started")).size();
    }

    ScratchDirectory scratch;
    RunnerOptions options;
    std::string case_text;
    std::map<std::string, std::unique_ptr<FakeMethod>> methods;
  };
} // namespace meltfront::verification::tests

#endif
