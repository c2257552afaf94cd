#ifndef meltfront_particles_rkpm_tracked_plane_nodes_h
#define meltfront_particles_rkpm_tracked_plane_nodes_h

#include <cases/scene.h>
#include <particles/rkpm_tracked/plane/bins.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** Points in rows that the areas of nodes are sampled at. */
  struct SampleLattice
  {
    PlanePoint first{0, 0}, step{1, 1}; ///< m
    long columns = 0, rows = 0;
    std::vector<char> inside; ///< whether within the domain, row by row

    PlanePoint place(std::size_t sample) const
    {
      const auto number = static_cast<long>(sample);
      return first
             + PlanePoint(static_cast<double>(number % columns) * step.x(),
                          static_cast<double>(number / columns) * step.y());
    }

    /** Any sample within the domain. */
    std::size_t first_inside() const
    {
      return std::find(inside.begin(), inside.end(), 1) - inside.begin();
    }

    /** The sample nearest to a place, also for places beyond all. */
    std::size_t nearest(const PlanePoint &place) const
    {
      const long i = std::lround((place.x() - first.x()) / step.x()),
                 j = std::lround((place.y() - first.y()) / step.y());
      return static_cast<std::size_t>(std::clamp(j, 0L, rows - 1) * columns
                                      + std::clamp(i, 0L, columns - 1));
    }
  };

  /** The part of a wall that a node on it stands for. */
  struct WallPiece
  {
    const cases::Boundary *boundary = nullptr;
    PlanePoint normal{0, 0}; ///< outward
    double length = 0;       ///< m
  };

  /** A node on a wall; at a corner of a box two walls meet. */
  struct WallNode
  {
    std::uint32_t node = 0;
    std::array<WallPiece, 2> pieces;
    int n_pieces = 1;

    /** The piece that holds a temperature, or null. */
    const WallPiece *dirichlet() const;
  };

  /** How background nodes are laid. */
  struct NodeLayout
  {
    double jitter = 0; ///< largest displacement of inner nodes over the spacing
    std::uint64_t seed = 1;
  };

  /**
   * The background nodes of a plane domain: a square lattice inside, and particles along
   * its walls, straight or round, at about the same distance.
   */
  class PlaneNodes
  {
  public:
    /**
     * @param scene outlives the nodes
     * @param n lattice spacings along the domain's side
     * @throws cases::Refusal for a domain that is not plane, for periodic walls, and for
     * a lattice too coarse for the domain
     */
    PlaneNodes(const cases::Scene &scene, int n, const NodeLayout &layout);

    PlaneNodes(const PlaneNodes &) = delete;
    PlaneNodes &operator=(const PlaneNodes &) = delete;

    std::size_t size() const
    {
      return position.size();
    }

    /** Distance to the nearest wall (m), negative outside of the domain. */
    double wall_distance(const PlanePoint &point) const;

    /** Put nodes to other places, none farther than a spacing from where it is; areas
     * follow. */
    void move(const std::vector<PlanePoint> &places);

    /** The samples that make up a node's area. */
    std::span<const PlanePoint> samples_of(std::size_t node) const
    {
      return std::span(samples).subspan(sample_offsets[node],
                                        sample_offsets[node + 1] - sample_offsets[node]);
    }

    /** Corners of the domain's bounding box (m). */
    PlanePoint lower{0, 0}, upper{0, 0};

    double spacing = 0; ///< m
    double area = 0;    ///< of the domain (m^2)
    std::vector<PlanePoint> position;
    std::vector<WallNode> walls;
    std::vector<std::int32_t> wall_of_node; ///< -1 inside
    std::vector<double> weight;       ///< area nearer to each node than to others (m^2)
    std::vector<PlanePoint> centroid; ///< of that area
    PlaneBins bins;

    /** Points evenly over the domain that make up the nodes' areas: those of node i are
     * sample_offsets[i] <= s < sample_offsets[i + 1]. */
    std::vector<std::size_t> sample_offsets;
    std::vector<PlanePoint> samples;
    double sample_spacing = 0;
    SampleLattice lattice; ///< that the samples are of

  private:
    void lay_box(int n);
    void lay_rims(int n);
    void lay_outline(int n);
    void fill_inside(const PlanePoint &origin, double least_wall_distance);
    void add_wall_node(const PlanePoint &place, const WallNode &wall);
    void displace(const NodeLayout &layout);
    void share_area();
    void assign(const std::vector<PlanePoint> &free,
                std::vector<std::vector<PlanePoint>> &of_node) const;
    void gather_samples(const std::vector<std::vector<PlanePoint>> &of_node);

    const cases::Scene &scene;
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
