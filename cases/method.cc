#include <cases/error.h>
#include <cases/means_of_jumps.h>
#include <cases/method.h>
#include <cases/run.h>
#include <cases/scene.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::cases
{
  Cost Method::solve(const Scene &scene, const EffectSet &effects,
                     const Resolution &resolution, Observer &observer) const
  {
    require_capable(*this, scene, effects, resolution.threads, resolution.options);
    Resolution complete = resolution;
    if(complete.options.declarations().empty())
      complete.options = Options(option_declarations());
    require_affordable(*this, demand(scene, effects, complete), complete.memory_limit);
    const Stopwatch watch;
    const Scene seen = with_means_of_jumps(
        scene, [&](Side side) { return spacing_along_wall(scene, side, complete); });
    const std::unique_ptr<Run> run = set_up(seen, effects, complete);
    return run->carry_out(seen, watch, observer);
  }

  Demand Method::demand(const Scene &, const EffectSet &, const Resolution &) const
  {
    return {};
  }

  double Method::spacing_along_wall(const Scene &scene, Side,
                                    const Resolution &resolution) const
  {
    return scene.domain.side() / resolution.n;
  }

  Capabilities require_capable(const Method &method, const Scene &scene,
                               const EffectSet &effects, int threads,
                               const Options &options)
  {
    std::string reasons, first;
    bool alike = true;
    const std::vector<Capabilities> forms = method.capabilities_with(options);
    // Forms for other shapes tell nothing about a scene whose shape another form takes.
    // Particles of a solid are where they are: such scenes have none.
    const bool shape_taken
        = scene.problem != ProblemKind::particle_solid
          && std::ranges::any_of(forms, [&scene](const Capabilities &form)
                                 { return form.takes(scene.domain.shape); });
    for(const Capabilities &form : forms)
    {
      if(shape_taken && !form.takes(scene.domain.shape))
        continue;
      const std::string reason = reason_unsupported(form, scene, effects, threads);
      if(reason.empty())
        return form;
      alike = alike && (first.empty() || reason == first);
      first = first.empty() ? reason : first;
      reasons += fmt::format("{}{}{}{}", reasons.empty() ? "" : "; ", form.form,
                             form.form.empty() ? "" : " it ", reason);
    }
    throw Refusal(alike ? fmt::format("{} {}", method.name(), first)
                        : fmt::format("{}: {}", method.name(), reasons));
  }

  void require_affordable(const Method &method, const Demand &demand, double memory_limit)
  {
    // What is not a number is no estimate either.
    if(!(demand.bytes <= memory_limit))
      throw Refusal(fmt::format("{} is estimated to need {:.3g} GB of memory, and {:.3g} "
                                "GB are allowed: take a smaller n or another --memory",
                                method.name(), demand.bytes / 1e9, memory_limit / 1e9));
    if(!(demand.steps <= most_steps))
      throw Refusal(fmt::format("{} is estimated to take {:.3g} time steps, and at most "
                                "{:.0e} are allowed: take fewer or longer steps, or a "
                                "smaller n",
                                method.name(), demand.steps, most_steps));
  }
} // namespace meltfront::cases
