#include <verification/studies/crosscheck/random_course.h>
#include <verification/studies/crosscheck/random_substance.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace meltfront::verification
{
  Course random_course(RandomStream &random, double from, double to, double duration,
                       double varied)
  {
    const std::string a = words(from), b = words(to);
    const std::string step = words(to - from);
    const double begin = duration * random.uniform(0.05, 0.6);
    const double end = begin + duration * random.log_uniform(0.02, 0.4);
    if(!random.chance(varied))
      return {a, {}};
    Course course{{}, {b, a}};
    // People write round numbers.
    const int digits = random.chance(0.5) ? 2 : 4;
    const std::string first = words(begin, digits), last = words(end, digits);
    switch(random.weighted({0.3, 0.15, 0.2, 0.15, 0.2}))
    {
    case 0:
      course.expression = fmt::format("{} + ({})*t", a, words((to - from) / duration));
      break;
    case 1:
      course.expression = fmt::format("{} + ({})*min(t/{}, 1)", a, step, first);
      break;
    case 2:
      course.expression
          = fmt::format("if(t > {}, if(t < {}, {}, {}), {})", first, last, b, a, a);
      break;
    case 3:
      course.expression = fmt::format(
          "{} + ({})*sin({}*t)", a, step,
          words(2 * std::numbers::pi * random.log_uniform(0.3, 5) / duration));
      break;
    default:
      course.expression = fmt::format("if(t < {}, {}, {})", first, a, b);
    }
    return course;
  }
} // namespace meltfront::verification
