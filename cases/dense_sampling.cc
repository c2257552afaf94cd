#include <cases/dense_sampling.h>
#include <cases/expression_words.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    /** Along each direction, by the number of directions that matter. */
    constexpr int samples_of_directions[] = {1, 4097, 257, 49};

    /** Numbers of expressions that become points, fewer in more dimensions. */
    constexpr std::size_t most_numbers[] = {0, 200, 20, 4};

    constexpr int most_times = 4097, fewest_times = 65, times_of_exact = 17;
    constexpr std::size_t evaluations_of_wall = 100'000;
    constexpr std::size_t samples_of_release = 1000;

    /** Of a step between samples: where an extreme is searched for to this share, its
     * error is of the order of the square. */
    constexpr int halvings_of_extreme = 12;

    bool is_exact(const Field &field)
    {
      return field.expression == "exact";
    }

    std::vector<double> coordinates(double lower, double upper, int samples,
                                    std::vector<double> named)
    {
      std::ranges::sort(named);
      std::vector<double> result;
      for(int i = 0; i < samples; ++i)
        result.push_back(lower + (upper - lower) * i / (samples - 1));
      double before = lower;
      for(const double number : named)
        if(number > lower && number < upper)
        {
          result.push_back(0.5 * (before + number));
          result.push_back(number);
          before = number;
        }
      result.push_back(0.5 * (before + upper));
      std::ranges::sort(result);
      const auto repeated = std::ranges::unique(result);
      result.erase(repeated.begin(), repeated.end());
      return result;
    }

    /** The numbers that fields name, and their negatives. */
    std::vector<double> numbers_of(const std::vector<const Field *> &fields,
                                   std::size_t most)
    {
      std::vector<double> numbers;
      for(const Field *field : fields)
        for(const double number : numbers_in(field->expression))
          for(const double sign : {-1., 1.})
            numbers.push_back(sign * number);
      std::ranges::sort(numbers);
      const auto repeated = std::ranges::unique(numbers);
      numbers.erase(repeated.begin(), repeated.end());
      if(numbers.size() > 2 * most)
        numbers.clear();
      return numbers;
    }

    void visit_radii(const Domain &domain, const std::vector<double> &named,
                     const PointVisitor &visit)
    {
      for(const double radius : coordinates(domain.inner_radius, domain.radius,
                                            samples_of_directions[1], named))
        visit({radius, 0, 0});
    }

    /** Lowest or highest value (sign -1 or 1) of a function between two places. */
    template <typename Function>
    double extreme(const Function &function, double from, double to, double sign)
    {
      constexpr double golden = 0.6180339887498949;
      double best = -std::numeric_limits<double>::infinity();
      const auto value = [&](double place)
      {
        const double found = sign * function(place);
        best = std::fmax(best, found);
        return found;
      };
      double left = to - golden * (to - from), right = from + golden * (to - from);
      double at_left = value(left), at_right = value(right);
      for(int i = 0; i < halvings_of_extreme; ++i)
        if(at_left > at_right)
        {
          to = right;
          right = left;
          at_right = at_left;
          at_left = value(left = to - golden * (to - from));
        }
        else
        {
          from = left;
          left = right;
          at_left = at_right;
          at_right = value(right = from + golden * (to - from));
        }
      return sign * best;
    }

    /** Where and when the lowest and the highest of samples are. */
    struct Extremes
    {
      struct Sample
      {
        double value;
        std::size_t number = 0; ///< of the position
        double time = 0;
      };
      Sample lowest{std::numeric_limits<double>::infinity()},
          highest{-std::numeric_limits<double>::infinity()};
    };

    /**
     * Visit the values of a field at positions over a scene's run, and the extremes in
     * time at each. @return the extremes of the samples
     */
    Extremes visit_over_run(const Scene &scene, const Field &field,
                            const std::vector<Position> &positions,
                            const ValueVisitor &visit)
    {
      const double start = scene.start_time, end = scene.end_time;
      const bool steady = field.constant || !may_depend_on(field.expression, "t");
      const bool alike = field.constant || !may_depend_on(field.expression, "xyz");
      const std::size_t count
          = alike ? std::min<std::size_t>(1, positions.size()) : positions.size();
      const int times = steady ? 1
                        : is_exact(field)
                            ? times_of_exact
                            : static_cast<int>(std::clamp<std::size_t>(
                                evaluations_of_wall / std::max<std::size_t>(count, 1),
                                fewest_times, most_times));
      const double step = (end - start) / std::max(times - 1, 1);
      Extremes all;
      for(std::size_t number = 0; number < count; ++number)
      {
        const Position &p = positions[number];
        int lowest_at = 0, highest_at = 0;
        double lowest = field(p, start), highest = lowest;
        const auto see = [&](double time)
        {
          const double value = field(p, time);
          visit(value);
          if(value < all.lowest.value)
            all.lowest = {value, number, time};
          if(value > all.highest.value)
            all.highest = {value, number, time};
          return value;
        };
        for(int i = 0; i < times; ++i)
        {
          const double value = see(i + 1 == times && !steady ? end : start + step * i);
          if(value < lowest)
          {
            lowest = value;
            lowest_at = i;
          }
          if(value > highest)
          {
            highest = value;
            highest_at = i;
          }
        }
        if(steady)
          continue;
        const double beside = 1e-9 * step;
        for(const double time : field.breakpoints)
          for(const double side : {-beside, 0., beside})
            see(std::clamp(time + side, start, end));
        for(std::size_t i = 1; i < field.breakpoints.size(); ++i)
          see(0.5 * (field.breakpoints[i - 1] + field.breakpoints[i]));
        for(const auto &[at, sign] :
            {std::pair(lowest_at, -1.), std::pair(highest_at, 1.)})
          if(at > 0 && at + 1 < times)
            visit(extreme([&](double time) { return field(p, time); },
                          start + step * (at - 1), start + step * (at + 1), sign));
      }
      return all;
    }

    /** Visit what a field has lowest and highest between positions in a row beside the
     * extremes of their samples. */
    void visit_extremes_between(const Field &field,
                                const std::vector<Position> &positions,
                                const Extremes &extremes, const ValueVisitor &visit)
    {
      for(const auto &[sample, sign] :
          {std::pair(extremes.lowest, -1.), std::pair(extremes.highest, 1.)})
      {
        if(positions.empty())
          return;
        const Position &from = positions[sample.number == 0 ? 0 : sample.number - 1],
                       &to = positions[std::min(sample.number + 1, positions.size() - 1)];
        const auto value = [&](double share)
        {
          Position p;
          for(std::size_t d = 0; d < p.size(); ++d)
            p[d] = (1 - share) * from[d] + share * to[d];
          return field(p, sample.time);
        };
        visit(extreme(value, 0, 1, sign));
      }
    }
  } // namespace

  bool may_vary_with(const Field &field, const std::string &variable)
  {
    return !field.constant
           && (may_depend_on(field.expression, variable)
               || !may_depend_on(field.expression, "xyzt"));
  }

  bool gives_temperature(const Boundary &boundary)
  {
    return !boundary.exact
           && (boundary.kind == BoundaryKind::fixed_temperature
               || boundary.kind == BoundaryKind::heat_transfer
               || boundary.kind == BoundaryKind::radiation);
  }

  Domain wall_of(const Domain &domain, Side side)
  {
    Domain wall = domain;
    const auto normal = static_cast<std::size_t>(side) / 2;
    const bool upper = static_cast<std::size_t>(side) % 2 == 1;
    const double place = (upper ? domain.upper : domain.lower)[normal];
    wall.lower[normal] = wall.upper[normal] = place;
    return wall;
  }

  void visit_densely(const Scene &scene, const std::vector<const Field *> &fields,
                     const PointVisitor &visit)
  {
    const Domain &domain = scene.domain;
    if(std::ranges::any_of(fields, [](const Field *f) { return is_exact(*f); }))
    {
      visit_points(domain, visit);
      return;
    }
    std::array<bool, 3> matters{};
    int directions = 0;
    for(int d = 0; d < domain.dimension; ++d)
    {
      const std::string variable(1, "xyz"[d]);
      matters[d] = std::ranges::any_of(fields, [&](const Field *field)
                                       { return may_vary_with(*field, variable); });
      directions += matters[d];
    }
    const bool tells_inside = domain.round() || domain.irregular();
    if(tells_inside && directions > 0)
    {
      if(domain.round() && scene.symmetry != Symmetry::none)
      {
        visit_radii(domain, numbers_of(fields, most_numbers[1]), visit);
        return;
      }
      matters = {true, domain.dimension > 1, domain.dimension > 2};
      directions = domain.dimension;
    }
    const std::vector<double> named = numbers_of(fields, most_numbers[directions]);
    std::array<std::vector<double>, 3> lines;
    for(int d = 0; d < 3; ++d)
      if(matters[d])
        lines[d] = coordinates(domain.round() ? -domain.radius : domain.lower[d],
                               domain.round() ? domain.radius : domain.upper[d],
                               samples_of_directions[directions], named);
      else
        lines[d]
            = {domain.round() ? 0.5 * (domain.inner_radius + domain.radius) * (d == 0)
                              : 0.5 * (domain.lower[d] + domain.upper[d])};
    Position p{};
    for(const double z : lines[2])
      for(const double y : lines[1])
        for(const double x : lines[0])
        {
          p = {x, y, z};
          if(directions == 0 || contains(domain, p))
            visit(p);
        }
    if(tells_inside && directions > 0)
      for(const Side side : scene.sides())
        visit_wall(domain, side, visit);
    if(domain.mesh && directions > 0)
      for(const Position &vertex : domain.mesh->vertices())
        visit(vertex);
  }

  void visit_values_in_time(const Scene &scene, const Field &field,
                            const std::vector<Position> &positions,
                            const ValueVisitor &visit)
  {
    visit_over_run(scene, field, positions, visit);
  }

  namespace
  {
    bool is_row(const Scene &scene, const Field &field)
    {
      const Domain &domain = scene.domain;
      return domain.dimension == 2 && !is_exact(field)
             && (domain.rectangular()
                 || (domain.round() && scene.symmetry == Symmetry::none));
    }

    /** Points of a wall in the plane in a row: so many, and where it is straight the
     * numbers that the field names with the middles between them; one where it does not
     * vary. */
    std::vector<Position> row_of(const Scene &scene, Side side, const Field &field,
                                 int samples)
    {
      const Domain &domain = scene.domain;
      std::vector<Position> row;
      if(domain.round())
      {
        const double radius = side == Side::inner ? domain.inner_radius : domain.radius;
        for(int i = 0; i < samples; ++i)
        {
          const double angle = 2 * std::numbers::pi * i / samples;
          row.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
        }
        return row;
      }
      const Domain wall = wall_of(domain, side);
      const std::size_t along = static_cast<std::size_t>(side) < 2 ? 1 : 0;
      Position p = wall.lower;
      p[along] = 0.5 * (wall.lower[along] + wall.upper[along]);
      if(!may_vary_with(field, along == 0 ? "x" : "y"))
        return {p};
      for(const double place : coordinates(wall.lower[along], wall.upper[along], samples,
                                           numbers_of({&field}, most_numbers[1])))
      {
        p[along] = place;
        row.push_back(p);
      }
      return row;
    }
  } // namespace

  void visit_wall_densely(const Scene &scene, Side side, const Field &field,
                          const PointVisitor &visit)
  {
    const Domain &domain = scene.domain;
    if(is_row(scene, field))
      for(const Position &p : row_of(scene, side, field, samples_of_directions[1]))
        visit(p);
    else if(domain.rectangular())
    {
      Scene wall;
      wall.domain = wall_of(domain, side);
      visit_densely(wall, {&field}, visit);
    }
    else
      visit_wall(domain, side, visit);
  }

  void visit_wall_values(const Scene &scene, Side side, const Field &field,
                         const ValueVisitor &visit)
  {
    const bool steady = !may_depend_on(field.expression, "t");
    if(is_row(scene, field))
    {
      const std::vector<Position> row
          = row_of(scene, side, field, samples_of_directions[steady ? 1 : 2]);
      visit_extremes_between(field, row, visit_over_run(scene, field, row, visit), visit);
      return;
    }
    std::vector<Position> positions;
    const auto collect = [&](const Position &p) { positions.push_back(p); };
    if(steady)
      visit_wall_densely(scene, side, field, collect);
    else
      visit_wall(scene.domain, side, collect);
    visit_over_run(scene, field, positions, visit);
  }

  void visit_release(const Scene &scene, const ValueVisitor &visit)
  {
    const Field &release = *scene.volumetric_source;
    std::vector<Position> positions;
    const auto collect = [&](const Position &p) { positions.push_back(p); };
    const bool steady = release.constant || !may_depend_on(release.expression, "t");
    if(steady || !may_depend_on(release.expression, "xyz"))
      visit_densely(scene, {&release}, collect);
    else
      visit_points(scene.domain, collect);
    if(!steady && positions.size() > samples_of_release)
    {
      std::vector<Position> some;
      const std::size_t stride = positions.size() / samples_of_release + 1;
      for(std::size_t i = 0; i < positions.size(); i += stride)
        some.push_back(positions[i]);
      positions.swap(some);
    }
    visit_values_in_time(scene, release, positions, visit);
  }
} // namespace meltfront::cases
