#ifndef meltfront_reference_fem_cut_conservative_line_sources_h
#define meltfront_reference_fem_cut_conservative_line_sources_h

#include <reference_fem/cut/conservative/polygon.h>

#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /**
   * The singular part of the solid's temperature about line sources of given powers p_i
   * (W/m, negative for sinks),
   *
   *   S(x) = - sum_i p_i/(2 pi k_s) ln(|x - x_i|/l),   l the domain's side.
   */
  class LineSources
  {
  public:
    /** @param smallest_distance at which S is evaluated (m) */
    LineSources(const cases::Scene &scene, double smallest_distance);

    /** Powers at a time (W/m). */
    std::vector<double> powers(double time) const;

    /** Powers that, after some for a share of the step, give the step's heat exactly. */
    std::vector<double> remaining_powers(const std::vector<double> &first, double share,
                                         double begin, double end) const;

    /** The point, or one at the smallest distance where it is nearer to a source. */
    Point off(Point point) const;

    double value(const Point &point, const std::vector<double> &powers) const;

    /** K/m */
    Gradient gradient(const Point &point, const std::vector<double> &powers) const;

    /** Integral of k_s dS/dn over a segment, by the angle under which a source sees it:
     * over a closed line about a source the sum is its power, negative, to round-off
     * (W/m). */
    double flux(const Segment &segment, const Gradient &normal,
                const std::vector<double> &powers) const;

    std::vector<Point> places;

  private:
    const cases::Scene &scene;
    double smallest_distance;
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
