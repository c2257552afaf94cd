#include <cases/dense_sampling.h>
#include <cases/error.h>
#include <cases/expression_words.h>
#include <cases/step_ends.h>
#include <cases/time_integral.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace meltfront::cases
{
  namespace
  {
    /** Of the temperature range: a step's departure from a straight line, times n. */
    constexpr double departure_times_cells = 0.25;

    /** Of the temperature range: samples follow a swing that departs less than that from
     * the lines between them. */
    constexpr double followed = 0.002;

    constexpr int first_intervals = 64, samples_of_interval = 5;

    /** Intervals are halved no more often than that: what is left is a jump. */
    constexpr int deepest = 16;

    constexpr std::size_t most_intervals = 400'000;
    constexpr std::size_t most_places = 129;

    /** What is prescribed at a place of a wall. */
    struct Place
    {
      const Field *field;
      Position position;
    };

    /** Between two times: the square root of what a step of unit length would depart from
     * a straight line, of the temperature range (s^-1). */
    struct Interval
    {
      double begin = 0, end = 0, rate = 0;
      bool jumps = false; ///< however short it is
    };

    std::vector<Place> places_of(const Scene &scene)
    {
      std::vector<Place> result;
      for(const Side side : scene.sides())
      {
        const Boundary &boundary = scene.boundary(side);
        if(!gives_temperature(boundary) || TimeMean(boundary.value).steady())
          continue;
        std::vector<Position> points;
        visit_wall_densely(scene, side, boundary.value,
                           [&](const Position &p) { points.push_back(p); });
        const bool uniform = !may_depend_on(boundary.value.expression, "xyz");
        const std::size_t places = uniform ? 1 : std::min(points.size(), most_places);
        for(std::size_t i = 0; i < places; ++i)
          result.push_back({&boundary.value, points[i * points.size() / places]});
      }
      return result;
    }

    class SwingSearch
    {
    public:
      SwingSearch(const std::vector<Place> &places, double range)
        : places(places)
        , range(range)
        , samples(samples_of_interval * places.size())
      {
      }

      void search(double begin, double end, int depth = 0)
      {
        sample(begin, end);
        const double departure = largest_departure();
        const bool is_followed = !(std::isfinite(departure) && departure > followed);
        if(!is_followed && depth < deepest)
        {
          const double middle = 0.5 * (begin + end);
          search(begin, middle, depth + 1);
          search(middle, end, depth + 1);
          return;
        }
        if(found.size() == most_intervals)
          throw Refusal(fmt::format(
              "a wall's temperature swings faster than steps can follow, at t = {:.6g} s "
              "within {:.2g} s: prescribe its mean",
              begin, end - begin));
        found.push_back({begin, end, largest_rate(), !is_followed});
      }

      const std::vector<Interval> &intervals() const
      {
        return found;
      }

    private:
      /** At times of equal parts, each shifted by multiples of the golden ratio. */
      void sample(double begin, double end)
      {
        constexpr double golden = 0.6180339887498949;
        for(int i = 0; i < samples_of_interval; ++i)
        {
          shift = std::fmod(shift + golden, 1.);
          times[i]
              = begin + (end - begin) * (i + 0.2 + 0.6 * shift) / samples_of_interval;
          for(std::size_t p = 0; p < places.size(); ++p)
            samples[p * samples_of_interval + i]
                = (*places[p].field)(places[p].position, times[i]);
        }
      }

      /** Of a sample from the line between its neighbours, of the range. */
      double departure(std::size_t place, int i) const
      {
        const double *value = &samples[place * samples_of_interval];
        const double share = (times[i] - times[i - 1]) / (times[i + 1] - times[i - 1]);
        return std::abs(value[i] - (1 - share) * value[i - 1] - share * value[i + 1])
               / range;
      }

      double largest_departure() const
      {
        double largest = 0;
        for(std::size_t p = 0; p < places.size(); ++p)
          for(int i = 1; i + 1 < samples_of_interval; ++i)
            largest = std::max(largest, departure(p, i));
        return largest;
      }

      /** A parabola departs by a b/2 times its second derivative between points a before
       * and b behind, and by an eighth of that times the square of a step in a step. */
      double largest_rate() const
      {
        double largest = 0;
        for(std::size_t p = 0; p < places.size(); ++p)
          for(int i = 1; i + 1 < samples_of_interval; ++i)
            largest = std::max(
                largest, departure(p, i)
                             / ((times[i] - times[i - 1]) * (times[i + 1] - times[i])));
        return std::sqrt(largest / 4);
      }

      const std::vector<Place> &places;
      double range;
      double shift = 0;
      double times[samples_of_interval] = {};
      std::vector<double> samples; ///< those of a place beside each other
      std::vector<Interval> found;
    };

    double temperature_range(const Scene &scene, const std::vector<Place> &places)
    {
      const TemperatureBounds bounds = temperature_bounds(scene);
      double lower = bounds.lower, upper = bounds.upper;
      if(!std::isfinite(upper - lower))
      {
        lower = upper = scene.material.melting_temperature;
        for(const Place &place : places)
          visit_values_in_time(scene, *place.field, {place.position},
                               [&](double value)
                               {
                                 lower = std::min(lower, value);
                                 upper = std::max(upper, value);
                               });
      }
      return upper - lower;
    }

    /** Until the next breakpoint, a jump is followed like the half of a swing that is as
     * large. */
    void follow_jumps(const std::vector<Place> &places, double range,
                      const std::vector<double> &breakpoints,
                      std::vector<Interval> &intervals)
    {
      std::size_t interval = 0;
      for(std::size_t i = 0; i < breakpoints.size(); ++i)
      {
        const double begin = breakpoints[i];
        while(interval < intervals.size() && intervals[interval].begin < begin)
          ++interval;
        const double end
            = i + 1 < breakpoints.size() ? breakpoints[i + 1] : intervals.back().end;
        const double beside = 1e-9 * (end - begin);
        double jump = 0;
        for(const auto &[field, position] : places)
          jump = std::max(jump, std::abs((*field)(position, begin + beside)
                                         - (*field)(position, begin - beside)));
        const double rate = std::sqrt(jump / range) / (end - begin);
        for(; interval < intervals.size() && intervals[interval].begin < end; ++interval)
          intervals[interval].rate = std::max(intervals[interval].rate, rate);
      }
    }

    /** How fast what walls prescribe swings, in intervals that cover the run and end at
     * its breakpoints; empty where nothing does. */
    std::vector<Interval>
    swings_of(const Scene &scene, const std::vector<double> &breakpoints, bool jumps_too)
    {
      const std::vector<Place> places = places_of(scene);
      const double range = places.empty() ? 0 : temperature_range(scene, places);
      if(!(range > 0))
        return {};
      std::vector<double> stops = breakpoints;
      for(int i = 0; i <= first_intervals; ++i)
        stops.push_back(i == first_intervals ? scene.end_time
                                             : scene.start_time
                                                   + (scene.end_time - scene.start_time)
                                                         * i / first_intervals);
      std::ranges::sort(stops);
      SwingSearch search(places, range);
      for(std::size_t i = 0; i + 1 < stops.size(); ++i)
        search.search(stops[i], stops[i + 1]);
      // Where a swing turns the other way an interval may see little of it: it takes as
      // many steps as those beside it, in as much time.
      const std::vector<Interval> &found = search.intervals();
      std::vector<Interval> result = found;
      if(!jumps_too)
      {
        std::erase_if(result, [](const Interval &interval) { return interval.jumps; });
        return result;
      }
      const auto length = [&](std::size_t i) { return found[i].end - found[i].begin; };
      const auto learn = [&](std::size_t i, std::size_t beside)
      {
        result[i].rate
            = std::max(result[i].rate,
                       found[beside].rate * std::min(1., length(beside) / length(i)));
      };
      for(std::size_t i = 0; i + 1 < found.size(); ++i)
      {
        learn(i, i + 1);
        learn(i + 1, i);
      }
      follow_jumps(places, range, breakpoints, result);
      return result;
    }

    /** Intervals that adjoin, between times at which steps end anyway, are divided in
     * equal shares of the steps that they take together. */
    void divide(std::span<const Interval> adjoining, double steps_of_rate,
                std::vector<double> &ends)
    {
      double all = 0;
      for(const Interval &interval : adjoining)
        all += interval.rate * (interval.end - interval.begin);
      const double share = all / std::ceil(all * steps_of_rate);
      ends.push_back(adjoining.front().begin);
      double done = 0;
      double next = share;
      for(const Interval &interval : adjoining)
      {
        const double after = done + interval.rate * (interval.end - interval.begin);
        for(; next < after && next < all * (1 - 1e-9); next += share)
          ends.push_back(interval.begin + (next - done) / interval.rate);
        done = after;
      }
      ends.push_back(adjoining.back().end);
    }
  } // namespace

  std::vector<double> step_ends(const Scene &scene, int n, double longest)
  {
    const std::vector<double> breakpoints = breakpoints_of(scene);
    const std::vector<Interval> swings = swings_of(scene, breakpoints, true);
    const double steps_of_rate = std::sqrt(n / departure_times_cells);
    const auto is_fast
        = [&](const Interval &swing) { return swing.rate * steps_of_rate * longest > 1; };
    std::vector<double> ends = breakpoints;
    for(std::size_t i = 0, next = 1; i < swings.size(); i = next++)
    {
      if(!is_fast(swings[i]))
        continue;
      while(next < swings.size() && is_fast(swings[next])
            && !std::ranges::binary_search(breakpoints, swings[next].begin))
        ++next;
      divide(std::span(swings).subspan(i, next - i), steps_of_rate, ends);
    }
    std::erase_if(ends, [&](double time)
                  { return !(time > scene.start_time && time < scene.end_time); });
    std::ranges::sort(ends);
    const auto repeated = std::ranges::unique(ends);
    ends.erase(repeated.begin(), repeated.end());
    return ends;
  }

  double longest_step_of_walls(const Scene &scene, int n)
  {
    double fastest = 0;
    for(const Interval &swing : swings_of(scene, breakpoints_of(scene), false))
      fastest = std::max(fastest, swing.rate);
    return 1 / (fastest * std::sqrt(n / departure_times_cells));
  }
} // namespace meltfront::cases
