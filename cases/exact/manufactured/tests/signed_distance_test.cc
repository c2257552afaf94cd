// Distance to the front against the nearest of many places on it.

#include <cases/exact/manufactured/tests/fifty_digits.h>
#include <cases/exact/tests/materials.h>

#include <gtest/gtest.h>

namespace meltfront::cases::manufactured
{
  namespace
  {
    /** Where the front meets the edges of a grid over twice the domain. */
    std::vector<Position> front_on_grid(const FrontFamily &family, double time,
                                        double spacing)
    {
      const auto [lower, upper] = family.domain();
      std::array<int, 3> count{};
      Position corner{};
      for(int d = 0; d < family.dimension(); ++d)
      {
        count[d] = static_cast<int>(2 * (upper[d] - lower[d]) / spacing);
        corner[d] = (3 * lower[d] - upper[d]) / 2;
      }
      std::vector<Position> places;
      for(int i = 0; i <= count[0]; ++i)
        for(int j = 0; j <= count[1]; ++j)
          for(int k = 0; k <= count[2]; ++k)
          {
            const Position p{corner[0] + i * spacing, corner[1] + j * spacing,
                             corner[2] + k * spacing};
            const bool solid = family.level_set(p, time) < 0;
            for(int d = 0; d < family.dimension(); ++d)
            {
              Position near = p, far = p;
              far[d] += spacing;
              if((family.level_set(far, time) < 0) == solid)
                continue;
              for(int n = 0; n < 40; ++n)
              {
                Position middle = near;
                middle[d] = (near[d] + far[d]) / 2;
                ((family.level_set(middle, time) < 0) == solid ? near : far) = middle;
              }
              places.push_back(near);
            }
          }
      return places;
    }

    double distance(const Position &a, const Position &b)
    {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
  } // namespace

  /** A place on the grid's front lies within one spacing (sqrt(2) in space) of the
   * nearest one, so that its distance is at least the exact one, and the squares differ
   * by little more than that of the spacing. */
  TEST(SignedDistance, IsThatOfTheNearestPlaceOnTheFront)
  {
    for(const auto &family : all_families(1, 1))
      for(const double time : {0.13, 0.24, 0.26, 0.6})
      {
        const double spacing = family->dimension() == 2 ? 0.004 : 0.03;
        const auto front = front_on_grid(*family, time, spacing);
        RandomPlace random(*family);
        for(int n = 0; n < 100; ++n)
        {
          const Position p = random();
          const double exact = family->signed_distance(p, time);
          double nearest = 100;
          for(const Position &y : front)
            nearest = std::min(nearest, distance(p, y));
          EXPECT_EQ(exact < 0, family->level_set(p, time) < 0);
          EXPECT_LE(std::abs(exact), nearest + 1e-12)
              << family->description() << " time " << time << " at " << p[0] << " "
              << p[1] << " " << p[2];
          EXPECT_LE(nearest * nearest - exact * exact, 8 * spacing * spacing)
              << family->description() << " time " << time << " at " << p[0] << " "
              << p[1] << " " << p[2] << ": " << exact << " " << nearest;
        }
      }
  }

  /** Along the normal, a little way from the front. */
  TEST(SignedDistance, IsExactNearTheFront)
  {
    for(const auto &family : all_families(period, length_scale))
    {
      RandomPlace random(*family);
      for(int n = 0; n < 50; ++n)
      {
        const double time = period * (0.3 + 0.4 * random.share());
        const Position p = random_front_place(*family, random, time);
        const FrontDerivatives f = family->derivatives(p, time);
        const double slope = std::sqrt(f.square_of_gradient());
        for(const double away : {-4e-3, -1e-6, 0., 1e-9, 3e-3})
        {
          Position beside = p;
          for(int d = 0; d < 3; ++d)
            beside[d] += away * f.gradient[d] / slope;
          EXPECT_NEAR(family->signed_distance(beside, time), away, 1e-14)
              << family->description();
        }
      }
    }
  }

  TEST(SignedDistance, AtASaddle)
  {
    for(const char *name : {"two-disks", "finger"})
      for(const int dimension : {2, 3})
        for(const double time : {0.2, 0.25, 0.3})
        {
          const auto family = make_front_family({name, dimension, 1, 1, 3});
          const double distance = family->signed_distance(*family->saddle(), time);
          // From the formulas: half the gap along x, or half the width of the neck.
          const double wave = std::cos(2 * std::numbers::pi * time);
          double exact = 0;
          if(name[0] == 't' && time != 0.25)
          {
            const double root = 0.25 * std::sqrt(1 - wave * wave * wave / 2);
            exact = std::sqrt(std::abs(0.25 - root)) * (root < 0.25 ? 1 : -1);
          }
          else if(time < 0.25)
            exact = -std::sqrt(0.012 * wave * wave * wave);
          if(name[0] == 't' || time <= 0.25)
            EXPECT_NEAR(distance, exact, 1e-7) << name << dimension << " " << time;
          else
            EXPECT_GT(distance, 0);
        }
  }
} // namespace meltfront::cases::manufactured
