#include <cases/error.h>
#include <particles/benchmarks/lammps.h>
#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/tables.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    using namespace greenspan;

    // Printed with the specification of the runs that the figures of the README quote.
    TEST(Lammps, PotentialIsThatOfTheReport)
    {
      const MiePotential triangle(PairForce::triangle());
      EXPECT_NEAR(triangle.epsilon, 266.80364680610893, 1e-11);
      EXPECT_NEAR(triangle.sigma, 0.8342661445845684, 1e-14);
      const MiePotential rectangle(PairForce::rectangle());
      EXPECT_NEAR(rectangle.epsilon, 105.32561021385126, 1e-11);
      EXPECT_NEAR(rectangle.sigma, 0.9172212720124008, 1e-14);
    }

    TEST(Lammps, IsolatedSolidsMoveAlike)
    {
      const auto program = find_lammps();
      if(!program)
        GTEST_SKIP() << "LAMMPS (lmp) is not installed";
      constexpr double time_step = 1e-4;
      for(const auto &[force, table] :
          {std::pair{PairForce::triangle(), 1}, {PairForce::rectangle(), 2}})
      {
        MotionParameters parameters;
        parameters.force = force;
        parameters.gravity = 0;
        parameters.time_step = time_step;
        const ParticleState start = read_table(table);
        Motion motion(parameters, start);
        motion.advance(10000);
        const ParticleState ours = motion.state();
        const ParticleState theirs
            = run_lammps(*program, force, start, time_step, 10000).end;
        double largest = 0, travelled = 0;
        for(int d = 0; d < 2; ++d)
          for(std::size_t i = 0; i < start.size(); ++i)
          {
            largest = std::max(largest,
                               std::abs(ours.position[d][i] - theirs.position[d][i]));
            travelled = std::max(travelled,
                                 std::abs(ours.position[d][i] - start.position[d][i]));
          }
        EXPECT_LT(largest, 1e-10) << "table " << table;
        EXPECT_GT(travelled, 1e-2);
        RecordProperty(table == 1 ? "triangle" : "rectangle", std::to_string(largest));
        std::printf("table %d: largest difference %.2g\n", table, largest);
      }
    }

    TEST(Lammps, AProgramThatFailsIsReported)
    {
      EXPECT_THROW(
          run_lammps("/bin/false", PairForce::triangle(), read_table(1), 1e-4, 1),
          cases::OutputError);
    }
  } // namespace
} // namespace meltfront::particles::benchmarks
