#include <verification/studies/crosscheck/contradiction.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    /** Temperatures nearer to each other than this share of their size are equal. */
    constexpr double round_off = 1e-9;

    bool agree(const Estimate &one, const Estimate &other)
    {
      return std::abs(one.value - other.value) <= one.bar + other.bar;
    }

    double excess_over(const Estimate &one, const Estimate &other)
    {
      return std::abs(one.value - other.value) / (one.bar + other.bar);
    }

    /** The finished levels of each method, coarse to fine. */
    std::map<std::string, std::vector<const LevelRun *>>
    ladders_of(const std::vector<LevelRun> &runs)
    {
      std::map<std::string, std::vector<const LevelRun *>> ladders;
      for(const LevelRun &run : runs)
        if(run.status == RunStatus::finished)
          ladders[run.method].push_back(&run);
      for(auto &[method, ladder] : ladders)
        std::ranges::stable_sort(ladder, std::ranges::greater(), &LevelRun::spacing);
      return ladders;
    }

    std::vector<CourseLevel> levels_of(const std::vector<const LevelRun *> &ladder,
                                       const std::string &quantity)
    {
      std::vector<CourseLevel> levels;
      for(const LevelRun *run : ladder)
        if(const auto found = run->course.quantities.find(quantity);
           found != run->course.quantities.end() && std::isfinite(found->second.back()))
        {
          // Of two levels of one spacing the later one counts.
          if(!levels.empty() && levels.back().spacing == run->spacing)
            levels.pop_back();
          levels.push_back({run->spacing, found->second});
          if(const auto misread = run->course.misreadings.find(quantity);
             misread != run->course.misreadings.end())
            levels.back().misreadings = misread->second;
        }
      return levels;
    }

    double temperature_span(const std::vector<LevelRun> &runs)
    {
      double lowest = INFINITY, highest = -INFINITY;
      for(const LevelRun &run : runs)
        if(run.status == RunStatus::finished)
        {
          lowest = std::min(lowest, run.course.lowest);
          highest = std::max(highest, run.course.highest);
        }
      return std::max(highest - lowest,
                      round_off * std::max(std::abs(lowest), std::abs(highest)));
    }

    double scale_of(const std::string &quantity, double span,
                    const cases::Material &material)
    {
      if(quantity.starts_with("temperature"))
        return span > 0 ? span : 1;
      if(quantity != "heat")
        return 1;
      const double capacity = std::max(material.solid.specific_heat_capacity,
                                       material.liquid.specific_heat_capacity);
      return material.solid.density * (capacity * span + material.latent_heat);
    }

    /** What a mean at the melting temperature hides (K): the temperature that latent heat
     * is worth by which the solid fraction at that place may be off. */
    double hidden_by_melting(const std::vector<const LevelRun *> &ladder,
                             const std::string &quantity, std::size_t time,
                             const Estimate &mean, const cases::Material &material)
    {
      const std::string temperature = "temperature";
      if(!quantity.starts_with(temperature)
         || std::abs(mean.value - material.melting_temperature) > mean.bar)
        return 0;
      const std::vector<CourseLevel> levels
          = levels_of(ladder, "solid fraction" + quantity.substr(temperature.size()));
      if(levels.size() < 2 || !std::isfinite(levels.back().values[time]))
        return 0;
      return estimate_at(levels, time, 1).bar * material.latent_heat
             / std::min(material.solid.specific_heat_capacity,
                        material.liquid.specific_heat_capacity);
    }
  } // namespace

  std::vector<std::size_t> contradicting(const std::vector<Statement> &statements)
  {
    const std::size_t count = statements.size();
    const auto bar = [&](std::size_t i) { return statements[i].estimate.bar; };
    const auto agreeing = [&](std::size_t i)
    {
      std::vector<std::size_t> others;
      for(std::size_t j = 0; j < count; ++j)
        if(agree(statements[i].estimate, statements[j].estimate))
          others.push_back(j);
      return others;
    };
    std::vector<std::size_t> support(count);
    for(std::size_t i = 0; i < count; ++i)
      support[i] = agreeing(i).size();
    std::size_t leader = 0;
    for(std::size_t i = 1; i < count; ++i)
      if(support[i] > support[leader]
         || (support[i] == support[leader] && bar(i) < bar(leader)))
        leader = i;
    std::vector<std::size_t> result;
    bool divided = false;
    for(std::size_t i = 0; i < count; ++i)
      divided = divided
                || (support[i] == support[leader]
                    && !agree(statements[i].estimate, statements[leader].estimate));
    if(divided)
    {
      for(std::size_t i = 0; i < count; ++i)
        if(support[i] < count)
          result.push_back(i);
      return result;
    }
    std::size_t consensus = leader;
    for(const std::size_t i : agreeing(leader))
      if(bar(i) < bar(consensus))
        consensus = i;
    for(std::size_t i = 0; i < count; ++i)
      if(!agree(statements[i].estimate, statements[consensus].estimate))
        result.push_back(i);
    return result;
  }

  std::vector<Comparison> comparisons(const std::vector<LevelRun> &runs,
                                      const cases::Material &material)
  {
    const auto ladders = ladders_of(runs);
    std::set<std::string> quantities;
    for(const auto &[method, ladder] : ladders)
      for(const auto &[name, values] : ladder.front()->course.quantities)
        quantities.insert(name);
    const double span = temperature_span(runs);
    std::vector<Comparison> result;
    for(const std::string &quantity : quantities)
      for(int quarter = 1; quarter <= 4; ++quarter)
      {
        Comparison comparison{quantity, quarter / 4., scale_of(quantity, span, material)};
        const std::size_t time = quarter * course_intervals / 4;
        for(const auto &[method, ladder] : ladders)
          if(const std::vector<CourseLevel> levels = levels_of(ladder, quantity);
             levels.size() > 1 && std::isfinite(levels.back().values[time]))
          {
            Estimate estimate = estimate_at(levels, time, comparison.scale);
            estimate.bar += hidden_by_melting(ladder, quantity, time, estimate, material);
            comparison.statements.push_back({method, estimate});
          }
        if(comparison.statements.size() > 1)
          result.push_back(std::move(comparison));
      }
    return result;
  }

  std::optional<Contradiction>
  worst_contradiction(const std::vector<Comparison> &comparisons)
  {
    std::optional<Contradiction> worst;
    for(const Comparison &comparison : comparisons)
    {
      Contradiction found{comparison, {}};
      for(const std::size_t i : contradicting(found.statements))
      {
        found.suspects.push_back(found.statements[i].method);
        for(const Statement &other : found.statements)
          found.excess = std::max(
              found.excess, excess_over(found.statements[i].estimate, other.estimate));
      }
      if(!found.suspects.empty() && (!worst || found.excess > worst->excess))
        worst = found;
    }
    return worst;
  }

  double largest_excess(const std::vector<Comparison> &comparisons)
  {
    double largest = 0;
    for(const Comparison &comparison : comparisons)
      for(const Statement &one : comparison.statements)
        for(const Statement &other : comparison.statements)
          largest = std::max(largest, excess_over(one.estimate, other.estimate));
    return largest;
  }

  std::map<std::string, double> relative_bars(const std::vector<Comparison> &comparisons)
  {
    std::map<std::string, std::vector<double>> bars;
    for(const Comparison &comparison : comparisons)
      for(const Statement &statement : comparison.statements)
        bars[statement.method].push_back(statement.estimate.bar / comparison.scale);
    std::map<std::string, double> medians;
    for(auto &[method, list] : bars)
    {
      std::ranges::sort(list);
      medians[method] = list[list.size() / 2];
    }
    return medians;
  }
} // namespace meltfront::verification
