#include <particles/rkpm_tracked/line/history.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Nodes nearer to a front than this, over the spacing, do not shape its extension:
     * their weights would be large. */
    constexpr double least_distance = 0.3;
  } // namespace

  double lagrange_weight(std::span<const double> points, std::size_t own, double place)
  {
    double weight = 1;
    for(std::size_t other = 0; other < points.size(); ++other)
      if(other != own)
        weight *= (place - points[other]) / (points[own] - points[other]);
    return weight;
  }

  std::vector<double> differentiation_weights(std::span<const double> times)
  {
    // Slopes at times[0] of Lagrange's polynomials.
    std::vector<double> weights(times.size(), 0.);
    for(std::size_t j = 1; j < times.size(); ++j)
    {
      double product = 1;
      for(std::size_t m = 1; m < times.size(); ++m)
        if(m != j)
          product *= (times[0] - times[m]) / (times[j] - times[m]);
      weights[j] = product / (times[j] - times[0]);
      weights[0] -= weights[j];
    }
    return weights;
  }

  LineHistory::LineHistory(const LineProblem &problem, const LineSettings &settings)
    : problem(problem)
    , order(static_cast<std::size_t>(settings.time_order))
    , degree(static_cast<std::size_t>(std::max(3, settings.basis_order)))
  {
  }

  void LineHistory::restart(LineState state)
  {
    levels.clear();
    levels.push_front(std::move(state));
  }

  void LineHistory::push(LineState state)
  {
    levels.push_front(std::move(state));
    while(levels.size() > order)
      levels.pop_back();
  }

  void LineHistory::add_older(LineState state)
  {
    levels.push_back(std::move(state));
  }

  std::vector<double> LineHistory::times(double next) const
  {
    std::vector<double> result{next};
    for(std::size_t j = 0; j < std::min(order, levels.size()); ++j)
      result.push_back(levels[j].time);
    return result;
  }

  double LineHistory::temperature(std::size_t level, std::size_t node,
                                  std::size_t number) const
  {
    const LineState &state = levels[level];
    const double place = problem.nodes[node];
    const bool below = number > 0 && place < state.fronts[number - 1];
    const bool above = number < state.fronts.size() && place > state.fronts[number];
    if(!below && !above)
      return state.temperature[node];
    return extension(state, interval(problem, state, number), place);
  }

  LineHistory::Support LineHistory::support(const LineState &state,
                                            const LineInterval &interval,
                                            bool below) const
  {
    const std::vector<double> &x = problem.nodes;
    const double melting = problem.material.melting_temperature;
    const double front = below ? interval.lower : interval.upper;
    const double apart = least_distance * problem.spacing_at(front);
    const double far_end = below ? interval.upper : interval.lower;
    const bool far_front = below ? interval.upper_front : interval.lower_front;
    Support result;
    result.add(front, melting);
    const auto offer = [&](std::size_t node)
    {
      const bool clear = std::abs(x[node] - front) > apart
                         && (!far_front || std::abs(x[node] - far_end) > apart);
      // A wall's node counts at any distance if it is the only one.
      const bool last_chance = result.count == 1 && !far_front && x[node] == far_end;
      if(result.count <= degree && (clear || last_chance) && x[node] != front)
        result.add(x[node], state.temperature[node]);
    };
    const auto first = static_cast<std::size_t>(
        std::lower_bound(x.begin(), x.end(), interval.lower) - x.begin());
    const auto end = static_cast<std::size_t>(
        std::upper_bound(x.begin(), x.end(), interval.upper) - x.begin());
    for(std::size_t i = 0; i < end - first && result.count <= degree; ++i)
      offer(below ? first + i : end - 1 - i);
    if(result.count <= degree && far_front && std::abs(far_end - front) > apart)
      result.add(far_end, melting);
    return result;
  }

  double LineHistory::extension(const LineState &state, const LineInterval &interval,
                                double place) const
  {
    const double melting = problem.material.melting_temperature;
    const Support points = support(state, interval, place < interval.lower);
    double sum = 0;
    for(std::size_t i = 0; i < points.count; ++i)
      sum += lagrange_weight({points.place.data(), points.count}, i, place)
             * (points.value[i] - melting);
    return melting + sum;
  }
} // namespace meltfront::particles::rkpm_tracked
