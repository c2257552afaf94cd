#ifndef meltfront_reference_fem_cut_sink_field_h
#define meltfront_reference_fem_cut_sink_field_h

#include <reference_fem/cut/background_mesh.h>

namespace meltfront::reference_fem::cut
{
  /**
   * The singular part of the solid's temperature about line sources,
   *
   *   S(x, t) = - sum_i p_i(t)/(2 pi k_s) ln(|x - x_i|/l),   l the domain's side,
   *
   * with p_i the power per length (W/m), negative for a sink. T - S is smooth.
   */
  class SinkField
  {
  public:
    /** @param smallest_distance at which S is evaluated (m): it is infinite at a source
     */
    SinkField(const cases::Scene &scene, double smallest_distance);

    double value(const Point &point, double time) const;

    /** K/m */
    Gradient gradient(const Point &point, double time) const;

    /** Integral of S over a rectangle (K m^2), in closed form: quadratures miss the
     * logarithm at a source by an amount that changes with the mesh. */
    double integral(const Point &lower, const Gradient &size, double time) const;

    /** Whether a power changes, so that S does. */
    bool varies() const
    {
      return varying;
    }

    /** Heat from the sources since the start (J/m). */
    double energy(double time) const;

    std::vector<Point> places;

  private:
    const cases::Scene &scene;
    double smallest_distance;
    bool varying = false;
  };
} // namespace meltfront::reference_fem::cut

#endif
