#include <particles/rkpm_tracked/plane/particle_start.h>

#include <cases/capabilities.h>
#include <cases/error.h>
#include <cases/exact_solution.h>
#include <cases/mean_with_jumps.h>
#include <cases/means_of_jumps.h>
#include <particles/rkpm_tracked/plane/enthalpy_particles.h>
#include <particles/sph/sph.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Ends of runs that look for the time of the handing over are so many times as late
     * each, and states are looked at in so many places of one. */
    constexpr double later = 4;
    constexpr int looks = 64;

    /** Of the super steps of these runs, which are to tell the time, and of the run up to
     * it. */
    constexpr int stages_of_search = 3, stages_of_run = 8;

    /** From this share of the run on, half of the depth is deep enough. */
    constexpr double soon = 0.25;

    /** Times the depth that is asked for everywhere: so deep somewhere is deep enough. */
    constexpr double deep_somewhere = 3;

    /** Times that depth: how near a place has to be to where it is deeper, so that it is
     * the rim of a body and not its depth; and by how many spacings deeper. */
    constexpr double beside = 1.5, deeper = 0.5;

    /** How near nodes are between which a jump is looked for (spacings). */
    constexpr double beside_node = 1.5;

    class Watch : public cases::Observer
    {
    public:
      explicit Watch(const ParticleStart::Visit &visit)
        : visit(visit)
      {
      }

      bool wants(long, double) override
      {
        return true;
      }

      void observe(const cases::Snapshot &snapshot) override
      {
        try
        {
          visit(snapshot);
        }
        catch(const cases::Refusal &)
        {
          refuses = true;
          throw;
        }
      }

      bool refuses = false; ///< a state that `sph` made, rather than `sph` the scene

    private:
      const ParticleStart::Visit &visit;
    };

    struct Depths
    {
      double least = 0, most = 0; ///< of the places where it is deepest around (m)

      bool reach(double asked) const
      {
        return least >= asked || most >= deep_somewhere * asked;
      }
    };

    /** How deep a phase is; nothing where there is none. */
    std::optional<Depths> depths_of(bool solid, const EnthalpyParticles &particles,
                                    const PlaneNodes &nodes, double asked)
    {
      const double h = nodes.spacing, reach = (deep_somewhere + 1) * asked;
      const PlaneLevelSet level
          = [&](const PlanePoint &place) { return particles.level(place); };
      const Contours contours = find_contours(nodes.lower, nodes.upper, h, level);
      const FrontIndex index(front_on_zeros(contours, level, front_spacing * h, h),
                             contours.solid_beyond, h);
      std::vector<double> depth;
      for(const PlanePoint &place : nodes.position)
        depth.push_back((solid ? -1 : 1) * index.signed_distance(place, reach));
      Depths result{reach, 0};
      for(std::size_t i = 0; i < nodes.size(); ++i)
      {
        if(depth[i] <= 0)
          continue;
        result.most = std::max(result.most, depth[i]);
        bool rim = false;
        if(depth[i] < asked)
          nodes.bins.visit(nodes.position[i], beside * asked,
                           [&](std::uint32_t other, double)
                           { rim = rim || depth[other] > depth[i] + deeper * h; });
        if(!rim)
          result.least = std::min(result.least, depth[i]);
      }
      if(result.most == 0)
        return {};
      return result;
    }
  } // namespace

  bool starts_from_one_phase(const cases::Scene &scene)
  {
    using cases::FrontOrigin;
    const auto &exact = scene.initial.exact;
    if(exact && exact->has_front() && scene.start_time > exact->start_time())
      return false;
    const auto origins = cases::front_origins(scene);
    return scene.sources.empty()
           && std::ranges::all_of(origins, [](FrontOrigin origin)
                                  { return origin == FrontOrigin::wall; });
  }

  bool may_start_with_jumps(const cases::Scene &scene)
  {
    return scene.sources.empty() && cases::may_jump_at_start(scene)
           && !starts_from_one_phase(scene);
  }

  bool starts_with_jumps(const cases::Scene &scene, const PlaneNodes &nodes)
  {
    if(!may_start_with_jumps(scene))
      return false;
    const auto temperature = [&](const cases::Position &place)
    { return scene.initial.temperature(place, scene.start_time); };
    std::vector<double> values;
    for(const PlanePoint &place : nodes.position)
      values.push_back(temperature(position_of(place)));
    const auto [lowest, highest] = std::ranges::minmax(values);
    const double least = cases::negligible_jump * (highest - lowest);
    bool found = false;
    for(std::size_t i = 0; i < nodes.size() && !found; ++i)
      nodes.bins.visit(
          nodes.position[i], beside_node * nodes.spacing,
          [&](std::uint32_t other, double)
          {
            found
                = found
                  || (other > i && std::abs(values[other] - values[i]) > least
                      && cases::jump_between(temperature, position_of(nodes.position[i]),
                                             position_of(nodes.position[other]))
                                 .height
                             > least);
          });
    return found;
  }

  ParticleStart::ParticleStart(const cases::Scene &scene, const cases::EffectSet &effects,
                               const cases::Resolution &resolution,
                               const PlaneNodes &nodes,
                               const TrackingParameters &parameters)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , nodes(nodes)
    , wished(parameters.start_depth * nodes.spacing)
  {
    particles = along_side(parameters.start_refinement);
    const double whole = scene.end_time - scene.start_time,
                 solid = scene.material.solid.diffusivity(),
                 liquid = scene.material.liquid.diffusivity(),
                 fastest = std::max(solid, liquid);
    if(!starts_from_one_phase(scene))
    {
      const double slower = std::min(solid, liquid),
                   at_least = wished * wished / (16 * slower);
      if(!(at_least < whole))
        throw cases::Refusal(fmt::format(
            "{} does not resolve what jumps at the start: it takes {:.3g} s to be smooth "
            "over {:g} nodes, longer than the run: take more nodes, a later end, or sph",
            method_name, at_least, parameters.start_depth / 2));
      const double duration
          = std::clamp(soon * whole, at_least, wished * wished / (4 * slower));
      time = scene.start_time + duration;
      least_depth = most_depth = 2 * std::sqrt(slower * duration) / nodes.spacing;
      return;
    }
    bool found = false;
    for(double duration = std::min(whole, nodes.spacing * nodes.spacing / fastest);
        !found; duration = std::min(whole, later * duration))
    {
      found = search(duration < whole ? scene.start_time + duration : scene.end_time);
      if(!found && !(duration < whole))
        throw cases::Refusal(fmt::format(
            "{} does not resolve the front: by sph, from which it would start, the new "
            "phase is nowhere {:g} nodes deep before the end, or there is none: take "
            "more "
            "nodes, a later end, or sph",
            method_name, parameters.start_depth / 2));
    }
  }

  int ParticleStart::along_side(int refinement) const
  {
    return refinement
           * static_cast<int>(std::lround(scene.domain.side() / nodes.spacing));
  }

  /** @return whether the front is deep enough before an end */
  bool ParticleStart::search(double end)
  {
    bool found = false, solid = false;
    double next_look = 0;
    const double from_now_half
        = scene.start_time + soon * (scene.end_time - scene.start_time);
    const Visit look = [&](const cases::Snapshot &snapshot)
    {
      if(snapshot.time == scene.start_time)
        solid = snapshot.solid_fraction[0] < 0.5;
      if(found || snapshot.time < next_look || snapshot.time == scene.start_time
         || snapshot.time == scene.end_time)
        return;
      next_look = snapshot.time + (end - scene.start_time) / looks;
      const EnthalpyParticles state(scene, nodes, snapshot);
      auto depths = depths_of(solid, state, nodes, wished);
      found = depths && depths->reach(wished);
      if(depths && !found && snapshot.time >= from_now_half)
      {
        depths = depths_of(solid, state, nodes, wished / 2);
        found = depths && depths->reach(wished / 2);
      }
      if(found)
      {
        time = snapshot.time;
        least_depth = depths->least / nodes.spacing;
        most_depth = depths->most / nodes.spacing;
      }
    };
    search_work += run_until(end, along_side(1), stages_of_search, look).work;
    return found;
  }

  cases::Cost ParticleStart::run_until(double end, int n, int stages,
                                       const Visit &visit) const
  {
    const auto method = make_sph();
    cases::Scene sooner = scene;
    sooner.end_time = end;
    cases::Resolution finer = resolution;
    finer.n = n;
    finer.options = cases::Options(method->option_declarations());
    finer.options.set("dimension", "2");
    finer.options.set("stages", fmt::format("{}", stages));
    Watch watch(visit);
    try
    {
      return method->solve(sooner, effects, finer, watch);
    }
    catch(const cases::Refusal &refusal)
    {
      if(watch.refuses)
        throw;
      throw cases::Refusal(fmt::format("{} starts from sph where one phase fills the "
                                       "domain or its temperature jumps, and that "
                                       "refuses: {}",
                                       method_name, refusal.what()));
    }
  }

  cases::Cost ParticleStart::run(const Visit &visit) const
  {
    return run_until(time, particles, stages_of_run, visit);
  }
} // namespace meltfront::particles::rkpm_tracked
