#include <cases/effect_bounds.h>
#include <cases/scene.h>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace meltfront::cases
{
  namespace
  {
    /** The scene of some decisions with one effect besides on or off. */
    Scene scene_of(const Scene &scene, std::vector<EffectDecision> decisions,
                   Effect effect, bool on)
    {
      for(EffectDecision &decision : decisions)
        if(decision.effect == effect)
          decision.on = on;
      return simulated_scene(scene, EffectSet(std::move(decisions)));
    }

    bool may_be_left_out(const Scene &scene, const EffectDecision &decision)
    {
      const auto choice = scene.effect_choices.find(decision.effect);
      return decision.on
             && (choice == scene.effect_choices.end()
                 || choice->second == EffectChoice::automatic);
    }

    void leave_out_negligible(const Scene &scene, double tolerance,
                              std::vector<EffectDecision> &decisions)
    {
      double left = tolerance;
      while(true)
      {
        EffectDecision *least = nullptr;
        EffectBound least_bound;
        std::vector<std::pair<EffectDecision *, EffectBound>> bounds;
        for(EffectDecision &decision : decisions)
          if(may_be_left_out(scene, decision))
          {
            const EffectBound bound = bound_of_effect(
                decision.effect, scene_of(scene, decisions, decision.effect, true),
                scene_of(scene, decisions, decision.effect, false));
            bounds.emplace_back(&decision, bound);
            if(bound.largest() <= left
               && (!least || bound.largest() < least_bound.largest()))
            {
              least = &decision;
              least_bound = bound;
            }
          }
        if(least)
        {
          left -= least_bound.largest();
          least->on = false;
          least->reason
              = fmt::format("left out: changes front and temperature by at most {:.2g} "
                            "({}; {})",
                            least_bound.largest(), least_bound.words, least->reason);
          continue;
        }
        for(const auto &[decision, bound] : bounds)
          decision->reason
              += std::isfinite(bound.largest())
                     ? fmt::format("; left out it may change front or "
                                   "temperature by {:.2g}",
                                   bound.largest())
                     : fmt::format("; no bound on its change: {}", bound.words);
        return;
      }
    }
  } // namespace

  EffectSet effects_within(const Scene &scene, double tolerance)
  {
    const EffectSet called_for = effects_called_for(scene);
    if(!(tolerance > 0))
      return called_for;
    std::vector<EffectDecision> decisions = called_for.decisions();
    leave_out_negligible(scene, tolerance, decisions);
    return EffectSet(std::move(decisions));
  }
} // namespace meltfront::cases
