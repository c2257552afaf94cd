#ifndef meltfront_reference_fem_cut_conservative_curvature_h
#define meltfront_reference_fem_cut_conservative_curvature_h

#include <reference_fem/cut/conservative/front.h>

#include <array>
#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** Nodal temperatures over the melting temperature, by phase; of the solid without the
   * singular part of sources. Meaningful at nodes of active triangles. */
  using Temperatures = std::array<Values, 2>;

  /** Temperatures of a front, as far as they are known. */
  struct Guess
  {
    Temperatures temperatures;
    Values level_set;
    std::vector<Segment> front;
    std::vector<double> powers; ///< of line sources (W/m)
  };

  /** Second derivatives of a temperature (K/m^2). */
  struct Curvature
  {
    double xx = 0, xy = 0, yy = 0;

    double trace() const
    {
      return xx + yy;
    }
  };

  /** What the linear interpolant of a quadratic function misses in a triangle: nothing at
   * its corners. */
  class Remainder
  {
  public:
    Remainder(const Curvature &curvature, const Triangle &triangle,
              const std::vector<Point> &nodes);

    double value(const Point &point) const;      ///< K
    Gradient gradient(const Point &point) const; ///< K/m

  private:
    double quadratic(const Point &point) const;

    const Curvature curvature;
    const Point centre;
    double at_centre = 0;
    Gradient slope;
  };

  /** A known temperature of the unknown's kind at the front. */
  struct FrontSample
  {
    unsigned int node; ///< the first of the square that holds it
    Point place;
    double value;  ///< K
    double weight; ///< of a node's
  };

  /**
   * Second derivatives of a phase's temperature in triangles, from parabolas that are
   * fitted (least squares) to its nodes and to the front's samples within 2.5 spacings of
   * the triangle's centre, or within as many more as it takes to find ten. Where these do
   * not lie on a parabola the derivatives fade: by s^2/(s^2 + 4 r^2), s the size of the
   * second differences over a spacing and r the root mean square of what the fit misses.
   */
  class CurvatureFit
  {
  public:
    /** @param inside by node, whether it belongs to a triangle that is whole
     * @param front samples sorted by node */
    CurvatureFit(const TriangleMesh &mesh, const std::vector<char> &inside, Phase phase,
                 const Guess &guess, std::vector<FrontSample> front);

    Curvature operator()(const Triangle &triangle);

  private:
    struct Sample
    {
      Gradient place; ///< spacings
      double value, weight;
    };

    void find_samples(const Point &centre);

    const TriangleMesh &mesh;
    const std::vector<char> &inside;
    const double sense; ///< of the level set in the phase
    const Guess &guess;
    const std::vector<FrontSample> front;
    std::vector<Sample> found; ///< about the triangle that is fitted
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
