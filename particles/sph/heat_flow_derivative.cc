#include <particles/sph/front_derivative.h>
#include <particles/sph/heat_flow.h>

#include <algorithm>

namespace meltfront::particles
{
  template <typename Slope>
  void HeatFlow::differentiate_walls(const Slope &slope, double fraction)
  {
    wall_temperature->differentiate(
        [&](std::size_t row, double wall)
        { return slope.from_wall(row, wall, 1., derivative.slope[row]); },
        fraction, derivative.wall_diagonal);
  }

  void HeatFlow::linearise(std::span<const double> enthalpy, double fraction)
  {
    for(auto *array : {&derivative.slope, &derivative.change, &derivative.wall_diagonal,
                       &derivative.diagonal})
      array->resize(padded_size(), 0.);
    derivative.enthalpy = enthalpy.data();
    variable.slopes(enthalpy.first(n), derivative.slope);
    const double *slope = derivative.slope.data();
    // What a particle's own change does to a pair; padding has no coefficient.
    conduction.rows.apply_pairs([slope](std::size_t a, std::size_t) { return -slope[a]; },
                                derivative.diagonal, thread_count);
    std::fill(derivative.wall_diagonal.begin(), derivative.wall_diagonal.end(), 0.);
    if(front_exchange)
      front_exchange->with_pair({conduction_variable(enthalpy).data(), enthalpy.data()},
                                [&](const auto &pair)
                                {
                                  const auto follow = derivative_of(pair);
                                  conduction.rows.apply_to_slices(
                                      front_exchange->front_slices(),
                                      [&follow, slope](std::size_t a, std::size_t b) {
                                        return follow(a, b, {1., 0., slope[a], 0.});
                                      },
                                      derivative.diagonal);
                                  if(wall_temperature)
                                    differentiate_walls(follow, fraction);
                                });
    else if(wall_temperature)
      differentiate_walls(PlainDerivative(), fraction);
    if(wall_exchange)
      wall_exchange->differentiate(fraction, enthalpy, derivative.wall_diagonal, scale());
    for(std::size_t a = 0; a < n; ++a)
      derivative.diagonal[a] += derivative.wall_diagonal[a];
    conduction.take_per_cell(derivative.diagonal);
    if(wall_temperature)
      for(const std::uint32_t row : wall_temperature->dirichlet_rows())
        derivative.diagonal[row] = 0;
  }

  void HeatFlow::correct_end_change(std::span<const double> h,
                                    std::span<double> flow_change)
  {
    const std::span<const double> enthalpy(derivative.enthalpy, padded_size());
    const std::uint32_t last = liquid_end->last(), inward = last - 1;
    const std::vector<double> &w = derivative.change;
    const double change = front_exchange->with_pair(
        {conduction_variable(enthalpy).data(), enthalpy.data()},
        [&](const auto &pair) {
          return derivative_of(pair)(last, inward,
                                     {h[last], h[inward], w[last], w[inward]});
        });
    liquid_end->correct(change, flow_change);
  }

  void HeatFlow::apply_derivative(std::span<const double> change,
                                  std::span<double> flow_change)
  {
    const double *slope = derivative.slope.data(), *h = change.data();
    double *w = derivative.change.data();
    for(std::size_t a = 0; a < n; ++a)
      w[a] = slope[a] * h[a];
    if(liquid_end)
      liquid_end->hide(derivative.change);
    conduction.rows.apply(derivative.change, flow_change, thread_count);
    ++evaluations;
    if(front_exchange)
    {
      const std::span<const double> enthalpy(derivative.enthalpy, padded_size());
      front_exchange->with_pair(
          {conduction_variable(enthalpy).data(), enthalpy.data()},
          [&](const auto &pair)
          {
            conduction.rows.apply_to_slices(
                front_exchange->front_slices(),
                [follow = derivative_of(pair), h, w](std::size_t a, std::size_t b) {
                  return follow(a, b, {h[a], h[b], w[a], w[b]});
                },
                flow_change);
          });
    }
    if(liquid_end)
      correct_end_change(change, flow_change);
    for(std::size_t a = 0; a < n; ++a)
      flow_change[a] += derivative.wall_diagonal[a] * h[a];
    conduction.take_per_cell(flow_change);
    if(wall_temperature)
      for(const std::uint32_t row : wall_temperature->dirichlet_rows())
        flow_change[row] = 0;
    std::fill(flow_change.begin() + static_cast<std::ptrdiff_t>(n), flow_change.end(),
              0.);
  }
} // namespace meltfront::particles
