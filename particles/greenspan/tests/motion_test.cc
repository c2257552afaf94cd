#include <cases/error.h>
#include <particles/greenspan/motion.h>
#include <particles/greenspan/tables.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Without base and gravity. */
    MotionParameters isolated(const PairForce &force, double time_step = 1e-4)
    {
      MotionParameters parameters;
      parameters.force = force;
      parameters.time_step = time_step;
      parameters.gravity = 0;
      return parameters;
    }

    double largest_energy_error(const PairForce &force, int table, double time_step)
    {
      Motion motion(isolated(force, time_step), read_table(table));
      const double start = motion.energy().total();
      double largest = 0;
      const long steps = std::lround(2 / time_step);
      for(long step = 0; step < steps; ++step)
      {
        motion.advance(1);
        largest = std::max(largest, std::abs(motion.energy().total() - start));
      }
      return largest;
    }

    // Targets: the same formulas in independent codes.
    TEST(GreenspanMotion, EnergyOfIsolatedSolidsIsOfSecondOrder)
    {
      struct Solid
      {
        PairForce force;
        int table;
        double energy, error;
      };
      for(const Solid &solid : {Solid{PairForce::triangle(), 1, -5887.554933, 1.43e-3},
                                Solid{PairForce::rectangle(), 2, -7831.174353, 1.07e-2}})
      {
        const Motion motion(isolated(solid.force), read_table(solid.table));
        EXPECT_NEAR(motion.energy().total(), solid.energy, 1e-6);
        double finer = largest_energy_error(solid.force, solid.table, 5e-5);
        for(const double time_step : {1e-4, 2e-4, 4e-4})
        {
          const double error = largest_energy_error(solid.force, solid.table, time_step);
          EXPECT_NEAR(error / finer, 4.0, 0.1) << solid.table << " " << time_step;
          if(time_step == 1e-4)
          {
            EXPECT_NEAR(error, solid.error, 0.05 * solid.error);
          }
          finer = error;
        }
      }
    }
  } // namespace
} // namespace meltfront::particles::greenspan
