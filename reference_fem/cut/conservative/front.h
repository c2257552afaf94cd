#ifndef meltfront_reference_fem_cut_conservative_front_h
#define meltfront_reference_fem_cut_conservative_front_h

#include <reference_fem/cut/conservative/triangle_mesh.h>
#include <reference_fem/cut/cut_geometry.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** A triangle whose nodes lie on both sides of the front. */
  struct CutTriangle
  {
    unsigned int triangle;
    const Triangle *place;
    std::array<Polygon, 2> part; ///< by Phase
    Segment segment;             ///< of the front, in the domain
    bool crossed;                ///< whether there is such a segment
    Gradient normal;             ///< into the liquid
    LinearFunction level_set;
  };

  /** The zero line of a piecewise linear level set that is negative in the solid, and
   * what it divides the domain into. */
  class Front
  {
  public:
    /** @param level_set not zero at any node, see without_zeros() */
    Front(const TriangleMesh &mesh, const Values &level_set);

    std::vector<Location> location; ///< by triangle
    std::vector<CutTriangle> cut;
    /** Integral of each hat over the solid (m^2): the one measure of it for the law of
     * the front, the books and reports. */
    Values solid_area;

    double area(Phase phase) const
    {
      return areas[index(phase)];
    }

    /** Of a triangle that is cut. */
    const CutTriangle &cut_at(unsigned int triangle) const
    {
      return cut[static_cast<std::size_t>(number_of_cut[triangle])];
    }

    /** The part of a triangle that lies in a phase. */
    const Polygon &part(unsigned int triangle, Phase phase) const;

  private:
    const TriangleMesh &mesh;
    std::vector<int> number_of_cut; ///< by triangle; -1: not cut
    std::array<double, 2> areas{};
  };

  /** Values with those that are zero, as far as the spacing tells, shifted off it. */
  Values without_zeros(Values level_set, double spacing);

  /** Integral of each hat over the domain (m^2). */
  Values volume_of_hats(const TriangleMesh &mesh);

  /** Of the front, in the domain; none where it only passes beyond a rim. */
  std::vector<Segment> segments_of(const Front &front);

  /** The front's normal where it is nearest to a node, by node; zero where it is farther
   * than a reach. */
  std::vector<Gradient> nearest_normals(const TriangleMesh &mesh, const Front &front,
                                        double reach);

  /** Signed distances of nodes to segments, up to a reach; beyond it that reach.
   * @param signs of the values are those of the result */
  Values distances(const TriangleMesh &mesh, const std::vector<Segment> &segments,
                   const Values &signs, double reach);

  /**
   * A signed distance at the nodes of triangles that are not cut, up to a reach; beyond
   * it that reach. Nodes of cut triangles keep their values, so that the front does not
   * move.
   */
  Values with_distances(const TriangleMesh &mesh, const Front &front,
                        const Values &level_set, double reach);
} // namespace meltfront::reference_fem::cut::conservative

#endif
