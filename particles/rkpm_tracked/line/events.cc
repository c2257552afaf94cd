#include <particles/rkpm_tracked/line/events.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    constexpr double layer_over_spacing = 0.05;
    /** Where rows are balances heat that no wall gives comes with the layer. */
    constexpr double balanced_layer_over_spacing = 0.01;
    constexpr double layer_over_room = 0.25;
    /** A wall that gives a flux drives a layer of any thickness alike: the thinner the
     * layer, the less latent heat is put in or taken out with it. */
    constexpr double flux_layer_over_spacing = 1e-3;
  } // namespace

  std::pair<std::size_t, double> thinnest_interval(const LineProblem &problem,
                                                   const LineState &state)
  {
    std::pair<std::size_t, double> result{0,
                                          problem.nodes.back() - problem.nodes.front()};
    for(std::size_t p = 0; p < state.n_intervals(); ++p)
    {
      const LineInterval phase = interval(problem, state, p);
      if(phase.upper - phase.lower < result.second)
        result = {p, phase.upper - phase.lower};
    }
    return result;
  }

  std::pair<std::optional<std::size_t>, std::string>
  enclosed_phase(const LineProblem &problem, const LineState &state)
  {
    for(std::size_t p = 0; p < state.n_intervals() && !state.fronts.empty(); ++p)
    {
      if(problem.displacement(state.solid(p)) == 0)
        continue;
      const LineInterval phase = interval(problem, state, p);
      if(phase.lower_front && phase.upper_front)
        return {p, fmt::format("between two fronts, {:.4g} and {:.4g} m", phase.lower,
                               phase.upper)};
      if(problem.axis && p == 0)
        return {p, "at the centre"};
    }
    return {};
  }

  Vanished remove_interval(const LineProblem &problem, LineState &state,
                           std::size_t number)
  {
    const LineInterval phase = interval(problem, state, number);
    const double melting = problem.material.melting_temperature;
    const double thickness = phase.upper - phase.lower;
    const cases::PhaseProperties &properties = problem.phase(phase.solid);
    Vanished result;
    result.place = (phase.lower + phase.upper) / 2;
    result.solid = phase.solid;
    result.at_wall = !(phase.lower_front && phase.upper_front);
    if(!phase.solid)
      result.latent = properties.density * problem.material.latent_heat * thickness;
    for(std::size_t i = 0; i < problem.nodes.size(); ++i)
    {
      const double x = problem.nodes[i];
      if(x < phase.lower || x > phase.upper)
        continue;
      const bool on_wall = i == 0 || i + 1 == problem.nodes.size();
      // The profile is a triangle between wall and front.
      if(on_wall)
        result.sensible = properties.volumetric_heat_capacity() * thickness / 2
                          * (state.temperature[i] - melting);
      if(!on_wall || !problem.walls[i == 0 ? 0 : 1].fixed())
        state.temperature[i] = melting;
    }
    if(number == 0)
      state.solid_first = !state.solid_first;
    const auto first = state.fronts.begin()
                       + static_cast<std::ptrdiff_t>(number == 0 ? 0 : number - 1);
    state.fronts.erase(first, first + (result.at_wall ? 1 : 2));
    return result;
  }

  double wall_excess(const LineProblem &problem, const LineState &state, std::size_t side)
  {
    // Where no heat is released, an insulated wall passes the melting temperature by the
    // scheme's error alone, as the last of a phase beside it may.
    if((side == 0 && problem.axis)
       || (problem.walls[side].kind == cases::BoundaryKind::insulated
           && !problem.volumetric_source))
      return -std::numeric_limits<double>::infinity();
    const double wall = side == 0 ? state.temperature.front() : state.temperature.back();
    const double excess = wall - problem.material.melting_temperature;
    return state.solid(side == 0 ? 0 : state.n_intervals() - 1) ? excess : -excess;
  }

  LineHeat heat_before_layers(const LineProblem &problem, LineState state)
  {
    for(const std::size_t side : {0, 1})
      if(!problem.metastable && wall_excess(problem, state, side) > 0)
        (side == 0 ? state.temperature.front() : state.temperature.back())
            = problem.material.melting_temperature;
    return heat_of(problem, state);
  }

  double insert_layer(const LineProblem &problem, LineState &state, std::size_t side)
  {
    const LineInterval phase
        = interval(problem, state, side == 0 ? 0 : state.n_intervals() - 1);
    const double share = !problem.walls[side].fixed() ? flux_layer_over_spacing
                         : problem.balanced()         ? balanced_layer_over_spacing
                                                      : layer_over_spacing;
    const double wall = side == 0 ? phase.lower : phase.upper;
    const double thickness = std::min(share * problem.spacing_at(wall),
                                      layer_over_room * (phase.upper - phase.lower));
    if(side == 0)
    {
      state.fronts.insert(state.fronts.begin(), phase.lower + thickness);
      state.solid_first = !state.solid_first;
    }
    else
      state.fronts.push_back(phase.upper - thickness);
    return thickness;
  }
} // namespace meltfront::particles::rkpm_tracked
