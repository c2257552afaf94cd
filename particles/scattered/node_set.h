#ifndef meltfront_particles_scattered_node_set_h
#define meltfront_particles_scattered_node_set_h

#include <cases/method.h>
#include <cases/scene.h>
#include <particles/core/particle_storage.h>
#include <particles/scattered/given_values.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace meltfront::particles
{
  /** How nodes are spread over a domain. */
  enum class NodeArrangement
  {
    lattice,
    jittered, ///< a lattice whose inner nodes are displaced at random
    random,   ///< as many inner nodes as the lattice has, uniformly at random
    relaxed   ///< the random ones after relaxation
  };

  /** The words for them, in the order of the enumeration. */
  const std::vector<std::string> &arrangement_names();

  /** On which side of the surface of an inclusion a node is. */
  enum class Region : std::uint8_t
  {
    outside,
    inside,
    interface ///< on the surface
  };

  /**
   * Nodes of a slab or a box: a lattice with nodes on the walls, whose inner nodes may be
   * arranged otherwise. Nodes nearer than half a spacing to the surface of an inclusion
   * are moved onto it.
   */
  struct NodeSet
  {
    ParticleStorage positions;
    std::vector<double> weights;      ///< volume of each, the sum is the domain's (m^d)
    std::vector<std::uint32_t> inner; ///< numbers of the nodes not on a wall, ascending
    std::vector<std::uint8_t> sides;  ///< of each node: bit s for a wall of Side s
    std::vector<Region> region;       ///< empty without an inclusion
    std::array<double, 3> spacings{}; ///< of the lattice along x, y, z (m)
    double spacing = 0;               ///< h of tables: their largest (m)

    std::size_t size() const
    {
      return positions.size();
    }

    cases::Position point(std::size_t node) const
    {
      return positions.point(node);
    }
  };

  /**
   * @param intervals of the lattice along x; along y and z as many as make the spacings
   * as equal as whole numbers allow
   * @param jitter largest displacement over the spacing, of NodeArrangement::jittered
   * @param relax moves the inner nodes of NodeArrangement::relaxed, which are random
   * @throws Refusal for a domain that is neither slab nor box, or with periodic walls.
   */
  NodeSet arrange_nodes(const cases::Scene &scene, int intervals,
                        NodeArrangement arrangement, double jitter, std::uint64_t seed,
                        const std::string &method,
                        const std::function<void(NodeSet &)> &relax = {});

  /**
   * What holds at a node on one or more walls: its temperature, or
   *
   *   direction . k grad T + transfer * T = value,
   *
   * summed over the walls that meet there (outward normals; flux, heat transfer with its
   * ambient temperature, or insulation).
   */
  struct WallCondition
  {
    bool fixed = false;
    std::array<double, 3> direction{};
    double transfer = 0; ///< W/(m^2 K)
    std::array<const cases::Boundary *, 3> walls{};

    /** The right-hand side of a step: temperature, or W/m^2. */
    double value(const cases::Position &position, const LinearStep &step,
                 const GivenValues &given) const;
  };

  /** A node where one of its walls prescribes the temperature takes that. */
  WallCondition wall_condition(const cases::Scene &scene, const NodeSet &nodes,
                               std::size_t node);
} // namespace meltfront::particles

#endif
