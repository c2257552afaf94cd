#include <particles/sph/conduction_spectrum.h>

#include <cmath>
#include <random>
#include <vector>

namespace meltfront::particles
{
  namespace
  {
    constexpr int fewest_iterations = 100, most_iterations = 20000;
    constexpr double least_growth = 1e-10; // relative, of an iteration

    double norm(std::span<const double> x)
    {
      double sum = 0;
      for(const double value : x)
        sum += value * value;
      return std::sqrt(sum);
    }

    /** y = A x */
    void apply(const ConductionRows &conduction, std::span<const std::uint32_t> held,
               std::span<const double> x, std::span<double> y)
    {
      conduction.rows.apply(x, y, 1);
      for(double &value : y)
        value = -value;
      for(const WallLink &link : conduction.temperature_links)
        y[link.row] += link.strength * x[link.row];
      conduction.take_per_cell(y);
      for(const std::uint32_t row : held)
        y[row] = 0;
    }
  } // namespace

  double largest_eigenvalue(const ConductionRows &conduction,
                            std::span<const std::uint32_t> held)
  {
    const std::size_t n = conduction.rows.rows();
    std::vector<double> x(conduction.rows.padded_rows(), 0), y(x.size());
    std::mt19937_64 generator(1);
    for(std::size_t i = 0; i < n; ++i)
      x[i] = std::normal_distribution<double>()(generator);
    for(const std::uint32_t row : held)
      x[row] = 0;
    double eigenvalue = 0;
    for(int iteration = 0; iteration < most_iterations; ++iteration)
    {
      const double length = norm(x);
      for(double &value : x)
        value /= length;
      apply(conduction, held, x, y);
      const double found = norm(y);
      const bool settled = iteration >= fewest_iterations
                           && std::abs(found - eigenvalue) <= least_growth * found;
      eigenvalue = found;
      if(settled)
        break;
      std::swap(x, y);
    }
    return eigenvalue;
  }
} // namespace meltfront::particles
