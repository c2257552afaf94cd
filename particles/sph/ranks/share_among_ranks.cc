#include <cases/demand.h>
#include <cases/error.h>
#include <cases/scene.h>
#include <particles/sph/heat_flow.h>
#include <particles/sph/ranks/rank_exchange.h>
#include <particles/sph/ranks/rank_particles.h>
#include <particles/sph/ranks/share_among_ranks.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace meltfront::particles
{
  namespace
  {
    using cases::Effect;

    void refuse(const std::string &what)
    {
      throw cases::Refusal(fmt::format(
          "sph on several ranks takes {}; the rest is for one process", what));
    }

    void require_shareable(const Discretisation &dis, const SphParameters &p)
    {
      if(p.layout != LatticeLayout::cell_centred || dis.displaced)
        refuse("particles on a lattice of cells (layout = cell, arrangement = lattice)");
      if(is_implicit(p.time_scheme) || p.time_scheme == TimeScheme::automatic)
        refuse("explicit steps (time_scheme = rkl2 or euler)");
      if(p.step_limit != StepLimit::monotone)
        refuse("steps that keep the maximum principle (step_limit = monotone)");
      if(p.front == FrontRule::partner || p.front == FrontRule::liquid)
        refuse("fronts within particles (front = plane, sub_particle or automatic)");
    }

    /**
     * Rows reach the kernel's cells. A front as lines or planes (FrontPlanes, settle())
     * reaches from one's own particle through the pairs that melt it (2 cells) and what
     * lies between them (3) to the curvature about that (4) and the sections which it is
     * fitted to (5): these depend on which slices reach a front, and on the cells about
     * each (6), or on the images of these and on what lies behind them (7).
     */
    HaloDepth halo_depth(const Discretisation &dis, const SphParameters &p,
                         const cases::EffectSet &effects)
    {
      constexpr HaloDepth of_planes{.values = 7, .fronts = 5};
      const double reach = dis.kernel.support() * (1 - 1e-9) / dis.spacing;
      HaloDepth depth{.values = static_cast<int>(std::ceil(reach)) - 1, .fronts = 0};
      if(effects.contains(Effect::phase_change)
         && resolve_front_rule(dis, p) == FrontRule::plane)
        depth = of_planes;
      // Weights of a source are over all particles that it reaches.
      if(effects.contains(Effect::heat_sources))
        depth.values = std::max(depth.values, static_cast<int>(std::ceil(2 * reach)));
      return depth;
    }
  } // namespace

  cases::Capabilities capabilities_on_ranks()
  {
    using cases::BoundaryKind, cases::DomainShape, cases::FrontOrigin;
    const std::vector<BoundaryKind> walls{
        BoundaryKind::insulated, BoundaryKind::fixed_temperature,
        BoundaryKind::flux,      BoundaryKind::heat_transfer,
        BoundaryKind::radiation, BoundaryKind::periodic};
    return {
        .form = "on several ranks",
        .problems = {cases::ProblemKind::stefan},
        .effects
        = {Effect::phase_change, Effect::phase_conductivity, Effect::phase_heat_capacity,
           Effect::heat_sources, Effect::wall_temperature, Effect::wall_flux,
           Effect::volumetric_source, Effect::robin_wall, Effect::radiating_wall,
           Effect::inclusion, Effect::variable_conductivity,
           Effect::variable_heat_capacity, Effect::melting_range},
        .shapes = {{DomainShape::slab, {1}, walls}, {DomainShape::box, {2, 3}, walls}},
        .front_origins
        = {FrontOrigin::none, FrontOrigin::initial_front, FrontOrigin::partly_melted,
           FrontOrigin::wall, FrontOrigin::source}};
  }

  double bytes_of_ranks(const SphParameters &p, const cases::Scene &scene, int ranks)
  {
    // Each rank sets up all particles before it keeps its own.
    constexpr double of_particle = 70;
    return (ranks - 1) * cases::program_bytes
           + ranks * of_particle * cases::lattice_points(scene.domain, p.dimension, p.n);
  }

  void share_among_ranks(Discretisation &dis, const SphParameters &parameters,
                         const cases::EffectSet &effects, int ranks)
  {
    require_shareable(dis, parameters);
    RankParticles part = particles_of_rank(dis, halo_depth(dis, parameters, effects),
                                           rank_among(ranks), ranks);
    part.own.exchange = make_rank_exchange(ranks, part.own, part.numbers);
    dis.keep(part.numbers, std::move(part.own));
  }
} // namespace meltfront::particles
