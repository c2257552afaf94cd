#ifndef meltfront_verification_app_capability_list_h
#define meltfront_verification_app_capability_list_h

#include <cases/capabilities.h>

#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /** What each method takes, as a table methods x effects and a paragraph for each form
   * of a method: kinds of problem, shapes with their walls, how fronts begin, threads. */
  std::string capability_text();

  /** What a form of a method takes, each with its heading: problems, effects, domains
   * with their walls, fronts, threads. */
  std::vector<std::pair<std::string, std::string>>
  capability_facts(const cases::Capabilities &form);

  /**
   * The same as JSON: `methods[{name, forms[{form, problems, effects, shapes[{shape,
   * dimensions, walls}], front_origins, most_fronts, most_threads, overshoot{at_twenty,
   * order}}]}]`. most_fronts 0 means any number.
   */
  std::string capability_json();
} // namespace meltfront::verification

#endif
