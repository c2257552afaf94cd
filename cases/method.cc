#include <cases/error.h>
#include <cases/method.h>
#include <cases/scene.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::cases
{
  bool Method::solves(ProblemKind problem) const
  {
    return problem == ProblemKind::stefan;
  }

  void require_effects(const Method &method, const EffectSet &effects)
  {
    const auto supported = method.supported_effects();
    std::string missing;
    for(const EffectDecision &decision : effects.decisions())
      if(decision.on
         && std::find(supported.begin(), supported.end(), decision.effect)
                == supported.end())
        missing += fmt::format("{}{} ({})", missing.empty() ? "" : ", ",
                               to_string(decision.effect), decision.reason);
    if(!missing.empty())
      throw Refusal(fmt::format("{} does not simulate {}", method.name(), missing));
  }

  void require_problem(const Method &method, const Scene &scene)
  {
    if(!method.solves(scene.problem))
      throw Refusal(fmt::format("{} solves no scenes of the kind '{}'", method.name(),
                                to_string(scene.problem)));
  }
} // namespace meltfront::cases
