#include <cases/error.h>
#include <cases/velocity_field.h>

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <numbers>
#include <vector>

using namespace meltfront::cases;

namespace
{
  constexpr double pi = std::numbers::pi;

  /** Gradient by the class against differences of its velocity. */
  double gradient_error(const VelocityField &field, const int dimension)
  {
    double worst = 0;
    for(const Position &point :
        {Position{0.31, 0.72, 0.13}, Position{0.9, 0.05, 0.55}, Position{0.5, 0.25, 0.8}})
    {
      PointArrays points;
      std::array<double, 9> values{};
      std::array<std::span<double>, 9> gradient;
      for(int i = 0; i < dimension; ++i)
      {
        points[i] = {&point[i], 1};
        for(int j = 0; j < dimension; ++j)
          gradient[3 * i + j] = {&values[3 * i + j], 1};
      }
      field.gradients(points, 0.7, gradient);
      double trace = 0;
      for(int i = 0; i < dimension; ++i)
      {
        trace += values[4 * i];
        for(int j = 0; j < dimension; ++j)
        {
          Position low = point, high = point;
          low[j] -= 1e-5;
          high[j] += 1e-5;
          const double difference = (field.velocity(high, 0.7, dimension)[i]
                                     - field.velocity(low, 0.7, dimension)[i])
                                    / 2e-5;
          worst = std::max(worst, std::abs(values[3 * i + j] - difference));
        }
      }
      worst = std::max(worst, std::abs(trace));
    }
    return worst;
  }
} // namespace

TEST(VelocityField, GradientsAreThoseOfTheVelocitiesAndFreeOfDivergence)
{
  EXPECT_LT(gradient_error(RigidMotion({0.1, 0.2, 0}, 3, {0.5, 0.5, 0}), 2), 1e-9);
  EXPECT_LT(gradient_error(SingleVortex(8), 2), 1e-8);
  EXPECT_LT(gradient_error(CubeDeformation(3), 3), 1e-8);
  const SingleVortex vortex(8);
  const FormulaVelocity same(
      "as a vortex",
      {[&](const Position &x, const double t) { return vortex.velocity(x, t, 2)[0]; },
       [&](const Position &x, const double t) { return vortex.velocity(x, t, 2)[1]; },
       {}},
      1);
  EXPECT_LT(gradient_error(same, 2), 1e-8);
}

TEST(VelocityField, ARotationIsBackAfterOneTurnAndAQuarterIsAQuarter)
{
  const RigidMotion rotation({}, 2 * pi, {0.5, 0.5, 0});
  EXPECT_TRUE(rotation.rigid());
  const Position point{0.5, 0.85, 0};
  const Position turned = rotation.carried(point, 0, 1, 2);
  EXPECT_NEAR(turned[0], point[0], 1e-9);
  EXPECT_NEAR(turned[1], point[1], 1e-9);
  const Position quarter = rotation.carried(point, 0, 0.25, 2);
  EXPECT_NEAR(quarter[0], 0.15, 1e-9);
  EXPECT_NEAR(quarter[1], 0.5, 1e-9);
}

TEST(VelocityField, WhatIsCarriedForthAndBackIsWhereItWas)
{
  const SingleVortex vortex(8);
  const Position point{0.5, 0.6, 0};
  const Position middle = vortex.carried(point, 0, 4, 2);
  EXPECT_GT(std::hypot(middle[0] - point[0], middle[1] - point[1]), 0.05);
  const Position back = vortex.carried(middle, 4, 0, 2);
  const Position end = vortex.carried(point, 0, 8, 2);
  const CubeDeformation deformation(3);
  const Position inside{0.35, 0.4, 0.5};
  const Position round = deformation.carried(inside, 0, 3, 3);
  for(int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(back[i], point[i], 1e-8);
    EXPECT_NEAR(end[i], point[i], 1e-8);
    EXPECT_NEAR(round[i], inside[i], 1e-8);
  }
}

TEST(VelocityField, RefusesAPeriodOfNothing)
{
  EXPECT_THROW(SingleVortex{0}, Refusal);
  EXPECT_THROW(CubeDeformation{std::numeric_limits<double>::quiet_NaN()}, Refusal);
}
