#include <cases/case_file/breakpoints.h>
#include <cases/error.h>
#include <cases/expression_words.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::cases
{
  namespace
  {
    constexpr int coarsest_cuts = 512, finest_cuts = 32768, refinement = 8;
    constexpr long most_evaluations = 4'000'000;
    constexpr std::size_t most_breakpoints = 20'000;
    constexpr std::size_t most_numbers_in_threes = 5, most_numbers = 40;

    /** Of a function's range: disagreements below are none; of its largest value: those
     * of round-off. */
    constexpr double resolved = 1e-9, round_off = 1e-13;

    /** Of a function's range: disagreements that a mean over time would show. */
    constexpr double visible = 1e-6;

    /** A smooth function's disagreement falls by 32 as pieces are halved, a bend's by 2,
     * a jump's not at all. */
    constexpr double smooth_fall = 8;

    /** So many halvings without such a fall: it is no smooth feature. */
    constexpr int halvings_of_breaks = 8;

    class Interpolation
    {
    public:
      static constexpr int points = 9, known = 5, predicted = 4;

      Interpolation()
      {
        for(int i = 0; i < points; ++i)
          node[i] = -std::cos(i * std::numbers::pi / (points - 1));
        for(int p = 0; p < predicted; ++p)
          for(int k = 0; k < known; ++k)
          {
            double w = 1;
            for(int j = 0; j < known; ++j)
              if(j != k)
                w *= (node[2 * p + 1] - node[2 * j]) / (node[2 * k] - node[2 * j]);
            weight[p][k] = w;
          }
      }

      std::array<double, points> node; ///< on (-1, 1), those of Chebyshev and Lobatto
      std::array<std::array<double, known>, predicted> weight;
    };

    /** Where a function breaks: somewhere within. */
    struct Break
    {
      double lower, upper;
    };

    class Search
    {
    public:
      Search(const std::function<double(double)> &function, double start, double end)
        : function(function)
        , least_width(4 * std::numeric_limits<double>::epsilon()
                      * std::max(std::abs(start), std::abs(end)))
      {
      }

      /** Cut at times, and find the breaks.
       * @return share of pieces with features that are shorter than they */
      double run(const std::vector<double> &times)
      {
        breaks.clear();
        find_scale(times);
        long brief = 0;
        for(std::size_t i = 0; i + 1 < times.size(); ++i)
        {
          was_brief = false;
          search(times[i], times[i + 1], disagreement(times[i], times[i + 1]));
          brief += was_brief;
        }
        for(std::size_t i = 1; i + 1 < times.size(); ++i)
        {
          const double width = std::min(times[i] - times[i - 1], times[i + 1] - times[i]);
          const double from = times[i] - 0.3 * width, to = times[i] + 0.4 * width;
          search(from, to, disagreement(from, to));
        }
        return double(brief) / double(times.size() - 1);
      }

      std::vector<Break> breaks;

    private:
      double value(double time)
      {
        if(++evaluations > most_evaluations)
          throw InputError("jumps or bends more often than can be followed");
        const double result = function(time);
        if(!std::isfinite(result))
          throw InputError(fmt::format("is {} at t = {:.6g}", result, time));
        return result;
      }

      void find_scale(const std::vector<double> &times)
      {
        double lowest = value(times.front()), highest = lowest;
        const auto include = [&](double time)
        {
          const double v = value(time);
          lowest = std::min(lowest, v);
          highest = std::max(highest, v);
        };
        for(std::size_t i = 1; i < times.size(); ++i)
        {
          include(0.5 * (times[i - 1] + times[i]));
          include(times[i]);
        }
        range = highest - lowest;
        noise = round_off * std::max(std::abs(lowest), std::abs(highest));
      }

      /** Between the function on a piece and a polynomial through five of its points. */
      double disagreement(double from, double to)
      {
        static const Interpolation interpolation;
        std::array<double, Interpolation::points> values;
        for(int i = 0; i < Interpolation::points; ++i)
          values[i] = value(from + 0.5 * (1 + interpolation.node[i]) * (to - from));
        double largest = 0;
        for(int p = 0; p < Interpolation::predicted; ++p)
        {
          double found = values[2 * p + 1];
          for(int k = 0; k < Interpolation::known; ++k)
            found -= interpolation.weight[p][k] * values[2 * k];
          largest = std::max(largest, std::abs(found));
        }
        return largest;
      }

      void search(double from, double to, double error)
      {
        // What is found to vary after all widens the range.
        range = std::max(range, error);
        if(error <= std::max(resolved * range, noise))
          return;
        int halvings = 0;
        bool falls = false;
        while(to - from > least_width && error > noise)
        {
          const double middle = from + 0.5 * (to - from);
          if(!(middle > from && middle < to))
            break;
          const double below = disagreement(from, middle);
          const double above = disagreement(middle, to);
          const double least = error / smooth_fall;
          ++halvings;
          if(std::max(below, above) <= least)
          {
            // Both halves are smooth, but they may meet at an angle.
            const double width = middle - from;
            const double across
                = disagreement(middle - 0.3 * width, middle + 0.4 * width);
            falls = across <= least;
            if(falls)
            {
              --halvings;
              break;
            }
            from = middle - 0.3 * width;
            to = middle + 0.4 * width;
            error = across;
            continue;
          }
          if(below > above)
          {
            search(middle, to, above);
            to = middle;
          }
          else
          {
            search(from, middle, below);
            from = middle;
          }
          error = std::max(below, above);
        }
        // Between neighbouring candidates a piece may be as short as round-off at once.
        const bool sharp
            = !falls && (halvings >= halvings_of_breaks || to - from <= least_width);
        const bool brief = halvings > 0 && !sharp && error > visible * range;
        was_brief |= brief;
        if(sharp)
          breaks.push_back({from, to});
        if(brief)
          for(const double edge : {from, to})
            breaks.push_back({edge, edge});
        if(breaks.size() > 10 * most_breakpoints)
          throw InputError("jumps or bends more often than can be followed");
      }

      const std::function<double(double)> &function;
      double least_width; ///< s, of round-off
      double range = 0, noise = 0;
      long evaluations = 0;
      bool was_brief = false;
    };

    /** Breaks found more than once become one, a candidate's where one lies within. */
    std::vector<double> merged(std::vector<Break> breaks,
                               const std::vector<double> &candidates, double start,
                               double end)
    {
      const double margin = 8 * std::numeric_limits<double>::epsilon()
                            * std::max(std::abs(start), std::abs(end));
      std::ranges::sort(breaks, {}, &Break::lower);
      std::vector<double> times;
      for(std::size_t i = 0; i < breaks.size();)
      {
        Break whole = breaks[i];
        for(++i; i < breaks.size() && breaks[i].lower <= whole.upper + margin; ++i)
          whole.upper = std::max(whole.upper, breaks[i].upper);
        const auto named = std::ranges::lower_bound(candidates, whole.lower - margin);
        const double time = named != candidates.end() && *named <= whole.upper + margin
                                ? *named
                                : 0.5 * (whole.lower + whole.upper);
        if(time > start + margin && time < end - margin
           && (times.empty() || time > times.back()))
          times.push_back(time);
      }
      return times;
    }

    void combine(const std::vector<double> &some, const std::vector<double> &others,
                 std::vector<double> &result)
    {
      for(const double a : some)
        for(const double b : others)
          for(const double value : {a + b, a - b, b - a, a * b, a / b, b / a})
            result.push_back(value);
    }

    /** Without those that round-off of the expression's numbers keeps from one of them.
     */
    void erase_close_to(const std::vector<double> &numbers, double start, double end,
                        std::vector<double> &times)
    {
      double largest = std::max(std::abs(start), std::abs(end));
      for(const double number : numbers)
        largest = std::max(largest, std::abs(number));
      const double margin = 16 * std::numeric_limits<double>::epsilon() * largest;
      std::erase_if(times,
                    [&](double time)
                    {
                      const auto next = std::ranges::lower_bound(numbers, time - margin);
                      return next != numbers.end() && *next <= time + margin;
                    });
    }

    void sort_times(std::vector<double> &times, double start, double end)
    {
      std::erase_if(times, [=](double time) { return !(time > start && time < end); });
      std::ranges::sort(times);
      const auto repeated = std::ranges::unique(
          times, [](double a, double b)
          { return b - a <= 4 * std::numeric_limits<double>::epsilon() * std::abs(b); });
      times.erase(repeated.begin(), repeated.end());
    }
  } // namespace

  std::vector<double> named_times(const std::string &expression, double start, double end)
  {
    std::vector<double> numbers = numbers_in(expression);
    std::ranges::sort(numbers);
    const auto repeated = std::ranges::unique(numbers);
    numbers.erase(repeated.begin(), repeated.end());
    std::vector<double> times;
    for(const double number : numbers)
      times.push_back(-number);
    if(numbers.size() <= most_numbers)
    {
      std::vector<double> pairs;
      combine(numbers, numbers, pairs);
      if(numbers.size() <= most_numbers_in_threes)
        combine(pairs, numbers, times);
      times.insert(times.end(), pairs.begin(), pairs.end());
    }
    erase_close_to(numbers, start, end, times);
    times.insert(times.end(), numbers.begin(), numbers.end());
    sort_times(times, start, end);
    return times;
  }

  std::vector<double> find_breakpoints(const std::function<double(double)> &function,
                                       const std::vector<double> &candidates,
                                       double start, double end)
  {
    constexpr double most_brief = 0.25;
    Search search(function, start, end);
    for(int cuts = coarsest_cuts;; cuts *= refinement)
    {
      std::vector<double> times = candidates;
      for(int i = 1; i < cuts; ++i)
        times.push_back(start + (end - start) * i / cuts);
      sort_times(times, start, end);
      times.insert(times.begin(), start);
      times.push_back(end);
      if(search.run(times) <= most_brief)
        break;
      if(cuts == finest_cuts)
        throw InputError(fmt::format(
            "varies faster than {} samples between the start and the end of the run tell",
            Interpolation::points * cuts));
    }
    std::vector<double> result = merged(std::move(search.breaks), candidates, start, end);
    if(result.size() > most_breakpoints)
      throw InputError("jumps or bends more often than can be followed");
    return result;
  }

  void add_breakpoints(Field &field, const std::vector<Position> &positions, double start,
                       double end)
  {
    if(field.constant || !may_depend_on(field.expression, "t"))
      return;
    if(is_table(field.expression))
    {
      const double first = field.breakpoints.front(), last = field.breakpoints.back();
      const double margin = 1e-9 * (end - start);
      if(first > start + margin || last < end - margin)
        throw InputError(fmt::format("is known from t = {:.6g} to {:.6g}, and the run "
                                     "goes from {:.6g} to {:.6g}",
                                     first, last, start, end));
      return sort_times(field.breakpoints, start, end);
    }
    const std::vector<double> candidates = named_times(field.expression, start, end);
    const bool everywhere_alike = !may_depend_on(field.expression, "xyz");
    for(const Position &position : positions)
    {
      const std::vector<double> found = find_breakpoints(
          [&](double time) { return field(position, time); }, candidates, start, end);
      field.breakpoints.insert(field.breakpoints.end(), found.begin(), found.end());
      if(everywhere_alike)
        break;
    }
    sort_times(field.breakpoints, start, end);
  }
} // namespace meltfront::cases
