#include <reference_fem/fitted/events/data_steps.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    /** Rays at whose ends the walls are looked at. */
    constexpr unsigned int rays_looked_at = 8;

    /** A step ends so far before a breakpoint, of the breakpoint or of the run. */
    constexpr double before_break = 1e-13;

    /** What quadrature over a step may miss, of the integral over all steps. */
    constexpr double missed = 1e-6;

    /** Parts of a step in which a feature is looked for: so many in all steps, but no
     * fewer and no more in each than that. */
    constexpr long parts_in_all = 8192, fewest_parts = 8, most_parts = 64;

    /** The first step after a jump, of the one that was planned: a power of two, at
     * most. */
    constexpr int doublings_after_jump = 8;

    /** Of the largest value: a larger difference across a breakpoint is a jump. */
    constexpr double jump = 1e-3;

    /** A step is halved no more often than that: what is left is rounding. */
    constexpr int deepest = 40;

    /** A range that ends this close behind a breakpoint ends at it, of a step. */
    constexpr double close_behind = 1e-3;

    class DataSteps
    {
    public:
      DataSteps(const std::vector<StepRange> &planned, double begin, const Clock &clock,
                const TimeData &data, bool controlled)
        : planned(planned)
        , begin(begin)
        , clock(clock)
        , data(data)
        , controlled(controlled)
      {
      }

      std::vector<StepRange> fitted()
      {
        std::vector<StepRange> ranges = cut_at_breakpoints();
        if(data.values.empty())
          return ranges;
        totals.assign(data.values.size(), 0);
        long steps = 0;
        for_each_step(ranges, [&](double, double, std::size_t) { ++steps; });
        parts = std::clamp(parts_in_all / steps, fewest_parts, most_parts);
        for_each_step(ranges, [&](double from, double to, std::size_t)
                      { add_to_totals(from, to); });
        std::vector<bool> whole(ranges.size(), !controlled);
        for_each_step(ranges, [&](double from, double to, std::size_t range)
                      { whole[range] = whole[range] && sees(from, to); });
        std::vector<StepRange> result;
        for_each_step(ranges,
                      [&](double from, double to, std::size_t range)
                      {
                        if(!whole[range])
                          divide(from, to, 0, result);
                        else if(to == ranges[range].end)
                          result.push_back(ranges[range]);
                      });
        return result;
      }

    private:
      template <typename Visit>
      void for_each_step(const std::vector<StepRange> &ranges, const Visit &visit) const
      {
        double from = begin;
        for(std::size_t i = 0; i < ranges.size(); ++i)
        {
          const double start = from;
          const StepRange &range = ranges[i];
          const long n = std::max(
              1L, static_cast<long>(std::ceil((range.end - start) / range.step - 1e-6)));
          for(long k = 1; k <= n; ++k)
          {
            const double to
                = k == n ? range.end
                         : start + (range.end - start) * static_cast<double>(k) / n;
            visit(from, to, i);
            from = to;
          }
        }
      }

      /** Clocks right before the breakpoints within the steps. */
      std::vector<double> planned_ends() const
      {
        const double first = clock.time(begin), last = clock.time(planned.back().end);
        std::vector<double> result;
        for(const double point : data.breakpoints)
        {
          const double shift = before_break * std::max(std::abs(point), last - first);
          if(point - shift <= first + shift || point > last)
            continue;
          // A bend at the end bends nothing.
          if(point + shift >= last && !jumps(point, shift))
            continue;
          result.push_back(clock.clock(point - shift));
        }
        return result;
      }

      bool jumps(double point, double shift) const
      {
        return std::ranges::any_of(
            data.values,
            [&](const auto &value)
            {
              const double before = value(point - 2 * shift);
              const double after = value(point + 2 * shift);
              return std::abs(after - before)
                     > jump * std::max(std::abs(after), std::abs(before));
            });
      }

      std::vector<StepRange> cut_at_breakpoints() const
      {
        const std::vector<double> cuts = planned_ends();
        std::vector<StepRange> result;
        double from = begin;
        auto cut = cuts.begin();
        bool after_jump = false;
        const auto add = [&](double end, double step)
        {
          if(after_jump)
          {
            const double least
                = clock.clock(clock.time(from) + data.shortest_after_jump) - from;
            double size = std::min(step, end - from);
            int doublings = 0;
            for(; doublings < doublings_after_jump && size / 2 >= least; ++doublings)
              size /= 2;
            for(; doublings > 0; --doublings, size *= 2)
              result.push_back({from += size, size});
          }
          if(end > from)
            result.push_back({end, step});
          from = end;
          after_jump = false;
        };
        for(std::size_t i = 0; i < planned.size(); ++i)
        {
          const StepRange &range = planned[i];
          for(; cut != cuts.end() && *cut < range.end; ++cut)
          {
            add(*cut, range.step);
            const double time = clock.time(*cut);
            after_jump = jumps(
                time, 2 * before_break
                          * std::max(std::abs(time),
                                     clock.time(planned.back().end) - clock.time(begin)));
          }
          if(i + 1 == planned.size() || range.end - from > close_behind * range.step)
            add(range.end, range.step);
        }
        return result;
      }

      /** Radau's quadrature with three stages of a value of the data, or of its size. */
      double integral(const std::function<double(double)> &value, double from, double to,
                      bool of_size) const
      {
        const double root = std::sqrt(6.);
        const std::array<double, 3> nodes{(4 - root) / 10, (4 + root) / 10, 1},
            weights{(16 - root) / 36, (16 + root) / 36, 1. / 9};
        double sum = 0;
        for(int j = 0; j < 3; ++j)
        {
          const double at = from + nodes[j] * (to - from);
          const double there = clock.rate(at) * value(clock.time(at));
          sum += weights[j] * (of_size ? std::abs(there) : there);
        }
        return sum * (to - from);
      }

      double in_parts(const std::function<double(double)> &value, double from, double to,
                      bool of_size) const
      {
        double sum = 0;
        for(long k = 0; k < parts; ++k)
          sum += integral(value, from + (to - from) * k / parts,
                          from + (to - from) * (k + 1) / parts, of_size);
        return sum;
      }

      void add_to_totals(double from, double to)
      {
        for(std::size_t i = 0; i < totals.size(); ++i)
          totals[i] += in_parts(data.values[i], from, to, true);
      }

      bool sees(double from, double to) const
      {
        for(std::size_t i = 0; i < totals.size(); ++i)
          if(!(std::abs(integral(data.values[i], from, to, false)
                        - in_parts(data.values[i], from, to, false))
               <= missed * totals[i]))
            return false;
        return true;
      }

      void divide(double from, double to, int depth, std::vector<StepRange> &result) const
      {
        const double middle = 0.5 * (from + to);
        if(depth == deepest || !(middle > from && middle < to) || sees(from, to))
        {
          result.push_back({to, to - from});
          return;
        }
        divide(from, middle, depth + 1, result);
        divide(middle, to, depth + 1, result);
      }

      const std::vector<StepRange> &planned;
      double begin;
      const Clock &clock;
      const TimeData &data;
      bool controlled;
      std::vector<double> totals;
      long parts = fewest_parts;
    };

    /** Of the phase at a wall: see TimeData::shortest_after_jump. */
    double resolved_at(const FittedProblem &problem, bool inner,
                       const dealii::Vector<double> &u)
    {
      const RayMesh &mesh = problem.mesh();
      const unsigned int degree = mesh.surface.degree, last = mesh.n_levels() - 1;
      const double spacing
          = (inner ? problem.coordinate(0, degree, u) - problem.coordinate(0, 0, u)
                   : problem.coordinate(0, last, u)
                         - problem.coordinate(0, last - degree, u))
            / degree;
      const Layer &layer = inner ? mesh.layers.front() : mesh.layers.back();
      const Phase &phase = problem.phase(layer.interval);
      return spacing * spacing / 3 * phase.capacity / phase.conductivity;
    }

    /** Heat released throughout, at some places along some of the rays. */
    void add_volumetric_source(const FittedProblem &problem, TimeData &data)
    {
      const cases::Field &field = problem.physics().volumetric_source;
      if(!field.value || field.constant)
        return;
      data.breakpoints.insert(data.breakpoints.end(), field.breakpoints.begin(),
                              field.breakpoints.end());
      constexpr int places = 3;
      const RayMesh &mesh = problem.mesh();
      const unsigned int n = mesh.surface.n_rays(),
                         looked_at = std::min(n, rays_looked_at);
      for(unsigned int k = 0; k < looked_at; ++k)
        for(int i = 0; i < places; ++i)
        {
          const double share = (i + 0.5) / places;
          data.values.push_back(
              [&field, place = mesh.position(
                           k * n / looked_at,
                           mesh.inner + share * (mesh.outer - mesh.inner))](double time)
              { return field(place, time); });
        }
    }
  } // namespace

  TimeData data_of(const FittedProblem &problem, const dealii::Vector<double> &u)
  {
    const RayMesh &mesh = problem.mesh();
    const Physics &physics = problem.physics();
    TimeData data;
    for(const bool inner : {true, false})
    {
      if(inner && mesh.has_centre())
        continue;
      const cases::Boundary &wall = inner ? physics.inner_wall : physics.outer_wall;
      if(wall.kind == cases::BoundaryKind::insulated || wall.value.constant)
        continue;
      data.breakpoints.insert(data.breakpoints.end(), wall.value.breakpoints.begin(),
                              wall.value.breakpoints.end());
      if(!wall.value.breakpoints.empty())
        data.shortest_after_jump
            = std::max(data.shortest_after_jump, resolved_at(problem, inner, u));
      if(wall.exact)
        continue;
      const double reference = wall.kind == cases::BoundaryKind::fixed_temperature
                                   ? physics.melting_temperature
                                   : 0;
      const unsigned int n = mesh.surface.n_rays(),
                         looked_at = std::min(n, rays_looked_at);
      for(unsigned int k = 0; k < looked_at; ++k)
        data.values.push_back(
            [&wall, reference,
             place = mesh.position(k * n / looked_at, inner ? mesh.inner : mesh.outer)](
                double time) { return wall.value(place, time) - reference; });
    }
    if(physics.power)
      data.values.push_back(physics.power);
    add_volumetric_source(problem, data);
    std::ranges::sort(data.breakpoints);
    return data;
  }

  std::vector<StepRange> fit_to_data(const std::vector<StepRange> &planned, double begin,
                                     const Clock &clock, const TimeData &data,
                                     bool controlled)
  {
    return data.values.empty() && data.breakpoints.empty()
               ? planned
               : DataSteps(planned, begin, clock, data, controlled).fitted();
  }
} // namespace meltfront::reference_fem::fitted
