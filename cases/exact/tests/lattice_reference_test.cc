#include <cases/error.h>
#include <cases/exact/lattice_reference.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meltfront::cases;

namespace
{
  constexpr double pi = std::numbers::pi;

  LatticeProblem problem(int intervals)
  {
    LatticeProblem result;
    result.lower = {-0.5, 1, 0};
    result.upper = {1.5, 3, 0};
    result.conductivity = 2;
    result.intervals = intervals;
    return result;
  }

  double wave(const Position &p)
  {
    return std::sin(pi * p[0] + 0.3) * std::cos(0.5 * pi * p[1]);
  }

  double error_of_wave(int intervals)
  {
    LatticeProblem waves = problem(intervals);
    waves.wall_temperature = wave;
    waves.volumetric_source
        = [](const Position &p) { return 2 * 1.25 * pi * pi * wave(p); };
    const LatticeReference reference(waves);
    double largest = 0;
    for(double x = -0.5; x <= 1.5; x += 0.0711)
      for(double y = 1; y <= 3; y += 0.0653)
        largest = std::max(largest, std::abs(reference.temperature(Position{x, y, 0}, 0)
                                             - wave({x, y, 0})));
    return largest;
  }
} // namespace

TEST(LatticeReference, CubicsInEachDirectionAreExact)
{
  const auto cubic = [](const Position &p)
  { return p[0] * p[0] * p[0] - 3 * p[0] * p[1] * p[1] + p[0] * p[1] + 0.5; };
  LatticeProblem harmonic = problem(12);
  harmonic.wall_temperature = cubic;
  harmonic.volumetric_source = [](const Position &) { return 0.; };
  const LatticeReference reference(harmonic);
  for(const Position p :
      {Position{-0.5, 1, 0}, {0.123, 1.01, 0}, {1.49, 2.2, 0}, {1.5, 3, 0}})
    EXPECT_NEAR(reference.temperature(p, 0), cubic(p), 1e-12);
  EXPECT_FALSE(reference.has_front());
  EXPECT_TRUE(std::isnan(reference.front(0)));
}

TEST(LatticeReference, IsOfSecondOrder)
{
  const double coarse = error_of_wave(20), fine = error_of_wave(80);
  EXPECT_NEAR(std::log2(coarse / fine) / 2, 2, 0.1);
}

TEST(LatticeReference, TakesSquaresOnly)
{
  LatticeProblem oblong = problem(10);
  oblong.upper[1] = 4;
  EXPECT_THROW(LatticeReference{oblong}, InputError);
  EXPECT_THROW(LatticeReference{problem(3)}, InputError);
}
