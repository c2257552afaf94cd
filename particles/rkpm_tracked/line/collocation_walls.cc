#include <cases/wall_law.h>
#include <particles/rkpm_tracked/line/collocation.h>
#include <particles/rkpm_tracked/line/measure.h>

#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    constexpr double same_temperature = 1e-13;
  } // namespace

  using cases::BoundaryKind;

  void LineCollocation::add_wall_row(std::size_t point, int side,
                                     const LineInterval &interval, const StepTerms &terms)
  {
    const double time = terms.time;
    const LineWall &wall = problem.walls[static_cast<std::size_t>(side)];
    const LineStencil &row = rows[point];
    std::vector<double> &values = coefficients[point];
    values.assign(row.size(), 0.);
    right_side[point] = 0;
    if(wall.fixed())
    {
      values[point - row.first] = 1;
      right_side[point] = wall.value(time);
      return;
    }
    const double conductivity = problem.phase(interval.solid).conductivity;
    const double outward = side == 0 ? -1 : 1;
    for(std::size_t j = 0; j < row.size(); ++j)
      values[j] = outward * conductivity * row.slope[j];
    if(wall.kind == BoundaryKind::flux)
      right_side[point] = problem.balanced()
                              ? terms.given_flux[static_cast<std::size_t>(side)]
                              : wall.value(time);
    if(cases::exchanges_heat(wall.kind))
    {
      const cases::HeatTransfer transfer = cases::heat_transfer_near(
          wall.law, wall.value(time), wall_guess[static_cast<std::size_t>(side)]);
      values[point - row.first] += transfer.coefficient;
      right_side[point] = transfer.coefficient * transfer.ambient;
    }
    if(problem.balanced())
      add_wall_heat(point, interval, terms);
  }

  /** What heats the cell of a wall: the condition at the wall alone would let heat that
   * no node resolves get lost between it and the first node. */
  void LineCollocation::add_wall_heat(std::size_t point, const LineInterval &interval,
                                      const StepTerms &terms)
  {
    const double cut = area(problem.symmetry, cloud.position[0][point]);
    const double share = problem.phase(interval.solid).volumetric_heat_capacity()
                         * volumes[point] / (cut > 0 ? cut : 1);
    const std::vector<double> condition = coefficients[point];
    const double given = right_side[point];
    add_row(point, interval, terms);
    std::vector<double> &values = coefficients[point];
    for(std::size_t j = 0; j < values.size(); ++j)
      values[j] = condition[j] + share * values[j];
    right_side[point] = given + share * right_side[point];
    if(problem.volumetric_source)
      right_side[point]
          += share / problem.phase(interval.solid).volumetric_heat_capacity()
             * problem.volumetric_source(cloud.position[0][point], terms.time);
  }

  /** Whether radiating walls have the temperatures about which their laws were
   * linearised, which become those just found. */
  bool LineCollocation::walls_settled(const LineInterval &interval)
  {
    bool settled = true;
    for(const std::size_t side : {0, 1})
      if(problem.walls[side].radiates()
         && !(side == 0 ? interval.lower_front : interval.upper_front))
      {
        const double found = side == 0 ? right_side.front() : right_side.back();
        settled = settled
                  && !(std::abs(found - wall_guess[side])
                       > same_temperature
                             * std::abs(found - problem.walls[side].law.absolute_zero));
        wall_guess[side] = found;
      }
    return settled;
  }

  double LineCollocation::exchanging_wall(const LineInterval &interval, std::size_t side,
                                          double ambient,
                                          std::span<const double> temperature)
  {
    gather_values(interval, temperature);
    const std::size_t point = side == 0 ? 0 : cloud.size() - 1;
    const LineStencil &row = rows[point];
    const double conductivity = problem.phase(interval.solid).conductivity;
    double value = right_side[point];
    for(int pass = 0; pass < most_passes; ++pass)
    {
      const cases::HeatTransfer transfer
          = cases::heat_transfer_near(problem.walls[side].law, ambient, value);
      double own = transfer.coefficient, others = 0;
      for(std::size_t j = 0; j < row.size(); ++j)
      {
        const double coefficient = (side == 0 ? -1 : 1) * conductivity * row.slope[j];
        if(row.first + j == point)
          own += coefficient;
        else
          others += coefficient * right_side[row.first + j];
      }
      value = (transfer.coefficient * transfer.ambient - others) / own;
      if(!problem.walls[side].radiates())
        break;
    }
    return value;
  }
} // namespace meltfront::particles::rkpm_tracked
