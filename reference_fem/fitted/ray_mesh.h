#ifndef meltfront_reference_fem_fitted_ray_mesh_h
#define meltfront_reference_fem_fitted_ray_mesh_h

#include <reference_fem/fitted/front_surface.h>

#include <limits>
#include <vector>

namespace meltfront::reference_fem::fitted
{
  /**
   * A layer of cells across the rays. Its points lie at r = a + c h on a ray whose front
   * is at h, with a and c linear between the layer's two faces.
   */
  struct Layer
  {
    int phase = 0; ///< 0 at the inner wall or the centre, 1 beyond the front
    std::array<double, 2> fixed{};   ///< a at the inner and the outer face (m)
    std::array<double, 2> carried{}; ///< c there

    double a(double zeta) const
    {
      return fixed[0] + (fixed[1] - fixed[0]) * zeta;
    }

    double c(double zeta) const
    {
      return carried[0] + (carried[1] - carried[0]) * zeta;
    }
  };

  /**
   * Shares of an interval taken by @p cells cells of which each is @p ratio times as wide
   * as its neighbour towards the front (1: equal). From 0 to 1, the front at the end that
   * @p front_first says.
   */
  std::vector<double> graded_shares(int cells, double ratio, bool front_first);

  /**
   * The mesh of rays and layers, and its numbering: a node for each ray and each level
   * across, ray by ray. The front is a level; where the rays meet at the centre, their
   * innermost nodes are one.
   */
  class RayMesh
  {
  public:
    static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    /** Two phases that the front separates, in shares of their lengths. */
    RayMesh(FrontSurface surface, double inner, double outer,
            const std::vector<double> &inner_shares,
            const std::vector<double> &outer_shares);

    /** One phase from the inner to the outer wall. */
    RayMesh(FrontSurface surface, double inner, double outer,
            const std::vector<double> &shares);

    FrontSurface surface;
    double inner, outer; ///< r at the walls (m); an inner wall at 0 of round rays is the
                         ///< centre
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

    /** Levels at the walls and at the front; none where there is no front. */
    unsigned int front_level() const
    {
      return front_layer == 0 ? none : front_layer * surface.degree;
    }

    bool has_front() const
    {
      return front_layer > 0;
    }

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

    /** The node that holds the front's coordinate on a ray. */
    unsigned int front_node(unsigned int ray) const
    {
      return has_front() ? node(ray, front_level()) : none;
    }

    /** a and c of a level: r = a + c h. */
    std::array<double, 2> place(unsigned int level) const;

    /** The point at r on a ray. */
    cases::Position position(unsigned int ray, double r) const;

  private:
    unsigned int front_layer = 0; ///< the first layer beyond the front; 0: no front
  };
} // namespace meltfront::reference_fem::fitted

#endif
