#ifndef meltfront_verification_studies_ladders_advice_h
#define meltfront_verification_studies_ladders_advice_h

#include <verification/judge/answers.h>
#include <verification/studies/ladders/ladder_growth.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** What accuracy is asked for. */
  struct WantedErrors
  {
    /** Root mean square over time of the front's error (of the solid's volume where the
     * front is not at one coordinate), relative to its end. */
    double front;
    /** Root mean square of the temperature's error at the end over places, relative to
     * the range of temperatures; NaN: not asked for. */
    double temperature = cases::nan;
  };

  /** What a method is expected to need for wanted errors. */
  struct MethodForecast
  {
    const cases::Method *method;
    int n = 0;
    double error = cases::nan;   ///< of the front, relative
    double seconds = cases::nan; ///< of processor time
    std::string
        doubt{}; ///< why it is not to be taken: `contradicts the others`; or empty
  };

  /** What is advised, and what came out. */
  struct Advice
  {
    std::string method; ///< empty where no method can be advised
    int n = 0;
    std::map<std::string, std::string> options{};
    double predicted_error = cases::nan, predicted_seconds = cases::nan;
    double error = cases::nan;   ///< as it came out: true where it is known, else the bar
    double seconds = cases::nan; ///< of processor time, as it came out
    bool reachable = false;
    bool error_is_true = false;
    std::string explanation{};
    std::vector<MethodForecast> forecasts{}; ///< of all methods, cheapest first
  };

  void to_json(nlohmann::json &json, const Advice &advice);

  /**
   * Forecasts from the levels that a growth has made: with D the root mean square
   * difference of the two finest courses over the size of the front, E = D/((n_2/n_1)^p -
   * 1) is the error of the finest; n = s n_2 (E/wanted)^(1/p) reaches the wanted one with
   * a margin s of 1.5 for errors down to 1e-3 and 1.25 below (a coarser level that does
   * so already will do); p is that of other cases (method_prior()) or, where three
   * levels show a lower one, that; the growth of the time is that of other cases. No
   * exact solution is looked at.
   */
  std::vector<MethodForecast> forecasts(const LadderGrowth &growth,
                                        const StoredCase &record,
                                        const WantedErrors &wanted);

  /**
   * Pilot runs, the cheapest method by its forecast, then the run itself; a second finer
   * one if the first shows by its difference from the pilots that it misses. Where no
   * method is forecast to reach the errors within the time, what is reachable in it.
   */
  Advice advise(LadderGrowth &growth, const WantedErrors &wanted);
} // namespace meltfront::verification

#endif
