#include <cases/expression_words.h>
#include <cases/time_integral.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace meltfront::cases
{
  namespace
  {
    /** Relative to the largest value: by which the rules of Gauss and of Kronrod may
     * differ. What Kronrod's then misses of a smooth function is about the square. */
    constexpr double tolerance = 1e-6;
    constexpr int deepest_of_means = 24;

    /** Of a step: how far beside a breakpoint a value is taken on its side. */
    constexpr double beside = 1e-9;

    /** Of a time: by so much round-off may have parted two that are meant to be one. */
    constexpr double time_round_off = 1e-14;

    bool is_same_time(double a, double b)
    {
      return std::abs(a - b) <= time_round_off * std::max(std::abs(a), std::abs(b));
    }

    /** The one of ascending breakpoints that is a time but for round-off, or nothing. */
    std::optional<double> breakpoint_at(const std::vector<double> &breakpoints,
                                        double time)
    {
      const auto next
          = std::ranges::lower_bound(breakpoints, time - time_round_off * std::abs(time));
      if(next == breakpoints.end() || !is_same_time(*next, time))
        return {};
      return *next;
    }

    struct Function
    {
      const Field &field;
      const Position &position;

      double operator()(double time) const
      {
        return field(position, time);
      }
    };

    double mean_of_piece(const Function &f, double begin, double end, double largest,
                         int depth)
    {
      // Nodes and weights on (-1, 1), outer ones first; the first and the middle pair
      // beside the middle are Kronrod's own.
      constexpr double gauss = 0.7745966692414834, inner = 0.4342437493468026,
                       outer = 0.9604912687080203;
      const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
      const double below = f(middle - gauss * half), at = f(middle),
                   above = f(middle + gauss * half);
      if(below == at && at == above)
        return at;
      const double by_gauss = (5 * below + 8 * at + 5 * above) / 18;
      const double ends[] = {f(middle - outer * half), f(middle + outer * half)};
      const double inside[] = {f(middle - inner * half), f(middle + inner * half)};
      const double by_kronrod
          = 0.5
            * (0.1046562260264673 * (ends[0] + ends[1])
               + 0.2684880898683334 * (below + above)
               + 0.4013974147759622 * (inside[0] + inside[1]) + 0.4509165386584741 * at);
      for(const double value : {below, at, above, ends[0], ends[1], inside[0], inside[1]})
        largest = std::max(largest, std::abs(value));
      if(!(std::abs(by_kronrod - by_gauss) > tolerance * largest)
         || depth == deepest_of_means)
        return by_kronrod;
      return 0.5
             * (mean_of_piece(f, begin, middle, largest, depth + 1)
                + mean_of_piece(f, middle, end, largest, depth + 1));
    }
  } // namespace

  TimeMean::TimeMean(Field field)
    : averaged(std::move(field))
    , is_steady(averaged.constant || !may_depend_on(averaged.expression, "t"))
  {
  }

  double TimeMean::operator()(const Position &position, double begin, double end) const
  {
    if(is_steady || begin == end)
      return averaged(position, end);
    const Function f{averaged, position};
    const std::vector<double> &times = averaged.breakpoints;
    auto next = std::ranges::upper_bound(times, begin);
    if(next == times.end() || *next >= end)
      return mean_of_piece(f, begin, end, 0, 0);
    double sum = 0, from = begin;
    for(; next != times.end() && *next < end; from = *next++)
      sum += (*next - from) * mean_of_piece(f, from, *next, 0, 0);
    sum += (end - from) * mean_of_piece(f, from, end, 0, 0);
    return sum / (end - begin);
  }

  StepIntegrals::StepIntegrals(const Field &field, std::vector<Position> points)
    : mean(field)
    , points(std::move(points))
  {
  }

  std::span<const double> StepIntegrals::over(double begin, double end)
  {
    for(const std::size_t kept : {latest, 1 - latest})
      if(!steps[kept].integral.empty() && steps[kept].begin == begin
         && steps[kept].end == end)
      {
        latest = kept;
        return steps[kept].integral;
      }
    latest = 1 - latest;
    Step &step = steps[latest];
    step.begin = begin;
    step.end = end;
    step.integral.resize(points.size());
    for(std::size_t i = 0; i < points.size(); ++i)
      step.integral[i] = (end - begin) * mean(points[i], begin, end);
    return step.integral;
  }

  std::span<const double> StepIntegrals::steady_values()
  {
    std::vector<double> &values = steps[0].integral;
    if(values.size() != points.size())
      for(const Position &point : points)
        values.push_back(mean.field()(point, 0));
    return values;
  }

  std::size_t StepIntegrals::bytes() const
  {
    return points.size() * (sizeof(Position) + 2 * sizeof(double));
  }

  std::vector<double> breakpoints_of(const Scene &scene)
  {
    std::vector<double> times;
    const auto add = [&](const Field &field)
    {
      for(const double time : field.breakpoints)
        if(time > scene.start_time && time < scene.end_time)
          times.push_back(time);
    };
    for(const Side side : scene.sides())
      add(scene.boundary(side).value);
    if(scene.volumetric_source)
      add(*scene.volumetric_source);
    std::ranges::sort(times);
    const auto repeated = std::ranges::unique(times, is_same_time);
    times.erase(repeated.begin(), repeated.end());
    return times;
  }

  bool breaks_at(const Field &field, double time)
  {
    return breakpoint_at(field.breakpoints, time).has_value();
  }

  double snap_to_breakpoint(const std::vector<double> &breakpoints, double time)
  {
    return breakpoint_at(breakpoints, time).value_or(time);
  }

  double end_of_piece(const std::vector<double> &breakpoints, double begin, double end)
  {
    const auto next = std::ranges::upper_bound(breakpoints, begin);
    return next == breakpoints.end() ? end : std::min(*next, end);
  }

  double value_at_end(const Field &field, const Position &position, double begin,
                      double end)
  {
    return field(position, breaks_at(field, end) ? end - beside * (end - begin) : end);
  }

  double value_at_begin(const Field &field, const Position &position, double begin,
                        double end)
  {
    return field(position,
                 breaks_at(field, begin) ? begin + beside * (end - begin) : begin);
  }
} // namespace meltfront::cases
