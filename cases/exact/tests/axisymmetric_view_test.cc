#include <cases/exact/axisymmetric_view.h>
#include <cases/exact/line_sink.h>
#include <cases/exact/manufactured/manufactured_solution.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meltfront::cases;

TEST(AxisymmetricView, ACylinderDoesNotVaryAlongItsAxis)
{
  const auto sink = std::make_shared<const LineSink>(Material{}, 0.3, 0.5);
  const auto view = AxisymmetricView::of_cylinder(sink, 0.1, 2, 3);
  const double time = 0.7, front = sink->front(time);
  for(const double y : {-1., 0., 2.})
  {
    EXPECT_EQ(view->temperature(Position{0.4, y, 0}, time), sink->temperature(0.4, time));
    EXPECT_EQ(view->signed_distance({0.4, y, 0}, time), 0.4 - front);
  }
  EXPECT_FALSE(view->depends_on_one_coordinate());
  EXPECT_NEAR(view->solid_volume(time), 3 * std::numbers::pi * (front * front - 0.01),
              1e-14);
  EXPECT_NEAR(view->front_area(time), 6 * std::numbers::pi * front, 1e-14);
}

TEST(AxisymmetricView, HeatEquationOfABodyAboutTheAxis)
{
  FamilyParameters parameters;
  parameters.name = "two-disks";
  parameters.dimension = 3;
  const auto solution = std::make_shared<const ManufacturedSolution>(
      Material{}, make_front_family(parameters), 1);
  const AxisymmetricView view(
      solution,
      [](const Position &p) {
        return Position{p[1], p[0], 0};
      },
      [&](double time) { return solution->solid_volume(time); },
      [&](double time) { return solution->front_area(time); });
  const double time = 0.4, h = 1e-3;
  const auto temperature = [&](double r, double z, double t) {
    return view.temperature(Position{r, z, 0}, t);
  };
  for(const auto &[r, z] : {std::pair(0.2, 0.5), std::pair(0.45, -0.3)})
  {
    const double middle = temperature(r, z, time);
    const double east = temperature(r + h, z, time), west = temperature(r - h, z, time);
    const double laplacian
        = ((1 + h / (2 * r)) * (east - middle) - (1 - h / (2 * r)) * (middle - west)
           + temperature(r, z + h, time) - 2 * middle + temperature(r, z - h, time))
          / (h * h);
    const double rate
        = (temperature(r, z, time + h) - temperature(r, z, time - h)) / (2 * h);
    EXPECT_NEAR(rate - laplacian, view.volumetric_source({r, z, 0}, time), 2e-3);
  }
}
