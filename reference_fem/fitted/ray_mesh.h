#ifndef meltfront_reference_fem_fitted_ray_mesh_h
#define meltfront_reference_fem_fitted_ray_mesh_h

#include <reference_fem/fitted/front_surface.h>

#include <limits>
#include <utility>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /**
   * A layer of cells across the rays, in one of the intervals into which the fronts of a
   * ray divide it. Its points lie at r = a + c_1 h_1 + c_2 h_2, h the coordinates of the
   * fronts that the interval ends at, with a and c linear between the layer's two faces.
   */
  struct Layer
  {
    unsigned int interval = 0;     ///< 0 at the inner wall or the centre
    std::array<double, 2> fixed{}; ///< a at the inner and the outer face (m)
    /** c there, of each front in the order of RayMesh::fronts_of(). */
    std::vector<std::array<double, 2>> carried{};
  };

  /**
   * Shares of an interval taken by @p cells cells of which each is @p ratio times as wide
   * as its neighbour towards the front (1: equal). From 0 to 1, the front at the end that
   * @p front_first says.
   */
  std::vector<double> graded_shares(int cells, double ratio, bool front_first);

  /**
   * The mesh of rays and layers, and its numbering: a node for each ray and each level
   * across, ray by ray. Fronts are levels, numbered from the inner end on; where the rays
   * meet at the centre, their innermost nodes are one.
   */
  class RayMesh
  {
  public:
    static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    /** Intervals that fronts separate, by the shares of their lengths at which cells
     * begin and end. */
    RayMesh(FrontSurface surface, double inner, double outer,
            std::vector<std::vector<double>> shares);

    /** One phase from the inner to the outer wall. */
    RayMesh(FrontSurface surface, double inner, double outer,
            const std::vector<double> &shares)
      : RayMesh(std::move(surface), inner, outer,
                std::vector<std::vector<double>>(1, shares))
    {
    }

    FrontSurface surface;
    double inner, outer; ///< r at the walls (m); an inner wall at 0 of round rays is the
                         ///< centre
    std::vector<std::vector<double>> shares; ///< of the cells, by interval
    std::vector<Layer> layers;

    /** The rays meet at their inner ends. */
    bool has_centre() const
    {
      return surface.exponent > 0 && inner == 0;
    }

    unsigned int n_levels() const
    {
      return static_cast<unsigned int>(layers.size()) * surface.degree + 1;
    }

    unsigned int n_fronts() const
    {
      return static_cast<unsigned int>(front_levels.size());
    }

    bool has_front() const
    {
      return !front_levels.empty();
    }

    unsigned int front_level(unsigned int front = 0) const
    {
      return front_levels[front];
    }

    /** The front that a level is; none for one within an interval or at a wall. */
    unsigned int front_at(unsigned int level) const;

    /** The interval in which a level lies; a front belongs to the one before it. */
    unsigned int interval_of(unsigned int level) const;

    /** The fronts at which an interval ends: none, one or two. */
    std::vector<unsigned int> fronts_of(unsigned int interval) const;

    unsigned int n_nodes() const
    {
      return node(surface.n_rays() - 1, n_levels() - 1) + 1;
    }

    unsigned int node(unsigned int ray, unsigned int level) const
    {
      if(!has_centre())
        return ray * n_levels() + level;
      return level == 0 ? 0 : ray * (n_levels() - 1) + level;
    }

    /** The node that holds a front's coordinate on a ray. */
    unsigned int front_node(unsigned int ray, unsigned int front = 0) const
    {
      return node(ray, front_levels[front]);
    }

    /** The place of a level: a, and c of the fronts that carry it. */
    struct Place
    {
      double fixed = 0;
      std::vector<std::pair<unsigned int, double>> carried; ///< front, c
    };
    Place place(unsigned int level) const;

    /** The point at r on a ray. */
    cases::Position position(unsigned int ray, double r) const;

  private:
    std::vector<unsigned int> front_levels;
  };
} // namespace meltfront::reference_fem::fitted

#endif
