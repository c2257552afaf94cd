#include <particles/rkpm_tracked/line/measure.h>
#include <particles/rkpm_tracked/line/sites.h>
#include <particles/rkpm_tracked/line/solver.h>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Spacings over the thickness of a layer before a front, V h/a, from which on slopes
     * in that phase are straight. */
    constexpr double steep_peclet = 0.5;
  } // namespace

  /** Where a front was (m); where rows are balances as far away as what it has passed is
   * wide with its area of now, so that the latent heat is that between the places. */
  double LineSolver::place_before(double before, double now) const
  {
    if(!problem.balanced() || problem.symmetry == cases::Symmetry::planar)
      return before;
    const auto [own, other] = end_volumes(problem.symmetry, now, before);
    return now + (own + other) / area(problem.symmetry, now);
  }

  /** A layer that no node resolved is one until it has spread over a spacing. */
  void LineSolver::find_steep_phases()
  {
    const LineState &now = history.newest();
    if(!problem.balanced() || problem.metastable)
      return;
    for(std::size_t j = 0; j < now.fronts.size(); ++j)
    {
      const bool solid = now.solid(now.speed[j] > 0 ? j + 1 : j);
      const double diffusivity = problem.phase(solid).diffusivity();
      const double spacing = problem.spacing_at(now.fronts[j]);
      if(std::abs(now.speed[j]) * spacing > steep_peclet * diffusivity)
        steep_until[solid ? 1 : 0] = now.time + spacing * spacing / diffusivity;
    }
    steep = {now.time < steep_until[0], now.time < steep_until[1]};
    collocation.set_steep(steep);
  }

  void LineSolver::find_cells(LineState &state)
  {
    if(!problem.balanced())
      return;
    state.cells.assign(problem.nodes.size(), 0.);
    for(std::size_t p = 0; p < state.n_intervals(); ++p)
    {
      collocation.measure_cells_of(interval(problem, state, p));
      collocation.write_cells(state.cells);
    }
  }

  /** The heat of earlier states tells what has come in since. */
  void LineSolver::add_older(LineState state)
  {
    find_cells(state);
    state.taken = history.newest().taken + heat_of(problem, state).total()
                  - heat_of(problem, history.newest()).total();
    history.add_older(std::move(state));
  }

  /** What walls give over the step, by the same differences as the heat that it becomes:
   * none is lost, however a flux varies. */
  void LineSolver::find_given_flux()
  {
    for(const std::size_t side : {0, 1})
      if(const auto &mean = problem.walls[side].mean_flux)
      {
        given_flux[side] = 0;
        for(std::size_t k = 1; k < weights.size(); ++k)
          given_flux[side]
              -= weights[k] * (times[0] - times[k]) * mean(times[k], times[0]);
      }
  }

  /**
   * Heat of nodes whose cells a front cuts otherwise than before comes to that front or
   * leaves it. What a film at a held wall takes up comes from the wall, as its front's
   * slope is known.
   */
  void LineSolver::add_changed_cells(std::size_t number, const LineInterval &interval,
                                     LineState &state, EndSlopes &slopes) const
  {
    collocation.write_cells(state.cells);
    if(!interval.lower_front && !interval.upper_front)
      return;
    const double melting = problem.material.melting_temperature;
    const double middle = (interval.lower + interval.upper) / 2;
    std::array<double, 2> gain{};
    double kept = 0; // by cells as they are
    const auto add = [&](std::size_t node, double heat)
    {
      const bool upper = !interval.lower_front
                         || (interval.upper_front && problem.nodes[node] > middle);
      gain[upper ? 1 : 0] += heat;
    };
    const auto [first, end] = collocation.nodes_of(interval);
    for(std::size_t i = first; i < end; ++i)
    {
      add(i, -state.cells[i] * (rate_history[i] + weights[0] * melting));
      kept += state.cells[i] * (rate_history[i] + weights[0] * state.temperature[i]);
    }
    for(std::size_t k = 1; k < weights.size(); ++k)
    {
      const LineState &level = history.level(k - 1);
      const auto [from, to]
          = collocation.nodes_of(rkpm_tracked::interval(problem, level, number));
      for(std::size_t i = from; i < to; ++i)
        add(i, weights[k] * level.cells[i] * (level.temperature[i] - melting));
    }
    const double diffusivity = problem.phase(interval.solid).diffusivity();
    const double lower = area(problem.symmetry, interval.lower),
                 upper = area(problem.symmetry, interval.upper);
    if(collocation.is_held_film(interval))
    {
      const double taken_up = (gain[0] + gain[1] + kept) / diffusivity;
      const double at_wall
          = interval.upper_front ? state.temperature.front() : state.temperature.back();
      const double carried
          = collocation.flow() == 0 ? 0 : collocation.flow() * (at_wall - melting);
      if(interval.upper_front)
        slopes[0] = (upper * slopes[1] - taken_up + carried) / lower;
      else
        slopes[1] = (lower * slopes[0] + taken_up + carried) / upper;
      return;
    }
    if(interval.lower_front)
      slopes[0] -= gain[0] / (diffusivity * lower);
    if(interval.upper_front)
      slopes[1] += gain[1] / (diffusivity * upper);
  }

  void LineSolver::book_walls(LineState &state) const
  {
    double rate = wall_heat(problem, state);
    for(std::size_t k = 1; k < weights.size(); ++k)
      rate -= weights[k] * history.level(k - 1).taken;
    state.taken = rate / weights[0];
  }
} // namespace meltfront::particles::rkpm_tracked
