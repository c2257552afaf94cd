#include <cases/error.h>
#include <particles/core/arrangement.h>
#include <particles/scattered/node_set.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  using cases::BoundaryKind;
  using cases::Side;

  namespace
  {
    void require_box(const cases::Scene &scene, const std::string &method)
    {
      const cases::DomainShape shape = scene.domain.shape;
      if(shape != cases::DomainShape::slab && shape != cases::DomainShape::box)
        throw cases::Refusal(fmt::format(
            "{} spreads its nodes over slabs and boxes; the domain is neither", method));
      for(const Side side : scene.sides())
        if(scene.boundary(side).kind == BoundaryKind::periodic)
          throw cases::Refusal(fmt::format("{} has no periodic walls; {} is one", method,
                                           cases::to_string(side)));
    }

    /** A lattice with nodes on the walls. */
    class Lattice
    {
    public:
      Lattice(const cases::Domain &domain, int intervals_along_x)
        : domain(domain)
      {
        const double wanted = domain.side() / intervals_along_x;
        for(int d = 0; d < domain.dimension; ++d)
        {
          const double length = domain.upper[d] - domain.lower[d];
          intervals[d]
              = std::max(2, d == 0 ? intervals_along_x
                                   : static_cast<int>(std::lround(length / wanted)));
          spacing[d] = length / intervals[d];
        }
      }

      NodeSet nodes() const
      {
        NodeSet result;
        result.positions.dimension = domain.dimension;
        result.spacings = spacing;
        result.spacing = *std::ranges::max_element(spacing);
        std::array<int, 3> count{1, 1, 1};
        for(int d = 0; d < domain.dimension; ++d)
          count[d] = intervals[d] + 1;
        for(int k = 0; k < count[2]; ++k)
          for(int j = 0; j < count[1]; ++j)
            for(int i = 0; i < count[0]; ++i)
              add(result, {i, j, k});
        return result;
      }

    private:
      void add(NodeSet &nodes, const std::array<int, 3> &index) const
      {
        std::array<double, 3> point{};
        double weight = 1;
        unsigned int sides = 0;
        for(int d = 0; d < domain.dimension; ++d)
        {
          const bool first = index[d] == 0, last = index[d] == intervals[d];
          point[d] = last ? domain.upper[d] : domain.lower[d] + index[d] * spacing[d];
          weight *= first || last ? 0.5 * spacing[d] : spacing[d];
          if(first)
            sides |= 1U << (2 * d);
          if(last)
            sides |= 1U << (2 * d + 1);
        }
        if(sides == 0)
          nodes.inner.push_back(static_cast<std::uint32_t>(nodes.size()));
        nodes.positions.add(point);
        nodes.weights.push_back(weight);
        nodes.sides.push_back(static_cast<std::uint8_t>(sides));
      }

      const cases::Domain &domain;
      std::array<int, 3> intervals{};
      std::array<double, 3> spacing{};
    };

    void displace(NodeSet &nodes, double jitter_over_spacing, std::uint64_t seed)
    {
      const double spacing = *std::min_element(
          nodes.spacings.begin(), nodes.spacings.begin() + nodes.positions.dimension);
      std::size_t next = 0;
      std::vector<bool> movable(nodes.size());
      for(const std::uint32_t i : nodes.inner)
        movable[i] = true;
      jitter(nodes.positions, jitter_over_spacing * spacing, seed,
             [&](const std::array<double, 3> &) { return movable[next++]; });
    }

    /** Puts nodes onto the surface of an inclusion, and says on which side the others
     * are. */
    class InclusionSurface
    {
    public:
      InclusionSurface(const cases::Scene &scene, NodeSet &nodes)
        : scene(scene)
        , nodes(nodes)
        , step(1e-5 * nodes.spacing)
      {
      }

      void divide()
      {
        nodes.region.resize(nodes.size());
        for(std::size_t i = 0; i < nodes.size(); ++i)
        {
          const bool on_surface = snap(i);
          nodes.region[i] = on_surface                        ? Region::interface
                            : level(nodes.point(i)) < 0 ? Region::inside
                                                              : Region::outside;
        }
      }

    private:
      double level(const cases::Position &p) const
      {
        return scene.inclusion->level_set(p, 0);
      }

      /** Gradient along the walls that the node is on. */
      cases::Position gradient(std::size_t node, const cases::Position &p) const
      {
        cases::Position result{};
        for(int d = 0; d < nodes.positions.dimension; ++d)
        {
          if((nodes.sides[node] >> (2 * d) & 3U) != 0)
            continue;
          cases::Position before = p, behind = p;
          before[d] -= step;
          behind[d] += step;
          result[d] = (level(behind) - level(before)) / (2 * step);
        }
        return result;
      }

      bool inside_domain(const cases::Position &p) const
      {
        for(int d = 0; d < nodes.positions.dimension; ++d)
          if(p[d] < scene.domain.lower[d] || p[d] > scene.domain.upper[d])
            return false;
        return true;
      }

      bool snap(std::size_t node)
      {
        constexpr int most_iterations = 20;
        constexpr double near = 1e-12;
        constexpr double tie = 1e-6; // above the round-off of the gradient
        const cases::Position start = nodes.point(node);
        cases::Position p = start;
        double distance = 0;
        for(int iteration = 0; iteration < most_iterations; ++iteration)
        {
          const cases::Position slope = gradient(node, p);
          const double squared
              = slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2];
          if(squared == 0)
            return level(p) == 0;
          distance = level(p) / std::sqrt(squared);
          // Of two nodes half a spacing off only the one outside is moved.
          if(iteration == 0
             && !(distance > -0.5 * nodes.spacing * (1 - tie)
                  && distance <= 0.5 * nodes.spacing * (1 + tie)))
            return false;
          if(std::abs(distance) <= near * nodes.spacing)
            break;
          for(int d = 0; d < 3; ++d)
            p[d] -= distance * slope[d] / std::sqrt(squared);
        }
        if(std::abs(distance) > 1e-6 * nodes.spacing || !inside_domain(p))
          return false;
        for(int d = 0; d < nodes.positions.dimension; ++d)
          nodes.positions.position[d][node] = p[d];
        return true;
      }

      const cases::Scene &scene;
      NodeSet &nodes;
      double step;
    };
  } // namespace

  const std::vector<std::string> &arrangement_names()
  {
    static const std::vector<std::string> names{"lattice", "jittered", "random",
                                                "relaxed"};
    return names;
  }

  NodeSet arrange_nodes(const cases::Scene &scene, int intervals,
                        NodeArrangement arrangement, double jitter_over_spacing,
                        std::uint64_t seed, const std::string &method,
                        const std::function<void(NodeSet &)> &relax)
  {
    require_box(scene, method);
    if(intervals < 2)
      throw cases::Refusal(fmt::format(
          "{} needs at least two intervals along the domain, not {}", method, intervals));
    NodeSet nodes = Lattice(scene.domain, intervals).nodes();
    if(arrangement == NodeArrangement::jittered)
      displace(nodes, jitter_over_spacing, seed);
    if(arrangement == NodeArrangement::random || arrangement == NodeArrangement::relaxed)
      scatter(nodes.positions, nodes.inner, scene.domain.lower, scene.domain.upper, seed);
    if(arrangement == NodeArrangement::relaxed && !relax)
      throw cases::Refusal(fmt::format("{} relaxes no nodes", method));
    if(arrangement == NodeArrangement::relaxed)
      relax(nodes);
    if(scene.inclusion)
      InclusionSurface(scene, nodes).divide();
    return nodes;
  }

  double WallCondition::value(const cases::Position &position, const LinearStep &step,
                              const GivenValues &values) const
  {
    double sum = 0;
    for(const cases::Boundary *wall : walls)
    {
      if(!wall || wall->kind == BoundaryKind::insulated)
        continue;
      if(fixed)
        return wall->value(position, step.at);
      const double given = values.constraint(*wall, position, step);
      sum += wall->kind == BoundaryKind::heat_transfer
                 ? wall->heat_transfer_coefficient * given
                 : given;
    }
    return sum;
  }

  WallCondition wall_condition(const cases::Scene &scene, const NodeSet &nodes,
                               std::size_t node)
  {
    WallCondition condition;
    std::size_t count = 0;
    for(int s = 0; s < 2 * nodes.positions.dimension; ++s)
    {
      if((nodes.sides[node] >> s & 1U) == 0)
        continue;
      const cases::Boundary &boundary = scene.boundary(static_cast<Side>(s));
      if(boundary.kind == BoundaryKind::fixed_temperature)
      {
        condition = {};
        condition.fixed = true;
        condition.walls[0] = &boundary;
        return condition;
      }
      condition.direction[s / 2] += s % 2 == 1 ? 1 : -1;
      condition.transfer += boundary.heat_transfer_coefficient;
      condition.walls[count++] = &boundary;
    }
    return condition;
  }
} // namespace meltfront::particles
