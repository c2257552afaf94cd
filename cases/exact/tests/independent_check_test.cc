#include <cases/exact/oracle.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

/** The oracle's own figures against a discretisation that shares nothing with it: finite
 * differences of order two, classical Runge-Kutta steps, Richardson's extrapolation. */
namespace meltfront::cases
{
  namespace
  {
    constexpr double inner = 0.3, start_front = 0.5, outer = 1;
    constexpr double solid_conductivity = 2, solid_capacity = 1;
    constexpr double liquid_conductivity = 1, liquid_capacity = 2;
    constexpr double latent_heat = 2;

    /** Between two round walls; the inner one is held, the outer one held or under heat
     * transfer. */
    struct Shell
    {
      int dimension;
      double coefficient = 0; ///< of heat transfer at the outer wall; 0: held
      double end_time = 0.12;

      /** For which T_m stays T_m at the front to first order in time. */
      double profile(double r) const
      {
        const double solid_power = dimension - 2 + 0.4,
                     liquid_power = dimension - 2 + 1.6, rho = r / start_front;
        return r < start_front ? (1 - std::pow(rho, -solid_power)) / solid_power
                               : 0.4 * (1 - std::pow(rho, -liquid_power)) / liquid_power;
      }

      /** With which the profile agrees with the outer wall's law. */
      double ambient() const
      {
        const double power = dimension - 2 + 1.6;
        const double slope
            = 0.4 / start_front * std::pow(outer / start_front, -power - 1);
        return profile(outer) + liquid_conductivity * slope / coefficient;
      }
    };

    class FiniteDifferences
    {
    public:
      FiniteDifferences(const Shell &shell, int cells)
        : shell(shell)
        , cells(cells)
        , state(2 * cells + 3)
      {
        for(int i = 0; i <= cells; ++i)
        {
          const double x = static_cast<double>(i) / cells;
          state[i] = shell.profile(std::lerp(inner, start_front, x));
          state[cells + 1 + i] = shell.profile(std::lerp(start_front, outer, x));
        }
        state[cells] = state[cells + 1] = 0;
        state.back() = start_front;
      }

      double front_at_end()
      {
        // Explicit: the step follows the square of the narrowest cell.
        const double width = (start_front - inner) / cells;
        const auto steps
            = static_cast<long>(std::ceil(shell.end_time / (0.3 * width * width)));
        const double step = shell.end_time / static_cast<double>(steps);
        for(long i = 0; i < steps; ++i)
          advance(step);
        return state.back();
      }

    private:
      using State = std::vector<double>;

      void advance(double step)
      {
        const State first = rate(state), second = rate(shifted(first, step / 2)),
                    third = rate(shifted(second, step / 2)),
                    fourth = rate(shifted(third, step));
        for(std::size_t i = 0; i < state.size(); ++i)
          state[i] += step / 6 * (first[i] + 2 * second[i] + 2 * third[i] + fourth[i]);
      }

      State shifted(const State &rates, double step) const
      {
        State result = state;
        for(std::size_t i = 0; i < result.size(); ++i)
          result[i] += step * rates[i];
        return result;
      }

      State rate(const State &u) const
      {
        const double front = u.back();
        const double *solid = u.data(), *liquid = u.data() + cells + 1;
        const double solid_width = (front - inner) / cells,
                     liquid_width = (outer - front) / cells;
        const double solid_slope
            = (3 * solid[cells] - 4 * solid[cells - 1] + solid[cells - 2])
              / (2 * solid_width);
        const double liquid_slope
            = (-3 * liquid[0] + 4 * liquid[1] - liquid[2]) / (2 * liquid_width);
        const double speed
            = (solid_conductivity * solid_slope - liquid_conductivity * liquid_slope)
              / latent_heat;
        State result(u.size());
        const auto conduct
            = [&](const double *phase, double *rates, int i, double r, double width,
                  double diffusivity, double node_speed, double after)
        {
          const double slope = (after - phase[i - 1]) / (2 * width);
          rates[i] = diffusivity
                         * ((after - 2 * phase[i] + phase[i - 1]) / (width * width)
                            + (shell.dimension - 1) / r * slope)
                     + node_speed * slope;
        };
        for(int i = 1; i < cells; ++i)
        {
          const double x = static_cast<double>(i) / cells;
          conduct(solid, result.data(), i, inner + x * (front - inner), solid_width,
                  solid_conductivity / solid_capacity, speed * x, solid[i + 1]);
          conduct(liquid, result.data() + cells + 1, i, front + x * (outer - front),
                  liquid_width, liquid_conductivity / liquid_capacity, speed * (1 - x),
                  liquid[i + 1]);
        }
        if(shell.coefficient > 0)
        {
          // The value beyond the wall that makes the central slope the law's.
          const double slope = shell.coefficient * (shell.ambient() - liquid[cells])
                               / liquid_conductivity;
          conduct(liquid, result.data() + cells + 1, cells, outer, liquid_width,
                  liquid_conductivity / liquid_capacity, 0,
                  liquid[cells - 1] + 2 * liquid_width * slope);
        }
        result.back() = speed;
        return result;
      }

      Shell shell;
      int cells;
      State state; ///< solid, liquid, front
    };

    /** Errors of the orders 2, 3, 4 taken out of four levels. */
    double extrapolated(const Shell &shell)
    {
      std::vector<double> fronts;
      for(int cells = 10; cells <= 80; cells *= 2)
        fronts.push_back(FiniteDifferences(shell, cells).front_at_end());
      for(int order = 2; fronts.size() > 1; ++order)
      {
        for(std::size_t i = 0; i + 1 < fronts.size(); ++i)
          fronts[i]
              = fronts[i + 1] + (fronts[i + 1] - fronts[i]) / (std::pow(2, order) - 1);
        fronts.pop_back();
      }
      return fronts.front();
    }

    double by_oracle(const Shell &shell)
    {
      OracleProblem problem;
      problem.symmetry
          = shell.dimension == 2 ? Symmetry::cylindrical : Symmetry::spherical;
      problem.material = {{solid_conductivity, solid_capacity, 1},
                          {liquid_conductivity, liquid_capacity, 1},
                          latent_heat,
                          0};
      problem.inner = inner;
      problem.outer = outer;
      problem.end_time = shell.end_time;
      problem.initial_fronts = {start_front};
      problem.initial_temperature = [=](double r) { return shell.profile(r); };
      problem.inner_wall = {BoundaryKind::fixed_temperature,
                            [=](double) { return shell.profile(inner); }};
      problem.outer_wall = {BoundaryKind::fixed_temperature,
                            [=](double) { return shell.profile(outer); }};
      if(shell.coefficient > 0)
        problem.outer_wall = {BoundaryKind::heat_transfer,
                              [=](double) { return shell.ambient(); }, shell.coefficient};
      return SpectralOracle(problem).front(shell.end_time);
    }
  } // namespace

  TEST(IndependentCheck, Annulus)
  {
    EXPECT_NEAR(by_oracle({2}), 0.63204736885, 1e-11);
    EXPECT_NEAR(extrapolated({2}), 0.63204736885, 2e-8);
  }

  TEST(IndependentCheck, SphericalShell)
  {
    EXPECT_NEAR(extrapolated({3}), by_oracle({3}), 2e-8);
  }

  TEST(IndependentCheck, HeatTransferAtTheOuterWall)
  {
    for(const int dimension : {2, 3})
      EXPECT_NEAR(extrapolated({dimension, 3}), by_oracle({dimension, 3}), 2e-8)
          << dimension;
  }
} // namespace meltfront::cases
