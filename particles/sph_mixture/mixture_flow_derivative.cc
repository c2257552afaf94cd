#include <particles/sph_mixture/mixture_flow.h>

#include <algorithm>

namespace meltfront::particles
{
  void MixtureFlow::linearise(double fraction, MixtureView state)
  {
    if(!derivative)
    {
      derivative.emplace(substance, conduction, state.enthalpy.size());
      wall_diagonal.resize(padded_size());
      diagonal.resize(padded_size());
    }
    derivative->linearise(rows.rows, state.enthalpy, state.composition, thread_count);
    std::fill(wall_diagonal.begin(), wall_diagonal.end(), 0.);
    if(wall_temperature)
      wall_temperature->differentiate([this](std::size_t row, double wall)
                                      { return derivative->from_wall(row, wall); },
                                      fraction, wall_diagonal);
    if(wall_exchange)
      wall_exchange->differentiate(
          [this](std::size_t row, const cases::Boundary &wall, double ambient,
                 double depth)
          { return derivative->from_surroundings(row, wall, ambient, depth); },
          fraction, wall_diagonal, 1.);
    const std::span<const double> of_rows = derivative->row_diagonal();
    for(std::size_t a = 0; a < rows.rows.rows(); ++a)
      diagonal[a] = of_rows[a] + wall_diagonal[a];
    rows.take_per_cell(diagonal);
    if(wall_temperature)
      for(const std::uint32_t row : wall_temperature->dirichlet_rows())
        diagonal[row] = 0;
  }

  void MixtureFlow::apply_derivative(std::span<const double> change,
                                     std::span<double> flow_change)
  {
    derivative->apply(rows.rows, change, flow_change, thread_count);
    ++evaluations;
    for(std::size_t a = 0; a < rows.rows.rows(); ++a)
      flow_change[a] += wall_diagonal[a] * change[a];
    rows.take_per_cell(flow_change);
    if(wall_temperature)
      for(const std::uint32_t row : wall_temperature->dirichlet_rows())
        flow_change[row] = 0;
    std::fill(flow_change.begin() + static_cast<std::ptrdiff_t>(rows.rows.rows()),
              flow_change.end(), 0.);
  }
} // namespace meltfront::particles
