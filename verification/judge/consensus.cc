#include <verification/judge/consensus.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::verification
{
  namespace
  {
    bool takes_part(const AnswerInterval &answer)
    {
      return answer.converging && std::isfinite(answer.value)
             && std::isfinite(answer.bar);
    }

    bool agree(const AnswerInterval &one, const AnswerInterval &other)
    {
      return std::abs(one.value - other.value) <= one.bar + other.bar;
    }

    /** The middle of all that the answers cover. */
    void take_hull(const std::vector<const AnswerInterval *> &answers, Consensus &result)
    {
      double lower = std::numeric_limits<double>::infinity(), upper = -lower;
      for(const AnswerInterval *answer : answers)
      {
        lower = std::min(lower, answer->value - answer->bar);
        upper = std::max(upper, answer->value + answer->bar);
      }
      result.value = (lower + upper) / 2;
      result.bar = (upper - lower) / 2;
    }
  } // namespace

  Consensus consensus_of(std::span<const AnswerInterval> answers)
  {
    Consensus result;
    result.distance_in_bars.assign(answers.size(), cases::nan);
    std::vector<const AnswerInterval *> members;
    for(const AnswerInterval &answer : answers)
      if(takes_part(answer))
        members.push_back(&answer);
    result.taking_part = static_cast<int>(members.size());
    if(members.empty())
      return result;
    const auto support = [&](const AnswerInterval *one)
    {
      return std::ranges::count_if(members, [one](const AnswerInterval *other)
                                   { return agree(*one, *other); });
    };
    const AnswerInterval *leader = *std::ranges::max_element(
        members,
        [&](const AnswerInterval *one, const AnswerInterval *other)
        {
          const auto a = support(one), b = support(other);
          return a != b ? a < b : one->bar > other->bar;
        });
    result.support = static_cast<int>(support(leader));
    const bool contradicted = std::ranges::any_of(
        members, [&](const AnswerInterval *other)
        { return support(other) == result.support && !agree(*leader, *other); });
    result.agreed = result.support > 1 && !contradicted;
    if(result.agreed)
    {
      const AnswerInterval *best = leader;
      for(const AnswerInterval *other : members)
        if(agree(*leader, *other) && other->bar < best->bar)
          best = other;
      result.value = best->value;
      result.bar = best->bar;
    }
    else
      take_hull(members, result);
    for(std::size_t i = 0; i < answers.size(); ++i)
      if(takes_part(answers[i]))
      {
        const double away = std::abs(answers[i].value - result.value);
        result.distance_in_bars[i] = away > 0 ? away / (answers[i].bar + result.bar) : 0;
      }
    if(result.agreed)
      result.support = static_cast<int>(std::ranges::count_if(
          result.distance_in_bars, [](double bars) { return bars <= 1; }));
    return result;
  }
} // namespace meltfront::verification
