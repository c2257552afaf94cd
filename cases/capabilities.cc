#include <cases/capabilities.h>
#include <cases/scene.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace meltfront::cases
{
  namespace
  {
    template <typename List, typename Value>
    bool holds(const List &list, const Value &value)
    {
      return std::ranges::find(list, value) != list.end();
    }

    std::string missing_effects(const Capabilities &capabilities,
                                const EffectSet &effects)
    {
      std::vector<std::string> missing;
      for(const EffectDecision &decision : effects.decisions())
        if(decision.on && !capabilities.takes(decision.effect))
          missing.push_back(
              fmt::format("{} ({})", to_string(decision.effect), decision.reason));
      if(missing.empty())
        return {};
      return fmt::format("does not simulate {}", fmt::join(missing, ", "));
    }

    std::string wrong_domain(const Capabilities &capabilities, const Scene &scene)
    {
      // Particles of a solid are where they are.
      if(scene.problem == ProblemKind::particle_solid)
        return {};
      if(capabilities.needs_symmetry && scene.symmetry == Symmetry::none
         && scene.domain.dimension > 1)
        return "needs a scene with a symmetry";
      if(capabilities.needs_particle_solid && !scene.particle_solid)
        return "needs matter that is made of particles: subsection 'Scene/Particle "
               "solid'";
      const auto shape = std::ranges::find(capabilities.shapes, scene.domain.shape,
                                           &ShapeCapability::shape);
      if(shape == capabilities.shapes.end())
      {
        std::vector<std::string> words;
        for(const ShapeCapability &taken : capabilities.shapes)
          words.emplace_back(to_string(taken.shape));
        return fmt::format("takes no domain of the shape '{}'; it takes {}",
                           to_string(scene.domain.shape), fmt::join(words, ", "));
      }
      if(!holds(shape->dimensions, scene.domain.dimension))
        return fmt::format("takes a domain of the shape '{}' in {} dimensions, not in {}",
                           to_string(scene.domain.shape),
                           fmt::join(shape->dimensions, " or "), scene.domain.dimension);
      for(const Side side : scene.sides())
        if(const BoundaryKind kind = scene.boundary(side).kind;
           !holds(shape->walls, kind))
          return fmt::format("takes no wall of the kind '{}' on a domain of the shape "
                             "'{}' ({} is one)",
                             to_string(kind), to_string(scene.domain.shape),
                             name_of(scene.domain, side));
      return {};
    }

    std::string wrong_fronts(const Capabilities &capabilities, const Scene &scene)
    {
      if(!scene.conducts_heat() || scene.problem == ProblemKind::poisson)
        return {};
      for(const FrontOrigin origin : front_origins(scene))
        if(!capabilities.takes(origin))
          switch(origin)
          {
          case FrontOrigin::none:
            return "follows a front, and without latent heat there is none";
          case FrontOrigin::initial_front:
            return "starts in one phase, and this scene starts in both";
          case FrontOrigin::partly_melted:
            return "takes no material that is partly solid at the melting point";
          case FrontOrigin::wall:
            return "does not simulate fronts that set out from a wall";
          case FrontOrigin::source:
            return "does not simulate fronts that set out from a source or sink";
          }
      if(capabilities.most_fronts > 0)
        if(const int fronts = least_number_of_fronts(scene);
           fronts > capabilities.most_fronts)
          return fmt::format("follows {} front{}; this scene has {} or more",
                             capabilities.most_fronts,
                             capabilities.most_fronts == 1 ? "" : "s", fronts);
      return {};
    }
  } // namespace

  const char *to_string(FrontOrigin origin)
  {
    constexpr const char *names[]
        = {"none", "initial front", "partly melted", "wall", "source"};
    static_assert(std::size(names) == n_front_origins);
    return names[static_cast<std::size_t>(origin)];
  }

  bool Capabilities::takes(Effect effect) const
  {
    return holds(effects, effect);
  }

  bool Capabilities::takes(FrontOrigin origin) const
  {
    return holds(front_origins, origin);
  }

  bool Capabilities::takes(DomainShape shape) const
  {
    return std::ranges::find(shapes, shape, &ShapeCapability::shape) != shapes.end();
  }

  std::string reason_unsupported(const Capabilities &capabilities, const Scene &scene,
                                 const EffectSet &effects, int threads)
  {
    if(!holds(capabilities.problems, scene.problem))
      return fmt::format("solves no scenes of the kind '{}'", to_string(scene.problem));
    if(std::string reason = missing_effects(capabilities, effects); !reason.empty())
      return reason;
    if(std::string reason = wrong_domain(capabilities, scene); !reason.empty())
      return reason;
    // Last: it looks at thousands of points.
    if(std::string reason = wrong_fronts(capabilities, scene); !reason.empty())
      return reason;
    if(threads > capabilities.most_threads)
      return fmt::format("runs in {} thread{}, not in {}", capabilities.most_threads,
                         capabilities.most_threads == 1 ? "" : "s", threads);
    return {};
  }
} // namespace meltfront::cases
