#ifndef meltfront_verification_external_answer_h
#define meltfront_verification_external_answer_h

#include <cases/capabilities.h>
#include <cases/method.h>
#include <cases/scene.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <fstream>
#include <string>
#include <vector>

namespace meltfront::verification::external
{
  /** What an answer is held against. */
  struct Expected
  {
    std::string who; ///< the program, for messages
    const cases::Scene &scene;
    cases::Capabilities capabilities;
    double spacing; ///< side / n (m)
    std::vector<double> times;
    double most_bytes; ///< of a line
  };

  /** A state that a program has told. */
  struct ToldState
  {
    std::array<std::vector<double>, 3> positions;
    std::vector<double> weights, temperature, solid_fraction;
    std::array<std::vector<double>, 3> front;
    cases::HeatBudget heat;
  };

  /**
   * The answer of a program: a line that begins it, one for each time that was asked for,
   * one that ends it, read one after another.
   *
   * Everything throws ProgramError, which names the line, for what is no JSON or not as
   * the schema says, lines that are missing, of another time, or more than were asked
   * for, a wrong number of sites, volumes that do not fill the domain, solid fractions
   * outside 0 to 1, a spacing that has nothing to do with n, and a missing heat book of a
   * program that says that it conserves heat. NaN and infinity are no JSON.
   */
  class Answer
  {
  public:
    /** Read the first line. @throws cases::Refusal if the program refuses the scene */
    Answer(const std::string &path, Expected expected);

    const cases::RunDescription &description() const
    {
      return described;
    }

    /** The state at one of the times; indices only ascend. */
    const ToldState &state(std::size_t index);

    /** How many dimensions sites have. */
    int dimension() const
    {
      return described.dimension;
    }

    /** Read the end, after the last state: what the program counted. */
    cases::Cost end();

  private:
    bool read_line();
    nlohmann::json message(const std::string &kind);
    void take_sites(const nlohmann::json &of_line);
    void take_start(const nlohmann::json &start);
    void take_snapshot(const nlohmann::json &snapshot, double time);
    void take_heat(const nlohmann::json &snapshot);
    void check_sites() const;
    [[noreturn]] void fail(const std::string &problem) const;

    Expected expected;
    std::ifstream in;
    std::string line;
    long line_number = 0;
    cases::RunDescription described;
    std::size_t next = 0; ///< index of the time of the next line
    double initial_heat = 0;
    ToldState told;
  };
} // namespace meltfront::verification::external

#endif
