#include <cases/error.h>
#include <particles/rkpm_tracked/line/collocation.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Spacings over the thickness of a layer before a front, V h/a: up to the one it is
     * resolved, from the other on it is fitted. */
    constexpr double resolved_peclet = 0.25, unresolved_peclet = 0.75;
  } // namespace

  using cases::BoundaryKind;

  LineInterval interval(const LineProblem &problem, const LineState &state,
                        std::size_t number)
  {
    LineInterval result;
    result.lower_front = number > 0;
    result.upper_front = number < state.fronts.size();
    result.lower = result.lower_front ? state.fronts[number - 1] : problem.nodes.front();
    result.upper = result.upper_front ? state.fronts[number] : problem.nodes.back();
    result.solid = state.solid(number);
    return result;
  }

  LineCollocation::LineCollocation(const LineProblem &problem,
                                   const LineSettings &settings)
    : problem(problem)
    , interpolation_distance(std::max(settings.interpolation_distance, coincidence))
    , dilation(settings.dilation)
    , stencils(settings.basis_order)
    , regular(problem.nodes.size())
    , interpolated(problem.nodes.size())
  {
    cloud.dimension = 1;
    cloud.position[0] = problem.nodes;
    for(std::size_t i = 0; i < problem.nodes.size(); ++i)
      evaluate_stencil(problem.nodes[i], regular[i]);
    if(problem.balanced())
      make_regular_faces();
  }

  void LineCollocation::evaluate_stencil(double place, LineStencil &stencil)
  {
    stencils.evaluate(place, dilation * problem.spacing_at(place), cloud, stencil);
  }

  void LineCollocation::nodes_moved(std::span<const double> before)
  {
    const std::vector<double> &x = problem.nodes;
    const auto moved = [&](std::size_t i) { return x[i] != before[i]; };
    cloud.position[0] = x;
    for(std::size_t i = 0; i < x.size(); ++i)
    {
      bool touched = false;
      const std::size_t from
          = regular[i].first - std::min<std::size_t>(regular[i].first, 1);
      for(std::size_t j = from; j < std::min(regular[i].end() + 1, x.size()); ++j)
        touched = touched || moved(j);
      if(touched)
        evaluate_stencil(x[i], regular[i]);
    }
    if(problem.balanced())
      make_regular_faces();
  }

  std::pair<std::size_t, std::size_t>
  LineCollocation::nodes_of(const LineInterval &interval) const
  {
    const std::vector<double> &x = problem.nodes;
    const double near = coincidence * problem.spacing;
    const auto begin = interval.lower_front
                           ? std::upper_bound(x.begin(), x.end(), interval.lower + near)
                           : x.begin();
    const auto past = interval.upper_front
                          ? std::lower_bound(begin, x.end(), interval.upper - near)
                          : x.end();
    return {static_cast<std::size_t>(begin - x.begin()),
            static_cast<std::size_t>(past - x.begin())};
  }

  /** Over the spacing. Where a layer is thinner than a cell the heat of a node that is
   * left out, a cell's all of a sudden, would leave the front no place. */
  double LineCollocation::distance_left_out(const LineInterval &interval) const
  {
    return is_steep(interval) ? coincidence : interpolation_distance;
  }

  void LineCollocation::gather(const LineInterval &interval, double left_out_within)
  {
    const std::vector<double> &x = problem.nodes;
    std::tie(all_first, all_end) = nodes_of(interval);
    first = all_first;
    end = all_end;
    // A node on a wall stays, however near the front is.
    const double near_lower = left_out_within * problem.spacing_at(interval.lower);
    const double near_upper = left_out_within * problem.spacing_at(interval.upper);
    const auto leave_out = [&](std::size_t node, double distance, double near)
    {
      const bool may_stay = distance > near / 4 && distance < 2 * near;
      return kept && may_stay ? interpolated[node] : distance < near;
    };
    while(interval.lower_front && first < end && first + 1 < x.size()
          && leave_out(first, x[first] - interval.lower, near_lower))
      ++first;
    while(interval.upper_front && end > first && end > 1
          && leave_out(end - 1, interval.upper - x[end - 1], near_upper))
      --end;
    for(std::size_t i = all_first; i < all_end; ++i)
      interpolated[i] = i < first || i >= end;
    std::vector<double> &place = cloud.position[0];
    place.clear();
    if(interval.lower_front)
      place.push_back(interval.lower);
    offset = place.size();
    for(std::size_t i = first; i < end; ++i)
      place.push_back(x[i]);
    if(interval.upper_front)
      place.push_back(interval.upper);
    if(rows.size() < place.size())
    {
      rows.resize(place.size());
      coefficients.resize(place.size());
    }
  }

  const LineStencil &LineCollocation::stencil(std::size_t point)
  {
    const double place = cloud.position[0][point];
    LineStencil &row = rows[point];
    const std::size_t node = first + point - offset;
    if(point >= offset && node < end)
    {
      const LineStencil &known = regular[node];
      const bool inside = known.first >= first && known.end() <= end;
      const bool below = offset == 1 && place - cloud.position[0].front() < known.radius;
      const bool above = offset + (end - first) < cloud.size()
                         && cloud.position[0].back() - place < known.radius;
      if(inside && !below && !above)
      {
        row = known;
        row.first = known.first - first + offset;
        return row;
      }
    }
    evaluate_stencil(place, row);
    return row;
  }

  void LineCollocation::add_row(std::size_t point, const LineInterval &interval,
                                const StepTerms &terms)
  {
    const LineStencil &row = rows[point];
    const double x = cloud.position[0][point];
    const cases::PhaseProperties &phase = problem.phase(interval.solid);
    const double diffusivity = phase.diffusivity();
    const int bends = problem.balanced() ? 0 : problem.curvature_terms();
    double slope = bends > 0 ? -diffusivity * bends / x : 0.;
    if(terms.displaced_speed != 0)
    {
      double speed = terms.displaced_speed;
      for(int i = 0; i < bends; ++i)
        speed *= terms.displacing_front / x;
      slope += speed;
    }
    std::vector<double> &values = coefficients[point];
    values.resize(row.size());
    for(std::size_t j = 0; j < row.size(); ++j)
      values[j] = slope * row.slope[j] - diffusivity * row.second[j];
    values[point - row.first] += terms.leading;
    right_side[point] = -terms.history[first + point - offset];
  }

  void LineCollocation::add_release(const LineInterval &interval, double time)
  {
    const double capacity = problem.phase(interval.solid).volumetric_heat_capacity();
    for(std::size_t p = 1; p + 1 < cloud.size(); ++p)
      right_side[p] += problem.volumetric_source(cloud.position[0][p], time) / capacity;
  }

  void LineCollocation::make_rows(const LineInterval &interval, const StepTerms &terms)
  {
    const std::size_t points = cloud.size();
    right_side.resize(points);
    if(problem.balanced())
    {
      find_faces(interval, terms);
      find_shares_of_faces(interval, terms);
      measure_cells();
    }
    for(std::size_t p = 0; p < points; ++p)
    {
      const LineStencil &row = problem.balanced() ? balance(p) : stencil(p);
      const bool lower_end = p == 0, upper_end = p + 1 == points;
      if((lower_end && interval.lower_front) || (upper_end && interval.upper_front))
      {
        coefficients[p].assign(row.size(), 0.);
        coefficients[p][p - row.first] = 1;
        const UnseenRelease &beside = unseen[lower_end ? 0 : 1];
        right_side[p] = problem.material.melting_temperature
                        + beside.density * beside.reach * beside.reach
                              / (2 * problem.phase(interval.solid).conductivity);
      }
      else if(lower_end || upper_end)
      {
        const int side = upper_end ? 1 : 0;
        walls[static_cast<std::size_t>(problem.walls[side].kind)].measure(
            [&] { add_wall_row(p, side, interval, terms); });
      }
      else
        add_row(p, interval, terms);
      entries += static_cast<long>(row.size());
    }
    if(problem.volumetric_source)
      release.measure([&] { add_release(interval, terms.time); });
  }

  const cases::EffectMeter *LineCollocation::meter(cases::Effect effect) const
  {
    const auto of_wall
        = [&](BoundaryKind kind) { return &walls[static_cast<std::size_t>(kind)]; };
    switch(effect)
    {
    case cases::Effect::volumetric_source:
      return &release;
    case cases::Effect::wall_temperature:
      return of_wall(BoundaryKind::fixed_temperature);
    case cases::Effect::wall_flux:
      return of_wall(BoundaryKind::flux);
    case cases::Effect::robin_wall:
      return of_wall(BoundaryKind::heat_transfer);
    case cases::Effect::radiating_wall:
      return of_wall(BoundaryKind::radiation);
    default:
      return nullptr;
    }
  }

  void LineCollocation::fill_matrix()
  {
    const std::size_t points = cloud.size();
    std::size_t below = 0, above = 0;
    for(std::size_t p = 0; p < points; ++p)
    {
      below = std::max(below, p - std::min(p, rows[p].first));
      above = std::max(above, rows[p].end() - 1 - std::min(rows[p].end() - 1, p));
    }
    matrix.reset(points, below, above);
    for(std::size_t p = 0; p < points; ++p)
    {
      // Rows of equal size, for the sake of the pivots.
      double largest = 0;
      for(const double value : coefficients[p])
        largest = std::max(largest, std::abs(value));
      for(std::size_t j = 0; j < rows[p].size(); ++j)
        matrix(p, rows[p].first + j) = coefficients[p][j] / largest;
      right_side[p] /= largest;
    }
  }

  EndSlopes LineCollocation::solve(const LineInterval &interval, const StepTerms &terms,
                                   std::span<double> temperature)
  {
    gather(interval, distance_left_out(interval));
    if(cloud.size() < 2)
      throw cases::InputError("rkpm-tracked: a phase needs two points at least");
    unseen = {};
    if(problem.volumetric_source)
      release.measure(
          [&]
          {
            for(const std::size_t side : {0, 1})
              if(side == 0 ? interval.lower_front : interval.upper_front)
                unseen[side] = unseen_release(side, terms.time);
          });
    wall_guess = {temperature.front(), temperature.back()};
    for(int pass = 0; pass < most_passes; ++pass)
    {
      make_rows(interval, terms);
      fill_matrix();
      if(!matrix.solve(right_side))
        throw cases::InputError("rkpm-tracked: the equations of a phase are singular");
      if(walls_settled(interval))
        break;
    }
    for(std::size_t i = first; i < end; ++i)
      temperature[i] = right_side[i - first + offset];
    interpolate_absorbed(interval, temperature);
    EndSlopes slopes
        = problem.balanced() ? balanced_slopes(interval, terms) : end_slopes();
    for(std::size_t side = 0; side < 2; ++side)
      if(terms.approach[side] > 0 && !problem.balanced())
        slopes[side] *= slope_over_resolved(interval, side, terms.approach[side]);
    for(std::size_t side = 0; side < 2; ++side)
      slopes[side] += (side == 0 ? 1 : -1) * unseen[side].density * unseen[side].reach
                      / problem.phase(interval.solid).conductivity;
    return slopes;
  }

  /** By bisection, from what the two nodes nearest to the front continue to it. */
  LineCollocation::UnseenRelease LineCollocation::unseen_release(std::size_t side,
                                                                 double time) const
  {
    constexpr std::size_t fewest_points = 4;
    constexpr double beside = 1e-9;
    constexpr int bisections = 30;
    constexpr double middle_of_cell = 0.25; // of the way to the first node
    const std::vector<double> &x = cloud.position[0];
    const auto point = [&](std::size_t from_front)
    { return side == 0 ? x[from_front] : x[x.size() - 1 - from_front]; };
    const auto density
        = [&](double place) { return problem.volumetric_source(place, time); };
    const double front = point(0), way = point(1) - front;
    if(x.size() < fewest_points)
      return {.seen = density(front + middle_of_cell * way)};
    const double at_node = density(point(1));
    const double rise = (density(point(2)) - at_node) / (point(2) - point(1)) * way;
    const auto excess = [&](double share)
    { return density(front + share * way) - at_node - rise * (share - 1); };
    const double jump = excess(beside);
    double within = beside, beyond = 1;
    for(int i = 0; i < bisections; ++i)
    {
      const double middle = (within + beyond) / 2;
      (std::abs(excess(middle)) > std::abs(jump) / 2 ? within : beyond) = middle;
    }
    return {jump, within * std::abs(way), at_node + rise * (middle_of_cell - 1)};
  }

  /**
   * By how much the slope at a front that moves into a phase exceeds what its stencil
   * has. A layer of thickness a/V runs before the front, in which the temperature is 1 -
   * exp(-V x/a) steadily; the factor is what makes the stencil exact for that
   * (exponential fitting: Il'in 1969, Scharfetter and Gummel 1969), so that the front
   * draws from a phase whose layer no node resolves the heat rho c V (T - T_m) that it
   * meets. It comes in where the layer is about as thin as the spacing.
   */
  double LineCollocation::slope_over_resolved(const LineInterval &interval,
                                              std::size_t side, double approach) const
  {
    const double rate = approach / problem.phase(interval.solid).diffusivity();
    const double front = side == 0 ? interval.lower : interval.upper;
    const double share = std::clamp((rate * problem.spacing_at(front) - resolved_peclet)
                                        / (unresolved_peclet - resolved_peclet),
                                    0., 1.);
    if(share == 0)
      return 1;
    const LineStencil &row = rows[side == 0 ? 0 : cloud.size() - 1];
    double sum = 0;
    for(std::size_t j = 0; j < row.size(); ++j)
      sum -= row.slope[j]
             * std::expm1(-rate * std::abs(cloud.position[0][row.first + j] - front));
    const double factor = (side == 0 ? rate : -rate) / sum;
    return factor > 0 ? 1 + share * share * (3 - 2 * share) * (factor - 1) : 1;
  }

  void LineCollocation::interpolate_absorbed(const LineInterval &interval,
                                             std::span<double> temperature) const
  {
    const std::vector<double> &place = cloud.position[0];
    // Heat is told by straight lines between the points, which these must not change.
    const std::size_t points
        = std::min<std::size_t>(place.size(), problem.balanced() ? 2 : 3);
    const auto fill = [&](std::size_t node, std::size_t from)
    {
      const double x = problem.nodes[node];
      double value = 0;
      for(std::size_t i = from; i < from + points; ++i)
      {
        double weight = 1;
        for(std::size_t j = from; j < from + points; ++j)
          if(j != i)
            weight *= (x - place[j]) / (place[i] - place[j]);
        value += weight * right_side[i];
      }
      temperature[node] = value;
    };
    for(std::size_t node = all_first; node < first; ++node)
      fill(node, 0);
    for(std::size_t node = end; node < all_end; ++node)
      fill(node, place.size() - points);
    const double melting = problem.material.melting_temperature;
    if(interval.lower_front && all_first > 0
       && std::abs(problem.nodes[all_first - 1] - interval.lower)
              <= coincidence * problem.spacing)
      temperature[all_first - 1] = melting;
    if(interval.upper_front && all_end < problem.nodes.size()
       && std::abs(problem.nodes[all_end] - interval.upper)
              <= coincidence * problem.spacing)
      temperature[all_end] = melting;
  }

  EndSlopes LineCollocation::end_slopes() const
  {
    const double melting = problem.material.melting_temperature;
    const std::size_t last = cloud.size() - 1;
    EndSlopes result{};
    for(std::size_t side = 0; side < 2; ++side)
    {
      const LineStencil &row = rows[side == 0 ? 0 : last];
      double sum = 0;
      for(std::size_t j = 0; j < row.size(); ++j)
        sum += row.slope[j] * (right_side[row.first + j] - melting);
      result[side] = sum;
    }
    return result;
  }

  void LineCollocation::gather_values(const LineInterval &interval,
                                      std::span<const double> temperature)
  {
    gather(interval, distance_left_out(interval));
    right_side.resize(cloud.size());
    for(std::size_t p = 0; p < cloud.size(); ++p)
    {
      const bool node = p >= offset && first + p - offset < end;
      right_side[p]
          = node ? temperature[first + p - offset] : problem.material.melting_temperature;
    }
    stencil(0);
    stencil(cloud.size() - 1);
  }

  EndSlopes LineCollocation::slopes(const LineInterval &interval,
                                    std::span<const double> temperature)
  {
    gather_values(interval, temperature);
    return end_slopes();
  }
} // namespace meltfront::particles::rkpm_tracked
