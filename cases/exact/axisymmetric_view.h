#ifndef meltfront_cases_exact_axisymmetric_view_h
#define meltfront_cases_exact_axisymmetric_view_h

#include <cases/exact_solution.h>

#include <functional>
#include <memory>

namespace meltfront::cases
{
  /**
   * A solution in space that does not vary around an axis, in the half section of an
   * axisymmetric body: x is the distance from the axis and y the height along it.
   */
  class AxisymmetricView : public ExactSolution
  {
  public:
    /** What of a time is measured over the whole body. */
    using Measure = std::function<double(double time)>;

    /**
     * @param solution in space
     * @param point where in it a point (x, y) of the half section is found
     * @param solid_volume in the whole body (m^3)
     * @param front_area in the whole body (m^2)
     */
    AxisymmetricView(std::shared_ptr<const ExactSolution> solution,
                     std::function<Position(const Position &)> point,
                     Measure solid_volume, Measure front_area);

    /** Of a solution about the same axis that does not vary along it, in a body between
     * two radii and of some height (m). */
    static std::shared_ptr<const AxisymmetricView>
    of_cylinder(std::shared_ptr<const ExactSolution> solution, double inner_radius,
                double radius, double height);

    std::string description() const override;
    Symmetry symmetry() const override;
    bool has_front() const override;
    bool depends_on_one_coordinate() const override;
    double start_time() const override;
    bool solid_at_origin() const override;

    using ExactSolution::solid_fraction;
    using ExactSolution::solid_volume;
    using ExactSolution::temperature;
    double temperature(const Position &position, double time) const override;
    double solid_fraction(const Position &position, double time) const override;
    double signed_distance(const Position &position, double time) const override;
    double volumetric_source(const Position &position, double time) const override;
    double solid_volume(double time) const override;
    double front_area(double time) const override;

    // Of one coordinate nothing depends: not a number.
    double temperature(double coordinate, double time) const override;
    double front(double time) const override;
    double heat_content(double lower, double upper, double time) const override;

  private:
    std::shared_ptr<const ExactSolution> solution;
    std::function<Position(const Position &)> point;
    Measure volume, area;
  };
} // namespace meltfront::cases

#endif
