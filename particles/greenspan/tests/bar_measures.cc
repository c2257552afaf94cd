#include <cases/error.h>
#include <particles/greenspan/tests/bar_measures.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Straight line by least squares. */
    class Line
    {
    public:
      void add(double x, double y)
      {
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
        syy += y * y;
      }

      int count() const
      {
        return static_cast<int>(n);
      }

      double slope() const
      {
        return (n * sxy - sx * sy) / (n * sxx - sx * sx);
      }

      double at(double x) const
      {
        return sy / n + slope() * (x - sx / n);
      }

      double r_squared() const
      {
        const double covariance = n * sxy - sx * sy;
        return covariance * covariance / ((n * sxx - sx * sx) * (n * syy - sy * sy));
      }

    private:
      double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    };

    /** Shares of the molten mass between which the three lines run; beyond 1: solid. */
    constexpr std::array<double, 2> near_bath{0.05, 0.5}, near_front{0.5, 0.9},
        behind_front{1.1, 1.6};

    std::span<const BarLook> late(std::span<const BarLook> looks, double least)
    {
      std::size_t first = looks.size();
      while(first > 0 && looks[first - 1].molten() >= least)
        --first;
      return looks.subspan(first);
    }
  } // namespace

  FrontFit fit_front(std::span<const BarLook> looks, double least, double shift)
  {
    Line line;
    for(const BarLook &look : late(looks, least))
    {
      const double molten = look.molten() + shift;
      line.add(look.time, molten * molten);
    }
    if(line.count() < 3)
      throw cases::InputError(fmt::format(
          "a line is to be fitted to {} looks at a bar with {:.4g} molten or more; three "
          "are needed: let it melt for longer",
          line.count(), least));
    return {line.slope(), line.at(0), line.r_squared(), line.count()};
  }

  BarTemperatures bar_temperatures(std::span<const BarLook> looks, double least,
                                   double hot_temperature)
  {
    // Over the share of the molten mass the profiles of all times are the same.
    Line bath, front, solid;
    double edge = 0, molten = 0;
    BarTemperatures result;
    for(const BarLook &look : late(looks, least))
    {
      ++result.looks;
      edge += look.edge;
      molten += look.molten();
      for(const BarLayer &layer : look.layers)
      {
        const double share = (layer.mass - look.edge) / look.molten();
        for(const auto &[line, range] :
            {std::pair{&bath, near_bath}, {&front, near_front}, {&solid, behind_front}})
          if(share > range[0] && share < range[1])
            line->add(share, layer.temperature);
      }
    }
    if(result.looks == 0 || std::min({bath.count(), front.count(), solid.count()}) < 2)
      throw cases::InputError(fmt::format(
          "no look at a bar has {:.4g} molten; let it melt for longer", least));
    molten /= result.looks;
    result.edge = bath.at(0);
    result.gradient = bath.slope() / molten;
    result.melt_at_front = front.at(1);
    result.solid_at_front = solid.at(1);
    result.slip = (result.edge - hot_temperature) / result.gradient;
    return result;
  }

  std::vector<BarLook> mean_looks(const std::vector<std::vector<BarLook>> &runs,
                                  std::size_t block)
  {
    if(runs.empty() || block == 0)
      throw cases::InputError("means of bars need one run and one look at least");
    std::size_t count = runs[0].size();
    for(const auto &run : runs)
      count = std::min(count, run.size());
    std::vector<BarLook> result;
    for(std::size_t first = 0; first + block <= count; first += block)
    {
      BarLook mean;
      double square = 0;
      for(std::size_t k = first; k < first + block; ++k)
      {
        mean.time += runs[0][k].time / static_cast<double>(block);
        for(const auto &run : runs)
          square += run[k].molten() * std::abs(run[k].molten());
      }
      square /= static_cast<double>(runs.size() * block);
      mean.front = std::copysign(std::sqrt(std::abs(square)), square);
      result.push_back(mean);
    }
    return result;
  }

  std::vector<std::vector<BarLook>> run_bars(const BarSettings &settings,
                                             const BarSchedule &schedule, int members,
                                             std::uint64_t first_seed, int threads)
  {
    std::vector<std::vector<BarLook>> runs(std::max(0, members));
    std::vector<std::exception_ptr> failures(runs.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads) if(threads > 1)
    for(int member = 0; member < members; ++member)
      try
      {
        BarSettings own = settings;
        own.seed = first_seed + member;
        runs[member] = run_bar(own, schedule);
      }
      catch(...)
      {
        failures[member] = std::current_exception();
      }
    for(const std::exception_ptr &failure : failures)
      if(failure)
        std::rethrow_exception(failure);
    return runs;
  }
} // namespace meltfront::particles::greenspan
