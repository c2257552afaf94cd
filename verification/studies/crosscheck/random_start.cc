#include <verification/studies/crosscheck/scene_maker.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace meltfront::verification
{
  void SceneMaker::choose_start()
  {
    const auto [from, to] = std::pair(first, last);
    const double sign = random.chance(0.5) ? 1 : -1;
    start_sign = sign;
    int kind = random.weighted({0.33, 0.15, 0.06, 0.22, 0.08, 0.1, 0.04, 0.02});
    if(problem == Problem::alloy)
    {
      start_sign = 1;
      kind = std::array{0, 0, 6}[random.below(3)];
    }
    if(problem == Problem::heat)
      kind = random.chance(0.5) ? 0 : 6;
    const auto set = [this](const std::string &expression,
                            const std::vector<std::string> &simpler = {})
    { draft.set(initial, "temperature", expression, simpler); };
    const double melting = substance.melting_temperature;
    const std::string one_phase = words(warmer(start_sign * random.uniform(0.05, 1)));
    switch(kind)
    {
    case 0:
      set(one_phase, {words(melting)});
      break;
    case 1:
    case 2:
      set(words(melting));
      draft.set(initial, "solid fraction at melting",
                kind == 1 ? (sign < 0 ? "1" : "0") : words(random.uniform(0.1, 0.9)));
      if(kind == 2)
        start_sign = 0;
      break;
    case 3:
    case 4:
    case 7:
      choose_start_with_front(kind, sign, from, to);
      start_sign = 0;
      break;
    default:
    {
      // A wave within a phase, or across the melting point.
      const double level = kind == 5 ? 0.55 : random.uniform(-0.3, 0.3);
      const double height = random.uniform(0.1, kind == 5 ? 0.5 : 1);
      set(fmt::format("{} + {}*cos({}*{})", words(warmer(start_sign * level)),
                      words(height * substance.temperature_scale),
                      words(3.14159265 / (to - from) * (1 + random.below(3))),
                      coordinate),
          {one_phase});
      if(kind == 6)
        start_sign = 0;
    }
    }
  }

  void SceneMaker::let_bodies_touch()
  {
    const std::string front = draft.value(initial, "front");
    if(start_sign == 0 && front.empty() && problem == Problem::pure)
      return;
    if(!random.chance(front.empty() ? 0.15 : 0.3))
      return;
    const std::string before = draft.value(initial, "temperature");
    std::string level = front;
    double lower = -random.uniform(0.05, 1), upper = random.uniform(0.05, 1);
    if(front.empty())
    {
      level = fmt::format("{} - {}", coordinate,
                          words(first + (last - first) * random.uniform(0.15, 0.85)));
      lower = problem == Problem::pure ? start_sign * random.uniform(0.05, 1) : lower;
      upper = problem == Problem::pure ? start_sign * random.uniform(0.05, 1) : upper;
    }
    draft.set(initial, "temperature",
              fmt::format("if({} < 0, {}, {})", level, words(warmer(lower)),
                          words(warmer(upper))),
              {before});
  }

  void SceneMaker::choose_start_with_front(int kind, double sign, double from, double to)
  {
    std::string level = coordinate;
    double front = rounded(from + (to - from) * random.uniform(0.15, 0.85));
    if(dimension == 2 && shape != "shell" && random.chance(0.5))
    {
      // A disk off the middle.
      const double shift = shape == "box" ? 0.5 : 0;
      const double y = shape == "box" ? upper[1] : to;
      level = fmt::format("sqrt((x - {})^2 + (y - {})^2)",
                          words(to * (shift + random.uniform(-0.1, 0.1))),
                          words(y * (shift + random.uniform(-0.1, 0.1))));
      front = rounded(std::min(y, to) * random.uniform(0.15, 0.3));
    }
    // Per length, on the near side of the front and on the far one.
    const double slope = substance.temperature_scale / (to - from);
    double near = -sign * slope * random.uniform(0.1, 1.5);
    double far = -sign * slope * random.uniform(0.1, 1.5);
    if(random.chance(0.3))
      (random.chance(0.5) ? near : far) = 0;
    const bool given = kind != 3 || near == 0 || far == 0;
    if(kind == 7)
      (sign > 0 ? near : far) = 0.3 * sign * slope; // the liquid is undercooled
    const std::string beyond = fmt::format("{} - {}", level, words(front));
    draft.set(initial, "temperature",
              fmt::format("{} + ({})*min({}, 0) + ({})*max({}, 0)",
                          words(substance.melting_temperature), words(near), beyond,
                          words(far), beyond),
              {words(substance.melting_temperature)});
    // Where one phase is at the melting point throughout, only this tells the phases.
    if(given)
      draft.set(initial, "front",
                sign < 0 ? beyond : fmt::format("{} - {}", words(front), level));
  }
} // namespace meltfront::verification
