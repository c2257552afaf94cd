#include <cases/exact/axisymmetric_view.h>

#include <limits>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  } // namespace

  AxisymmetricView::AxisymmetricView(std::shared_ptr<const ExactSolution> solution,
                                     std::function<Position(const Position &)> point,
                                     Measure solid_volume, Measure front_area)
    : solution(std::move(solution))
    , point(std::move(point))
    , volume(std::move(solid_volume))
    , area(std::move(front_area))
  {
  }

  std::shared_ptr<const AxisymmetricView>
  AxisymmetricView::of_cylinder(std::shared_ptr<const ExactSolution> solution,
                                double inner_radius, double radius, double height)
  {
    return std::make_shared<const AxisymmetricView>(
        solution,
        [](const Position &p) {
          return Position{p[0], 0, 0};
        },
        [=](double time)
        { return height * solution->solid_volume(inner_radius, radius, time); },
        [=](double time)
        { return height * 2 * std::numbers::pi * solution->front(time); });
  }

  std::string AxisymmetricView::description() const
  {
    return solution->description() + ", in the half section of an axisymmetric body";
  }

  Symmetry AxisymmetricView::symmetry() const
  {
    return Symmetry::none;
  }

  bool AxisymmetricView::has_front() const
  {
    return solution->has_front();
  }

  bool AxisymmetricView::depends_on_one_coordinate() const
  {
    return false;
  }

  double AxisymmetricView::start_time() const
  {
    return solution->start_time();
  }

  bool AxisymmetricView::solid_at_origin() const
  {
    return solution->solid_at_origin();
  }

  double AxisymmetricView::temperature(const Position &position, double time) const
  {
    return solution->temperature(point(position), time);
  }

  double AxisymmetricView::solid_fraction(const Position &position, double time) const
  {
    return solution->solid_fraction(point(position), time);
  }

  double AxisymmetricView::signed_distance(const Position &position, double time) const
  {
    return solution->signed_distance(point(position), time);
  }

  double AxisymmetricView::volumetric_source(const Position &position, double time) const
  {
    return solution->volumetric_source(point(position), time);
  }

  double AxisymmetricView::solid_volume(double time) const
  {
    return volume(time);
  }

  double AxisymmetricView::front_area(double time) const
  {
    return area(time);
  }

  double AxisymmetricView::temperature(double, double) const
  {
    return not_a_number;
  }

  double AxisymmetricView::front(double) const
  {
    return not_a_number;
  }

  double AxisymmetricView::heat_content(double, double, double) const
  {
    return not_a_number;
  }
} // namespace meltfront::cases
