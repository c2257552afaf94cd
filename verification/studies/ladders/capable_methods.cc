#include <cases/effect_bounds.h>
#include <cases/error.h>
#include <cases/run.h>
#include <verification/studies/ladders/capable_methods.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    /** `sph: takes no alloy (the reason)` or `sph takes no alloy` without the name and
     * the reason of each effect, which the page tells in its table of effects. */
    std::string reason_alone(const std::string &message, const std::string &method)
    {
      std::string reason = message;
      if(message.starts_with(method))
        reason.erase(0, message.find_first_not_of(": ", method.size()));
      static const std::regex in_brackets(R"( \([^()]*(\([^()]*\)[^()]*)*\))");
      return std::regex_replace(reason, in_brackets, "");
    }
  } // namespace

  cases::Options options_with(const MethodSettings &settings, const cases::Method &method)
  {
    cases::Options options(method.option_declarations());
    if(const auto own = settings.find(method.name()); own != settings.end())
      for(const auto &[key, value] : own->second)
        options.set(key, value);
    return options;
  }

  CapableMethods capable_methods(const cases::Case &c,
                                 const std::vector<const cases::Method *> &all,
                                 const MethodSettings &settings)
  {
    const cases::EffectSet effects = cases::effects_within(c.scene, c.effect_tolerance);
    const cases::Scene scene = cases::simulated_scene(c.scene, effects);
    CapableMethods found;
    std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
    for(const cases::Method *method : all)
      try
      {
        cases::require_capable(*method, scene, effects, 1,
                               options_with(settings, *method));
        found.capable.push_back(method);
      }
      catch(const cases::Refusal &refusal)
      {
        const std::string reason = reason_alone(refusal.what(), method->name());
        const auto known = std::ranges::find(
            reasons, reason, &std::pair<std::string, std::vector<std::string>>::first);
        if(known == reasons.end())
          reasons.push_back({reason, {method->name()}});
        else
          known->second.push_back(method->name());
      }
    for(const auto &[reason, names] : reasons)
      found.left_out.push_back(fmt::format("{}: {}", fmt::join(names, ", "), reason));
    return found;
  }
} // namespace meltfront::verification
