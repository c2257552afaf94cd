#include <particles/rkpm_tracked/line/history.h>
#include <particles/rkpm_tracked/line/relax.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Nodes that would move by less than this, over the spacing, stay. */
    constexpr double least_move = 1e-3;

    /** From a front, over the spacing, beyond which nodes are at rest. */
    constexpr double reach = 8;

    /** Points nearer to each other than this, over the spacing, do not both shape a
     * polynomial. */
    constexpr double least_gap = 0.05;

    /** Nodes strictly inside of an interval and off the walls, [first, end). */
    std::pair<std::size_t, std::size_t> inner_nodes(const LineProblem &problem,
                                                    const LineInterval &interval)
    {
      const std::vector<double> &x = problem.nodes;
      const double near = coincidence * problem.spacing;
      const auto first
          = std::upper_bound(x.begin() + 1, x.end() - 1, interval.lower + near);
      const auto end = std::lower_bound(first, x.end() - 1, interval.upper - near);
      return {static_cast<std::size_t>(first - x.begin()),
              static_cast<std::size_t>(end - x.begin())};
    }
  } // namespace

  LineRelaxation::LineRelaxation(const LineProblem &problem, RelaxRule rule)
    : homes(problem.nodes)
    , rule(rule)
  {
  }

  std::vector<double> LineRelaxation::places(const LineProblem &problem,
                                             const LineState &state, double time)
  {
    std::vector<double> result = problem.nodes;
    for(std::size_t p = 0; p < state.n_intervals(); ++p)
      relax(problem, state, p, time, result);
    settled = rule == RelaxRule::springs;
    return result;
  }

  void LineRelaxation::relax(const LineProblem &problem, const LineState &state,
                             std::size_t number, double time,
                             std::vector<double> &places) const
  {
    const LineInterval phase = interval(problem, state, number);
    auto [first, end] = inner_nodes(problem, phase);
    const std::vector<double> &x = problem.nodes;
    // Nodes beside a front that is about to pass their homes wait for it.
    if(rule == RelaxRule::springs && phase.lower_front && first < end)
    {
      const double way = state.speed[number - 1] * time;
      if(way > 0 && homes[first] < phase.lower + way)
      {
        places[first] = std::min(x[first], phase.lower + way / 2);
        ++first;
      }
    }
    if(rule == RelaxRule::springs && phase.upper_front && first < end)
    {
      const double way = state.speed[number] * time;
      if(way < 0 && homes[end - 1] > phase.upper + way)
      {
        places[end - 1] = std::max(x[end - 1], phase.upper + way / 2);
        --end;
      }
    }
    std::size_t below = first, above = end; // nodes between them are at rest
    const double near = reach * problem.spacing;
    while(settled && phase.lower_front && below < end && x[below] - phase.lower < near)
      ++below;
    while(settled && phase.upper_front && above > first
          && phase.upper - x[above - 1] < near)
      --above;
    if(!settled || below >= above)
    {
      relax_between(problem, {first, end}, {phase.lower, phase.upper}, places);
      return;
    }
    relax_between(problem, {first, below}, {phase.lower, x[below]}, places);
    relax_between(problem, {above, end}, {x[above - 1], phase.upper}, places);
  }

  void LineRelaxation::relax_between(const LineProblem &problem, NodeRange range,
                                     std::pair<double, double> ends,
                                     std::vector<double> &places) const
  {
    const auto [first, end] = range;
    ParticleStorage moving, home, fixed;
    for(std::size_t i = first; i < end; ++i)
    {
      moving.add({problem.nodes[i], 0, 0});
      home.add({homes[i], 0, 0});
    }
    fixed.add({ends.first, 0, 0});
    fixed.add({ends.second, 0, 0});
    CoordinateBox box;
    box.lower[0] = ends.first;
    box.upper[0] = ends.second;
    relax_phase(moving, home, fixed, box, {rule, problem.spacing, 1});
    // A node that was let go stands between its front and the others.
    double last = places[first - 1];
    bool in_order = true;
    for(const double place : moving.position[0])
    {
      in_order = in_order && place > std::max(last, ends.first);
      last = place;
    }
    in_order = in_order && last < std::min(places[end], ends.second);
    for(std::size_t i = first; i < end && in_order; ++i)
      if(std::abs(moving.position[0][i - first] - problem.nodes[i])
         > least_move * problem.spacing)
        places[i] = moving.position[0][i - first];
  }

  void resample(const LineProblem &problem, std::span<const double> places,
                std::size_t degree, LineState &state)
  {
    const std::vector<double> before = state.temperature;
    const double melting = problem.material.melting_temperature;
    const double apart = least_gap * problem.spacing;
    std::vector<double> x, value;
    for(std::size_t p = 0; p < state.n_intervals(); ++p)
    {
      const LineInterval phase = interval(problem, state, p);
      x.clear();
      value.clear();
      const auto add = [&](double place, double temperature)
      {
        x.push_back(place);
        value.push_back(temperature);
      };
      if(phase.lower_front)
        add(phase.lower, melting);
      for(std::size_t i = 0; i < problem.nodes.size(); ++i)
      {
        const double node = problem.nodes[i];
        const bool clear_below = !phase.lower_front || node > phase.lower + apart;
        const bool clear_above = !phase.upper_front || node < phase.upper - apart;
        if(clear_below && clear_above)
          add(node, before[i]);
      }
      if(phase.upper_front)
        add(phase.upper, melting);
      const auto [lowest, highest] = std::ranges::minmax_element(value);
      for(std::size_t i = 0; i < places.size(); ++i)
      {
        const double place = places[i];
        if(place == problem.nodes[i] || state.interval_of(place) != p)
          continue;
        const std::size_t count = std::min(degree + 1, x.size());
        auto from
            = static_cast<std::size_t>(std::ranges::upper_bound(x, place) - x.begin());
        from = std::min(from - std::min(from, (count + 1) / 2), x.size() - count);
        double sum = 0;
        for(std::size_t k = 0; k < count; ++k)
          sum += lagrange_weight(std::span(x).subspan(from, count), k, place)
                 * (value[from + k] - melting);
        // Where a layer is not resolved a polynomial overshoots.
        state.temperature[i] = std::clamp(melting + sum, *lowest, *highest);
      }
    }
  }
} // namespace meltfront::particles::rkpm_tracked
