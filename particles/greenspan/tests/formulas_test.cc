// The motion against the formulas of the report, written down once more.

#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/tables.h>
#include <particles/greenspan/tests/report_runs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    MotionParameters heated_triangle(double power)
    {
      MotionParameters parameters;
      parameters.base = Base{};
      parameters.source = slow_source(power);
      return parameters;
    }

    MotionParameters hot_rectangle()
    {
      MotionParameters parameters;
      parameters.force = PairForce::rectangle();
      parameters.base = heated_base();
      parameters.temperatures = true;
      return parameters;
    }

    /** The formulas of the report, particle by particle in extended precision. */
    class Oracle
    {
    public:
      Oracle(const MotionParameters &p, const ParticleState &s)
        : p(p)
        , n(s.size())
        , r(2, std::vector<long double>(n))
        , v(r)
      {
        for(int d = 0; d < 2; ++d)
        {
          std::copy(s.position[d].begin(), s.position[d].end(), r[d].begin());
          std::copy(s.velocity[d].begin(), s.velocity[d].end(), v[d].begin());
        }
        kick(0.5L * p.time_step);
      }

      void step(long k)
      {
        for(std::size_t i = 0; i < n; ++i)
        {
          for(int d = 0; d < 2; ++d)
            r[d][i] += (long double)p.time_step * v[d][i];
          if(p.base && r[1][i] < 0)
          {
            r[1][i] = -r[1][i];
            const long double x = r[0][i];
            const bool hot = p.base->hot_half_width > 0 && -5 < x && x < 5;
            v[0][i] = 0;
            v[1][i] *= -(hot ? 1.5L - 0.025L * (x + 5) : (long double)0.1);
          }
          if(p.source)
          {
            const long double dx = r[0][i] - (long double)p.source->position[0],
                              dy = r[1][i] - (long double)p.source->position[1];
            const long double distance = std::hypot(dx, dy);
            const long double strength = k <= 50000 ? 0.008 : 0.0095;
            const long double kick
                = strength * std::pow(distance, -(long double)p.source->power);
            if(distance < 2.5L)
            {
              v[0][i] += kick * dx / distance;
              v[1][i] += kick * dy / distance;
            }
          }
        }
        kick(p.time_step);
      }

      double difference(const ParticleState &s) const
      {
        long double largest = 0;
        for(int d = 0; d < 2; ++d)
          for(std::size_t i = 0; i < n; ++i)
            largest = std::max(largest, std::abs(r[d][i] - s.position[d][i]));
        return static_cast<double>(largest);
      }

    private:
      void kick(long double dt)
      {
        const PairForce &f = p.force;
        for(std::size_t i = 0; i < n; ++i)
        {
          long double sum[2] = {};
          for(std::size_t j = 0; j < n; ++j)
          {
            const long double dx = r[0][i] - r[0][j], dy = r[1][i] - r[1][j];
            const long double d = std::hypot(dx, dy);
            if(j == i || d > 1.5L)
              continue;
            const long double force
                = -f.attraction / std::pow(d, (long double)f.attraction_exponent)
                  + f.repulsion / std::pow(d, (long double)f.repulsion_exponent);
            sum[0] += force * dx / d;
            sum[1] += force * dy / d;
          }
          v[0][i] += dt * sum[0];
          v[1][i] += dt * (sum[1] - p.gravity);
        }
      }

      MotionParameters p;
      std::size_t n;
      std::vector<std::vector<long double>> r, v;
    };

    TEST(GreenspanFormulas, AreFollowed)
    {
      struct Run
      {
        MotionParameters parameters;
        int table;
        long steps;
        double tolerance;
      };
      for(const Run &run : {Run{heated_triangle(2), 1, 2000, 1e-12},
                            Run{heated_triangle(-2), 1, 2000, 1e-12},
                            Run{hot_rectangle(), 2, 1000, 1e-10}})
      {
        const ParticleState start = read_table(run.table);
        Motion motion(run.parameters, start);
        Oracle oracle(run.parameters, start);
        motion.advance(run.steps);
        for(long k = 1; k <= run.steps; ++k)
          oracle.step(k);
        EXPECT_LT(oracle.difference(motion.state()), run.tolerance) << run.table;
      }
    }
  } // namespace
} // namespace meltfront::particles::greenspan
