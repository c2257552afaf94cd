#include <verification/matrix/time_estimate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    /** Of n, where only one run is known: n cells and n steps. */
    constexpr double usual_exponent = 2;
    constexpr double largest_exponent = 6;

    double distance(int a, int b)
    {
      return std::abs(std::log(static_cast<double>(a) / b));
    }

    double scaled(double seconds, int from, int to, double exponent)
    {
      return seconds * std::pow(static_cast<double>(to) / from, exponent);
    }

    double from_series(const std::map<int, double> &times, int n)
    {
      std::vector<std::pair<int, double>> nearest(times.begin(), times.end());
      std::ranges::sort(nearest, {},
                        [n](const auto &entry) { return distance(entry.first, n); });
      const auto [n_first, first] = nearest[0];
      if(nearest.size() == 1)
        return scaled(first, n_first, n, usual_exponent);
      const auto [n_second, second] = nearest[1];
      const double exponent
          = std::log(second / first) / std::log(static_cast<double>(n_second) / n_first);
      return scaled(first, n_first, n, std::clamp(exponent, 0., largest_exponent));
    }
  } // namespace

  void TimeEstimate::add(const RunKind &run, double seconds)
  {
    constexpr double shortest = 1e-3; // a time of zero has no logarithm
    const double time = std::max(seconds, shortest);
    series[{run.case_name, run.label}][run.n] = time;
    if(const auto found = expected.find({run.case_name, run.label});
       found != expected.end() && found->second.contains(run.n))
    {
      expected_of_ended += found->second.at(run.n);
      taken_by_these += time;
    }
    for(Mean *mean : {&methods[run.method], &all})
    {
      mean->sum += scaled(time, run.n, 1, usual_exponent);
      ++mean->count;
    }
  }

  void TimeEstimate::expect(const RunKind &run, double seconds)
  {
    expected[{run.case_name, run.label}][run.n] = seconds;
  }

  double TimeEstimate::seconds(const RunKind &run) const
  {
    if(const auto found = expected.find({run.case_name, run.label});
       found != expected.end() && found->second.contains(run.n))
      return found->second.at(run.n)
             * (expected_of_ended > 0 ? taken_by_these / expected_of_ended : 1);
    if(const auto found = series.find({run.case_name, run.label}); found != series.end())
      return from_series(found->second, run.n);
    const auto method = methods.find(run.method);
    const Mean &mean = method != methods.end() ? method->second : all;
    if(mean.count == 0)
      return std::numeric_limits<double>::quiet_NaN();
    return scaled(mean.sum / mean.count, 1, run.n, usual_exponent);
  }
} // namespace meltfront::verification
