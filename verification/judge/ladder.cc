#include <verification/judge/ladder.h>
#include <verification/judge/refinement.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace meltfront::verification
{
  double steps_of(const RunRecord &run)
  {
    return static_cast<double>(std::max(run.cost.steps, 1L));
  }

  namespace
  {
    constexpr double equal_spacing = 1e-9;
    constexpr double least_ratio_of_steps = 1.5; ///< of a run at half the step

    double abscissa(const RunRecord &run, bool in_time)
    {
      return in_time ? run.description.time_step : run.description.spacing;
    }

    /** The same but for the number of steps, of which the other took more. */
    bool halves_step(const RunRecord &whole, const RunRecord &half)
    {
      if(whole.n != half.n || whole.method != half.method || whole.seed != half.seed
         || whole.case_name != half.case_name
         || whole.description.dimension != half.description.dimension
         || steps_of(half) < least_ratio_of_steps * steps_of(whole))
        return false;
      const auto without_steps = [](auto options)
      {
        for(const char *key : {"steps", "fewest_steps"})
          options.erase(key);
        return options;
      };
      return without_steps(whole.options) == without_steps(half.options);
    }

    /** Ladders of one run that is the check of another's step go to that one. */
    void attach_half_steps(std::vector<Ladder> &ladders)
    {
      for(Ladder &single : ladders)
      {
        if(single.levels.size() != 1)
          continue;
        for(Ladder &ladder : ladders)
          if(ladder.levels.size() > 1 && !ladder.in_time)
            for(const RunRecord *level : ladder.levels)
              if(!single.levels.empty() && halves_step(*level, *single.levels.front()))
              {
                ladder.whole_step = level;
                ladder.half_step = single.levels.front();
                single.levels.clear();
              }
      }
    }
  } // namespace

  std::vector<Ladder> ladders_of(const MatrixResult &result)
  {
    std::vector<Ladder> ladders;
    std::map<std::tuple<std::string, std::string, std::uint64_t>, std::size_t> known;
    std::map<std::size_t, int> largest_ended_badly;
    for(const RunRecord &run : result.runs)
    {
      const auto [place, fresh] = known.try_emplace(
          std::tuple(run.case_name, run.label, run.seed), ladders.size());
      if(fresh)
        ladders.push_back({run.case_name, run.label, run.method, run.seed, {}});
      if(run.status == RunStatus::finished)
        ladders[place->second].levels.push_back(&run);
      else
        largest_ended_badly[place->second]
            = std::max(largest_ended_badly[place->second], run.n);
    }
    for(std::size_t i = 0; i < ladders.size(); ++i)
    {
      Ladder &ladder = ladders[i];
      ladder.in_time = Refinement(ladder.levels).in_time();
      std::ranges::stable_sort(ladder.levels, std::ranges::greater(),
                               [&](const RunRecord *run)
                               { return abscissa(*run, ladder.in_time); });
      const auto same = [&](const RunRecord *one, const RunRecord *other)
      {
        return abscissa(*one, ladder.in_time) - abscissa(*other, ladder.in_time)
               <= equal_spacing * abscissa(*one, ladder.in_time);
      };
      ladder.levels.erase(std::unique(ladder.levels.begin(), ladder.levels.end(), same),
                          ladder.levels.end());
      ladder.finest_failed
          = !ladder.levels.empty() && largest_ended_badly[i] > ladder.levels.back()->n;
    }
    attach_half_steps(ladders);
    std::erase_if(ladders, [](const Ladder &ladder) { return ladder.levels.empty(); });
    return ladders;
  }

  bool hides_time_error(const Ladder &ladder)
  {
    if(ladder.levels.size() < 2 || ladder.in_time)
      return false;
    const RunRecord &finest = *ladder.levels.back();
    const RunRecord &second = *ladder.levels[ladder.levels.size() - 2];
    const BarConstants constants = bar_constants(finest);
    const double in_time
        = constants.order_in_time * std::log(steps_of(finest) / steps_of(second))
          / std::log(second.description.spacing / finest.description.spacing);
    // Steps are whole numbers: a ratio a little short of that of h is joint, too.
    constexpr double whole_steps = 0.9;
    return in_time < whole_steps * constants.front.order;
  }
} // namespace meltfront::verification
