#include <verification/app/tests/run_program.h>

#include <map>
#include <random>

namespace meltfront::verification::tests
{
  namespace
  {
    /** How often the program is killed: MELTFRONT_KILLS, or a few times. */
    int number_of_kills()
    {
      const char *wanted = std::getenv("MELTFRONT_KILLS");
      return wanted ? std::atoi(wanted) : 6;
    }

    fs::path write_matrix(const fs::path &directory)
    {
      const fs::path file = directory / "killed.prm";
      std::ofstream(file) << R"(set title = A matrix whose runs are killed
subsection Block 1
  set cases       = plane-freezing-started
  set methods     = sph, fem-enthalpy, fem-fitted, rkpm-tracked
  set resolutions = 8, 12, 16, 24
end
subsection Acceptance
  subsection plane-freezing-started
    set criterion 1 = sph: front_rms at n=24 <= 1
    set criterion 2 = fem-enthalpy: order of front_rms >= 0.5
    set criterion 3 = fem-fitted: front_rms at n=24 <= 1e-30
  end
end
)";
      return file;
    }

    /** What is not of the moment: all errors and verdicts, and which files there are. */
    nlohmann::json results(const fs::path &directory)
    {
      nlohmann::json all = read_json(directory / "summary.json");
      all.erase("date");
      std::map<std::string, nlohmann::json> files;
      for(const fs::directory_entry &entry : fs::recursive_directory_iterator(directory))
      {
        nlohmann::json &of_file = files[fs::relative(entry.path(), directory)];
        if(entry.path().filename() == "run.json")
        {
          const nlohmann::json run = read_json(entry.path());
          of_file = {run.at("status"), run.at("quantities"), run.at("series")};
        }
      }
      all["files"] = files;
      return all;
    }

    /** What differs, as a JSON patch; empty where nothing does. Files that only the first
     * has do not count: what a run has beside it while it is made stays where it is
     * killed, and nobody asks for it. */
    std::string difference(const fs::path &killed, const fs::path &whole)
    {
      nlohmann::json ours = results(killed);
      const nlohmann::json wanted = results(whole);
      std::vector<std::string> more;
      for(const auto &[name, content] : ours.at("files").items())
        if(!wanted.at("files").contains(name))
          more.push_back(name);
      for(const std::string &name : more)
        ours.at("files").erase(name);
      const nlohmann::json patch = nlohmann::json::diff(ours, wanted);
      return patch.empty() ? "" : patch.dump().substr(0, 1000);
    }

    /** Killed at any moment, by all of its processes at once, verify and report leave
     * nothing that the next call stumbles over, and end with the same results. */
    TEST(Program, VerifiesAndReportsAfterAnyKill)
    {
      const TemporaryDirectory scratch;
      const std::string matrix = write_matrix(scratch.path()).string();
      const fs::path whole = scratch.path("whole"), killed = scratch.path("killed");
      const std::string verify = "verify " + matrix + " --timing quick --out ";
      const auto start = std::chrono::steady_clock::now();
      const Outcome unharmed = run_program(verify + whole.string());
      EXPECT_EQ(unharmed.status, 1) << unharmed.output; // criterion 3 cannot hold
      const double seconds
          = std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
                .count();
      std::mt19937 generator(1);
      std::uniform_real_distribution<double> share(0, 0.7);
      for(int k = 0; k < number_of_kills(); ++k)
      {
        const bool report = k % 3 == 2 && fs::exists(killed / "summary.json");
        run_and_kill(report ? "report " + killed.string() : verify + killed.string(),
                     share(generator) * seconds);
        if(k % 10 == 9) // from the beginning
        {
          const Outcome end = run_program(verify + killed.string());
          EXPECT_EQ(end.status, 1) << end.output;
          EXPECT_EQ(difference(killed, whole), "") << "kill " << k;
          fs::remove_all(killed / "runs");
        }
      }
      const Outcome end = run_program(verify + killed.string());
      EXPECT_EQ(end.status, 1) << end.output;
      EXPECT_EQ(difference(killed, whole), "");
      const Outcome report = run_program("report " + killed.string());
      EXPECT_EQ(report.status, 1) << report.output;
      EXPECT_EQ(difference(killed, whole), "");
    }
  } // namespace
} // namespace meltfront::verification::tests
