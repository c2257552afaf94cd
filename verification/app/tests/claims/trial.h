#ifndef meltfront_verification_app_tests_claims_trial_h
#define meltfront_verification_app_tests_claims_trial_h

#include <cases/exact_solution.h>
#include <cases/method.h>
#include <cases/scene.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace meltfront::verification::claims
{
  /** What a method returned of a scene at one time. */
  struct EndState
  {
    double time = 0;
    std::array<std::vector<double>, 3> positions;
    std::vector<double> weights, temperature, solid_fraction;
    std::array<std::vector<double>, 3> velocity;
    /** Of a region that is carried along: its sign at the points of a lattice. */
    std::vector<bool> inside;

    cases::Position position(std::size_t site) const
    {
      return {positions[0].empty() ? 0 : positions[0][site],
              positions[1].empty() ? 0 : positions[1][site],
              positions[2].empty() ? 0 : positions[2][site]};
    }
  };

  /** By how much an end state differs from what is known exactly. */
  struct Differences
  {
    /** Root mean square over the sites, in the unit of what is compared: temperatures in
     * a scene that conducts heat, places of particles in one that moves them; the share
     * of the lattice that is on the wrong side where a region is carried along. */
    double sites = 0;
    double solid = 0; ///< of the share of the domain that is solid
  };

  using Judge = std::function<Differences(const EndState &)>;

  /** A scene of which the end is known. */
  struct Trial
  {
    cases::Scene scene;
    Judge judge;
    int n = 0;        ///< resolution
    double scale = 1; ///< of temperature or of places: tolerances are shares of it
    std::vector<std::pair<std::string, std::string>> options{}; ///< that a method needs
  };

  /** A scene at two values of an effect's datum, at the second of which it is on. */
  struct EffectTrials
  {
    Trial first, second;
    /** The datum is a property of what the method simulates: the second is another value
     * and to be refused. */
    bool one_value_only = false;
  };

  using TemperatureAt = std::function<double(const cases::Position &)>;

  /**
   * Compares temperatures at sites and the solid's share of the domain.
   * @param solid_share negative: there is nothing to compare
   * @param from distance from the origin below which temperatures do not count
   */
  Judge temperature_judge(TemperatureAt temperature, double solid_share = -1,
                          double from = 0);

  /** The same of an exact solution at the end of a scene. */
  Judge solution_judge(const cases::Scene &scene,
                       const std::shared_ptr<const cases::ExactSolution> &solution,
                       double from = 0);

  /** The end of a scene by a method, and what it cost. */
  struct Outcome
  {
    EndState start, end;
    cases::Cost cost;
    cases::EffectSet effects;
    int dimension; ///< in which the scene was simulated
  };

  /** Run a trial. @throws what the method throws */
  Outcome run(const cases::Method &method, const Trial &trial);

  /** Coordinates of the lattice on which a region that is carried along is looked at. */
  std::vector<cases::Position> lattice(const cases::Domain &domain);
} // namespace meltfront::verification::claims

#endif
