#include <verification/judge/coverage.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace meltfront::verification
{
  namespace
  {
    struct Instances
    {
      Coverage counts;
      std::vector<double> ratios; ///< bar over true error
    };

    using Table = std::map<std::tuple<std::string, std::string, int>, Instances>;

    std::string kind_of(const std::string &quantity)
    {
      return quantity.starts_with("temperature") ? "temperature" : quantity;
    }

    void count(const QuantityBar &known, const std::string &method, double floor,
               Table &table)
    {
      if(!(known.error > 0) || !std::isfinite(known.bar.bar))
        return;
      const bool positions = known.quantity.starts_with("front");
      if(floor > 0 && !positions)
        return;
      const std::string kind = kind_of(known.quantity);
      Instances &row = table[{method, kind, known.bar.levels}];
      row.counts.method = method;
      row.counts.quantity = kind;
      row.counts.levels = known.bar.levels;
      if(!known.bar.converging)
      {
        ++row.counts.not_converging;
        return;
      }
      ++row.counts.instances;
      row.counts.covered += known.error <= known.bar.bar + floor ? 1 : 0;
      row.ratios.push_back(known.bar.bar / known.error);
    }

    double median(std::vector<double> values)
    {
      if(values.empty())
        return cases::nan;
      const auto middle = values.begin() + static_cast<long>(values.size() / 2);
      std::ranges::nth_element(values, middle);
      return *middle;
    }
  } // namespace

  std::vector<Coverage> coverage_of(const MatrixResult &result)
  {
    Table table;
    for(const Ladder &whole : ladders_of(result))
      for(std::size_t levels = 2; levels <= whole.levels.size(); ++levels)
      {
        Ladder ladder = whole;
        ladder.levels.resize(levels);
        const double floor = ladder.levels.back()->quantity("front_floor");
        for(const QuantityBar &known : bars_of(ladder))
          count(known, ladder.method, std::isfinite(floor) ? floor : 0, table);
      }
    std::vector<Coverage> coverage;
    for(auto &[key, row] : table)
    {
      row.counts.median_bar_over_error = median(std::move(row.ratios));
      coverage.push_back(row.counts);
    }
    return coverage;
  }

  std::string coverage_csv(const std::vector<Coverage> &coverage)
  {
    std::string text = "method,quantity,levels,covered,median_bar_over_error,instances,"
                       "not_converging\n";
    for(const Coverage &row : coverage)
      text += fmt::format("{},{},{},{:.4g},{:.4g},{},{}\n", row.method, row.quantity,
                          row.levels, row.share(), row.median_bar_over_error,
                          row.instances, row.not_converging);
    return text;
  }
} // namespace meltfront::verification
