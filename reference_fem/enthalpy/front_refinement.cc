#include <reference_fem/enthalpy/front_refinement.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::Effect;

    constexpr int far = std::numeric_limits<int>::max();

    /** Of the latent heat: so near to its ends a node is of one phase but for round-off.
     */
    constexpr double share_of_round_off = 1e-9;

    void require_refinable(const cases::Scene &scene, const cases::EffectSet &effects)
    {
      if(!scene.changes_phase())
        throw cases::Refusal("fem-enthalpy refines at the front (refinement = front) "
                             "where there can be one only: nothing melts in this scene");
      const std::vector<Effect> simulated{
          Effect::phase_change, Effect::phase_conductivity, Effect::phase_heat_capacity,
          Effect::heat_sources, Effect::wall_temperature,   Effect::wall_flux,
          Effect::robin_wall,   Effect::radiating_wall,     Effect::volumetric_source};
      for(const cases::EffectDecision &decision : effects.decisions())
        if(decision.on
           && std::ranges::find(simulated, decision.effect) == simulated.end())
          throw cases::Refusal(fmt::format(
              "fem-enthalpy does not simulate the effect {} on a mesh that is refined at "
              "the front (refinement = front)",
              cases::to_string(decision.effect)));
    }
  } // namespace

  FrontRefinement::FrontRefinement(const cases::Scene &scene,
                                   const cases::EffectSet &effects,
                                   const RefinableMesh &mesh)
    : scene(scene)
    , mesh(mesh)
    , graph(scene.material)
  {
    require_refinable(scene, effects);
  }

  std::vector<double> FrontRefinement::by_site(const Discretisation &discretisation,
                                               std::vector<double> by_node) const
  {
    std::vector<double> result(discretisation.node_of_site.size());
    for(std::size_t site = 0; site < result.size(); ++site)
      result[site] = by_node[discretisation.node_of_site[site]];
    for(const HangingSite &hangs : discretisation.hanging)
    {
      result[hangs.site] = 0;
      for(const auto &[node, share] : hangs.nodes)
        result[hangs.site] += share * by_node[node];
    }
    return result;
  }

  /** Cells with a neighbour in a layer are in the next one. */
  void FrontRefinement::spread(const Discretisation &discretisation, int up_to,
                               std::vector<int> &layer) const
  {
    const std::size_t corners = std::size_t(1) << discretisation.dimension;
    std::vector<char> touched(discretisation.node_of_site.size());
    for(int reached = 0; reached < up_to; ++reached)
    {
      for(std::size_t c = 0; c < layer.size(); ++c)
        if(layer[c] == reached)
          for(std::size_t a = 0; a < corners; ++a)
            touched[discretisation.cells[corners * c + a]] = 1;
      for(std::size_t c = 0; c < layer.size(); ++c)
        for(std::size_t a = 0; a < corners && layer[c] == far; ++a)
          if(touched[discretisation.cells[corners * c + a]])
            layer[c] = reached + 1;
    }
  }

  /** Zero where the corners of a cell are not all of one phase. */
  std::vector<int>
  FrontRefinement::layers_from_front(const Discretisation &discretisation,
                                     const std::vector<double> &enthalpy, int up_to) const
  {
    const double latent = graph.enthalpy(0), negligible = share_of_round_off * latent;
    std::vector<double> phase(enthalpy.size());
    for(std::size_t i = 0; i < phase.size(); ++i)
      phase[i] = enthalpy[i] <= negligible            ? 0
                 : enthalpy[i] >= latent - negligible ? 1
                                                      : 0.5;
    const std::vector<double> at_site = by_site(discretisation, std::move(phase));
    const std::size_t corners = std::size_t(1) << discretisation.dimension;
    std::vector<int> layer(discretisation.cells.size() / corners, far);
    for(std::size_t c = 0; c < layer.size(); ++c)
    {
      double sum = 0;
      for(std::size_t a = 0; a < corners; ++a)
        sum += at_site[discretisation.cells[corners * c + a]];
      if(sum > 0 && sum < static_cast<double>(corners))
        layer[c] = 0;
    }
    spread(discretisation, up_to, layer);
    return layer;
  }

  bool FrontRefinement::finest_at_front(const Discretisation &discretisation,
                                        const std::vector<double> &enthalpy,
                                        int within) const
  {
    const std::vector<int> layer = layers_from_front(discretisation, enthalpy, within);
    const std::vector<int> left = mesh.halvings_left();
    for(std::size_t c = 0; c < layer.size(); ++c)
      if(layer[c] <= within && left[c] > 0)
        return false;
    return true;
  }

  std::vector<Wish> FrontRefinement::wishes(const Discretisation &discretisation,
                                            const std::vector<double> &enthalpy,
                                            const Scope &scope) const
  {
    constexpr int kept = layers + layers_kept;
    std::vector<int> layer = layers_from_front(discretisation, enthalpy, kept);
    std::vector<int> from_sources(layer.size(), far);
    for(const cases::PointSource &source : scene.sources)
      from_sources[mesh.cell_at(source.position)] = 0;
    spread(discretisation, kept, from_sources);
    std::vector<double> sensible(enthalpy.size());
    for(std::size_t i = 0; i < sensible.size(); ++i)
      sensible[i] = enthalpy[i] - std::clamp(enthalpy[i], 0., graph.enthalpy(0));
    const auto [least, largest] = std::ranges::minmax(sensible);
    const double allowed
        = smoothness * (largest - least) * discretisation.spacing / scene.domain.side();
    const std::vector<double> jumps
        = mesh.jumps(by_site(discretisation, std::move(sensible)));
    const std::vector<int> left = mesh.halvings_left();
    std::vector<Wish> result(layer.size(), Wish::keep);
    for(std::size_t c = 0; c < layer.size(); ++c)
    {
      const int nearest = std::min(layer[c], from_sources[c]);
      if(left[c] > 0 && (nearest <= layers || (scope.everywhere && jumps[c] > allowed)))
        result[c] = Wish::halve;
      else if(scope.join && nearest > kept && jumps[c] <= joined_below * allowed)
        result[c] = Wish::join;
    }
    return result;
  }

  bool FrontRefinement::halves(const std::vector<Wish> &wishes)
  {
    return std::ranges::find(wishes, Wish::halve) != wishes.end();
  }
} // namespace meltfront::reference_fem
