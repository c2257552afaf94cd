#include <particles/rkpm_tracked/plane/stencils.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    constexpr double least_dilation = 2.2; ///< spacings
    constexpr double beyond_neighbour = 1.3;
    constexpr double enlargement = 1.2;
    constexpr int most_enlargements = 4;

    /** Spacings within which neighbours are looked for first. */
    constexpr double first_search = 3.2;
    constexpr int most_searches = 4;

    /** Below this ratio of the factor's diagonal entries derivatives are not determined
     * well: the moment matrix has a condition number of its inverse square. */
    constexpr double least_ratio = 1e-3;

    /** Spacings inside of its phase from which a front particle looks. */
    constexpr double sight_offset = 0.02;

    rkpm::MomentSettings settings_of(int order)
    {
      rkpm::MomentSettings settings;
      settings.variant = rkpm::Variant::derivative_free;
      settings.kernel = KernelShape::cubic_spline;
      settings.dimension = 2;
      settings.order = order;
      settings.derivatives = 2;
      return settings;
    }
  } // namespace

  double PlaneStencil::apply(Derivative derivative, std::span<const double> values) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < columns.size(); ++i)
      sum += weights[derivative][i] * values[columns[i]];
    return sum;
  }

  StencilMaker::StencilMaker(const PlaneNodes &nodes, int order)
    : nodes(nodes)
    , order(order)
  {
    for(int lower = 1; lower <= order; ++lower)
      engines.emplace_back(settings_of(lower));
    points.dimension = 2;
    for(const PlanePoint &place : nodes.position)
      points.add({place.x(), place.y(), 0});
  }

  void StencilMaker::nodes_moved()
  {
    for(std::size_t i = 0; i < nodes.size(); ++i)
      for(int d = 0; d < 2; ++d)
        points.position[d][i] = nodes.position[i][d];
  }

  void StencilMaker::set_front(const PlaneFront &new_front, const FrontIndex &new_index,
                               std::span<const NodePhase> new_phases)
  {
    front = &new_front;
    index = &new_index;
    phases = new_phases;
    for(int d = 0; d < 2; ++d)
      points.position[d].resize(nodes.size());
    for(const PlanePoint &place : front->position)
      points.add({place.x(), place.y(), 0});
    front_bins = PlaneBins(front->position, nodes.spacing);
  }

  /** Whether a film of the other phase lies between two points of a phase. */
  bool StencilMaker::hidden(const PlanePoint &from, std::uint32_t column,
                            bool solid) const
  {
    const double inwards = (solid ? 1 : -1) * sight_offset * nodes.spacing;
    // Points on the front look from a little inside of their phase.
    const auto seen_from = [&](const PlanePoint &place, std::size_t particle)
    { return PlanePoint(place + inwards * front->normal[particle]); };
    const PlanePoint start = own_particle >= 0 ? seen_from(from, own_particle) : from;
    if(column < nodes.size())
      return index->film_between(start, nodes.position[column]);
    const std::size_t particle = column - nodes.size();
    return index->film_between(start, seen_from(front->position[particle], particle));
  }

  void StencilMaker::gather(const PlanePoint &centre, NodePhase phase, double radius)
  {
    candidates.clear();
    mixed = false;
    own_particle = -1;
    front_bins.visit(
        centre, radius,
        [&](std::uint32_t particle, double square)
        {
          mixed = true;
          if(square == 0)
            own_particle = particle;
          if(front->active[particle])
            candidates.push_back(
                {std::sqrt(square), static_cast<std::uint32_t>(nodes.size() + particle)});
        });
    nodes.bins.visit(centre, radius,
                     [&](std::uint32_t node, double square)
                     {
                       if(phases[node] == phase)
                         candidates.push_back({std::sqrt(square), node});
                       else
                         mixed = true;
                     });
    if(mixed)
      std::erase_if(candidates,
                    [&](const Candidate &candidate) {
                      return hidden(centre, candidate.column, phase == NodePhase::solid);
                    });
    std::ranges::sort(candidates,
                      [](const Candidate &a, const Candidate &b) {
                        return a.distance < b.distance
                               || (a.distance == b.distance && a.column < b.column);
                      });
  }

  bool StencilMaker::fit(const PlanePoint &centre, double dilation, int basis_order)
  {
    neighbours.clear();
    for(const Candidate &candidate : candidates)
      if(candidate.distance < dilation)
        neighbours.push_back(candidate.column);
    std::ranges::sort(neighbours);
    rkpm::MomentEngine &engine = engines[basis_order - 1];
    return engine.evaluate({centre.x(), centre.y(), 0}, points, neighbours, dilation)
           && engine.rank_ratio() >= least_ratio;
  }

  void StencilMaker::make(const PlanePoint &centre, NodePhase phase,
                          PlaneStencil &stencil)
  {
    const double h = nodes.spacing;
    const std::size_t wanted = 2 * engines[order - 1].basis().size();
    stencil.dilation = 0;
    double radius = first_search * h;
    for(int search = 0; search < most_searches && stencil.dilation == 0;
        ++search, radius *= 1.5)
    {
      gather(centre, phase, radius);
      // A particle at the centre itself is not a neighbour.
      const bool own = !candidates.empty() && candidates.front().distance < 1e-12 * h;
      const std::size_t place = own ? wanted : wanted - 1;
      const double dilation
          = place < candidates.size() ? std::max(
                least_dilation * h, beyond_neighbour * candidates[place].distance)
                                      : radius;
      if(dilation < radius || search + 1 == most_searches)
        stencil.dilation = std::min(dilation, radius);
    }
    stencil.pure = !mixed;
    int used = order;
    bool determined = fit(centre, stencil.dilation, used);
    for(int i = 0; !determined && i < most_enlargements; ++i)
    {
      stencil.dilation *= enlargement;
      gather(centre, phase, stencil.dilation);
      determined = fit(centre, stencil.dilation, used);
    }
    while(!determined && --used > 0)
      determined = fit(centre, stencil.dilation, used);
    stencil.order = used;
    last_engine = used - 1;
    stencil.columns = neighbours;
    for(int d = 0; d < 6; ++d)
    {
      stencil.weights[d].assign(neighbours.size(), 0.);
      if(used > 0)
      {
        const auto weights = engines[used - 1].weights(d);
        stencil.weights[d].assign(weights.begin(), weights.end());
      }
    }
    if(used == 0 && !neighbours.empty())
      std::ranges::fill(stencil.weights[value_of], 1. / neighbours.size());
  }

  double StencilMaker::condition_number() const
  {
    return last_engine < 0 ? std::numeric_limits<double>::infinity()
                           : engines[last_engine].condition_number();
  }
} // namespace meltfront::particles::rkpm_tracked
