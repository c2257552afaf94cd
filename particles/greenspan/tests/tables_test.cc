#include <cases/error.h>
#include <particles/greenspan/motion/pair_force.h>
#include <particles/greenspan/tables.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Entries whose mirror image is not in the table. */
    int asymmetric_entries(const ParticleState &state)
    {
      int count = 0;
      for(std::size_t i = 0; i < state.size(); ++i)
      {
        std::size_t nearest = 0;
        const auto distance = [&](std::size_t j)
        {
          return std::hypot(state.position[0][i] + state.position[0][j],
                            state.position[1][i] - state.position[1][j]);
        };
        for(std::size_t j = 0; j < state.size(); ++j)
          if(distance(j) < distance(nearest))
            nearest = j;
        count += distance(nearest) > 1e-12;
        count += state.velocity[0][i] != -state.velocity[0][nearest];
        count += state.velocity[1][i] != state.velocity[1][nearest];
      }
      return count;
    }

    TEST(GreenspanTables, FirstIsSymmetricAndSecondIsSoWithItsErrata)
    {
      EXPECT_EQ(read_table(1).size(), 28u);
      EXPECT_EQ(asymmetric_entries(read_table(1)), 0);
      const ParticleState printed = read_table(2),
                          corrected = read_table(2, Errata::applied);
      EXPECT_EQ(printed.size(), 46u);
      EXPECT_EQ(asymmetric_entries(printed), 8); // four pairs
      EXPECT_EQ(asymmetric_entries(corrected), 0);
      EXPECT_EQ(printed.velocity[0][31], -0.1162);
      EXPECT_EQ(corrected.velocity[0][31], 0.1162);
      EXPECT_EQ(corrected.position[1][36], 4.4248);
    }

    TEST(GreenspanTables, BadFilesAreExplained)
    {
      EXPECT_THROW(read_table(3), cases::InputError);
      EXPECT_THROW(read_table("/nowhere", 1, Errata::as_printed), cases::OutputError);
      const auto folder
          = std::filesystem::temp_directory_path()
            / std::filesystem::path("greenspan_tables_" + std::to_string(std::rand()));
      std::filesystem::create_directories(folder);
      for(const char *line : {"1,0,0,0", "1,0,zero,0,0", "7,0,0,0,0", "1,nan,0,0,0"})
      {
        std::ofstream(folder / "greenspan_table1.csv") << "i,x,y,vx,vy\n" << line << "\n";
        EXPECT_THROW(read_table(folder.string(), 1, Errata::as_printed),
                     cases::InputError)
            << line;
      }
      std::filesystem::remove_all(folder);
    }

    // The figures were found with independent codes.
    TEST(GreenspanPairForce, DerivedNumbersAreRight)
    {
      const PairForce triangle = PairForce::triangle(),
                      rectangle = PairForce::rectangle();
      EXPECT_NEAR(triangle.equilibrium_distance(), 1.0770330, 5e-8);
      EXPECT_NEAR(rectangle.equilibrium_distance(), 1.0499563, 5e-8);
      EXPECT_NEAR(triangle.bond_work(), 96.2687, 5e-5);
      EXPECT_NEAR(rectangle.bond_work(), 76.6579, 5e-5);
      EXPECT_NEAR(triangle.stiffness(), 3450.05, 5e-3);
      EXPECT_NEAR(rectangle.stiffness(), 5159.24, 5e-3);
      EXPECT_NEAR(triangle.magnitude(1.5), -239.232, 5e-4);
      EXPECT_NEAR(rectangle.magnitude(1.5), -97.676, 5e-4);
      EXPECT_EQ(triangle.potential(1.5), 0);
      EXPECT_EQ(triangle.potential(1.6), 0);
    }

    TEST(GreenspanPairForce, IsThePotentialsSlope)
    {
      for(const PairForce &force : {PairForce::triangle(), PairForce::rectangle()})
        for(const double r : {0.8, 1., 1.2, 1.45})
        {
          const double h = 1e-5;
          const double slope
              = (force.potential(r + h) - force.potential(r - h)) / (2 * h);
          EXPECT_NEAR(-slope, force.magnitude(r),
                      1e-6 * std::max(1., std::abs(force.magnitude(r))));
        }
    }
  } // namespace
} // namespace meltfront::particles::greenspan
