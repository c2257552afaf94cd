#include <cases/error.h>
#include <particles/core/arrangement.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    const auto everywhere = [](const std::array<double, 3> &) { return true; };

    TEST(Arrangement, FillsABoxFromItsMiddle)
    {
      const double spacing = lattice_spacing(1, 10, LatticeLayout::cell_centred);
      const LatticeDirection side{-0.5, 0.5, LatticeLayout::cell_centred};
      const auto particles = arrange_in_box(2, {side, side}, spacing);
      ASSERT_EQ(particles.size(), 100u);
      EXPECT_NEAR(particles.position[0][0], -0.45, 1e-15);
      // Mirror images have the same coordinates but for the sign, to the last bit.
      for(int i = 0; i < 10; ++i)
        EXPECT_EQ(particles.position[0][i], -particles.position[0][9 - i]);
      EXPECT_TRUE(particles.position[2].empty());
    }

    TEST(Arrangement, PutsParticlesOnTheEdge)
    {
      const double spacing = lattice_spacing(1, 11, LatticeLayout::on_edge);
      EXPECT_NEAR(spacing, 0.1, 1e-15);
      const LatticeDirection side{0, 1, LatticeLayout::on_edge};
      const auto particles = arrange_in_box(1, {side}, spacing);
      ASSERT_EQ(particles.size(), 11u);
      EXPECT_NEAR(particles.position[0].front(), 0, 1e-15);
      EXPECT_NEAR(particles.position[0].back(), 1, 1e-15);
    }

    TEST(Arrangement, RefusesWhatDoesNotFit)
    {
      const LatticeDirection side{0, 1, LatticeLayout::cell_centred};
      const LatticeDirection odd{0, 0.55, LatticeLayout::cell_centred};
      EXPECT_THROW(arrange_in_box(2, {side, odd}, 0.1), cases::InputError);
      EXPECT_THROW(lattice_spacing(1, 3, LatticeLayout::cell_centred), cases::InputError);
      EXPECT_THROW(lattice_spacing(1, 4, LatticeLayout::on_edge), cases::InputError);
    }

    TEST(Arrangement, FillsDiskAndBall)
    {
      for(int dimension = 2; dimension <= 3; ++dimension)
      {
        const double spacing = 0.02;
        const auto particles
            = arrange_in_shell(dimension, 0, 0.5, spacing, LatticeLayout::cell_centred);
        const auto ghosts = arrange_in_shell(dimension, 0.5, 0.54, spacing,
                                             LatticeLayout::cell_centred);
        const double volume = particles.size() * std::pow(spacing, dimension);
        const double exact = dimension == 2 ? M_PI / 4 : M_PI / 6;
        EXPECT_NEAR(volume, exact, 0.01 * exact);
        for(std::size_t i = 0; i < particles.size(); ++i)
        {
          const auto p = particles.point(i);
          EXPECT_LT(std::hypot(p[0], p[1], p[2]), 0.5);
        }
        for(std::size_t i = 0; i < ghosts.size(); ++i)
        {
          const auto p = ghosts.point(i);
          EXPECT_GE(std::hypot(p[0], p[1], p[2]), 0.5 - 1e-12);
        }
        // Together they are the lattice of a larger ball.
        const auto all
            = arrange_in_shell(dimension, 0, 0.54, spacing, LatticeLayout::cell_centred);
        EXPECT_EQ(all.size(), particles.size() + ghosts.size());
      }
    }

    TEST(Arrangement, JittersReproduciblyAndWithinBounds)
    {
      const double spacing = 0.1;
      const auto lattice = arrange_in_box(3, {}, spacing);
      auto first = lattice, again = lattice, other = lattice;
      jitter(first, 0.3 * spacing, 11, everywhere);
      jitter(again, 0.3 * spacing, 11, everywhere);
      jitter(other, 0.3 * spacing, 12, everywhere);
      EXPECT_EQ(first.position, again.position);
      EXPECT_NE(first.position, other.position);
      double sum = 0, largest = 0;
      for(int d = 0; d < 3; ++d)
        for(std::size_t i = 0; i < lattice.size(); ++i)
        {
          const double shift = first.position[d][i] - lattice.position[d][i];
          sum += shift;
          largest = std::max(largest, std::abs(shift));
        }
      EXPECT_LE(largest, 0.3 * spacing * (1 + 1e-12));
      EXPECT_GT(largest, 0.29 * spacing);
      EXPECT_NEAR(sum / (3 * lattice.size()), 0, 0.02 * spacing);
    }

    TEST(Arrangement, JitterSparesWhatMustStay)
    {
      const auto lattice = arrange_in_box(2, {}, 0.1);
      auto moved = lattice, all = lattice;
      const auto left = [](const std::array<double, 3> &p) { return p[0] < 0.5; };
      jitter(moved, 0.02, 1, left);
      jitter(all, 0.02, 1, everywhere);
      for(std::size_t i = 0; i < lattice.size(); ++i)
        EXPECT_EQ(moved.point(i),
                  left(lattice.point(i)) ? all.point(i) : lattice.point(i));
    }
  } // namespace
} // namespace meltfront::particles
