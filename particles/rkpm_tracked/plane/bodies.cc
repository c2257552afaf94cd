#include <particles/rkpm_tracked/plane/bodies.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Samples beyond a wall that go with a body at it: some two spacings. */
    constexpr int layers_beyond_walls = 12;

    /** Samples between two that are connected: half a spacing. */
    constexpr long connecting = 3;

    /** Call use(neighbour) for the samples no farther along each coordinate. */
    template <typename Use>
    void visit_neighbours(const SampleLattice &lattice, std::size_t sample, long reach,
                          Use &&use)
    {
      const long column = static_cast<long>(sample) % lattice.columns,
                 row = static_cast<long>(sample) / lattice.columns;
      for(long j = std::max(row - reach, 0L);
          j <= std::min(row + reach, lattice.rows - 1); ++j)
        for(long i = std::max(column - reach, 0L);
            i <= std::min(column + reach, lattice.columns - 1); ++i)
          use(static_cast<std::size_t>(j * lattice.columns + i));
    }
  } // namespace

  SmallBodies::SmallBodies(const PlaneNodes &nodes, const PlaneLevelSet &level_set,
                           double least_area)
    : nodes(nodes)
    , body_of(nodes.lattice.inside.size(), 0)
  {
    find(level_set, least_area);
    if(!found.empty())
      spread_beyond_walls();
  }

  void SmallBodies::find(const PlaneLevelSet &level_set, double least_area)
  {
    const SampleLattice &lattice = nodes.lattice;
    const double sample_area = lattice.step.prod();
    std::vector<signed char> side(lattice.inside.size(), 0); // 0: beyond, or done with
    for(std::size_t s = 0; s < side.size(); ++s)
      if(lattice.inside[s])
      {
        side[s] = level_set(lattice.place(s)) <= 0 ? -1 : 1;
        ++(side[s] < 0 ? n_solid : n_liquid);
      }
    std::vector<std::size_t> members;
    for(std::size_t first = 0; first < side.size(); ++first)
    {
      const signed char phase = side[first];
      if(phase == 0)
        continue;
      members.assign(1, first);
      side[first] = 0;
      PlanePoint sum(0, 0);
      for(std::size_t m = 0; m < members.size(); ++m)
      {
        sum += lattice.place(members[m]);
        visit_neighbours(lattice, members[m], connecting,
                         [&](std::size_t neighbour)
                         {
                           if(side[neighbour] != phase)
                             return;
                           side[neighbour] = 0;
                           members.push_back(neighbour);
                         });
      }
      const double area = sample_area * static_cast<double>(members.size());
      if(area >= least_area)
        continue;
      found.push_back({phase < 0, area, sum / static_cast<double>(members.size())});
      for(const std::size_t member : members)
        body_of[member] = static_cast<std::uint32_t>(found.size());
    }
  }

  void SmallBodies::spread_beyond_walls()
  {
    std::vector<std::size_t> layer, next;
    for(std::size_t s = 0; s < body_of.size(); ++s)
      if(body_of[s] != 0)
        layer.push_back(s);
    for(int depth = 0; depth < layers_beyond_walls; ++depth, layer.swap(next))
    {
      next.clear();
      for(const std::size_t sample : layer)
        visit_neighbours(nodes.lattice, sample, 1,
                         [&](std::size_t neighbour)
                         {
                           if(nodes.lattice.inside[neighbour] || body_of[neighbour] != 0)
                             return;
                           body_of[neighbour] = body_of[sample];
                           next.push_back(neighbour);
                         });
    }
  }

  const Body *SmallBodies::at(const PlanePoint &place) const
  {
    const std::uint32_t body = body_of[nodes.lattice.nearest(place)];
    return body == 0 ? nullptr : &found[body - 1];
  }
} // namespace meltfront::particles::rkpm_tracked
