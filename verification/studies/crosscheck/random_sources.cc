#include <verification/studies/crosscheck/scene_maker.h>

#include <fmt/format.h>

#include <array>

namespace meltfront::verification
{
  void SceneMaker::choose_sources()
  {
    const bool symmetric = symmetry != "none";
    if(shape == "slab" || shape == "shell" || (symmetric && shape != "ball")
       || !random.chance(symmetric ? 0.1 : 0.15))
      return;
    const int count = symmetric ? 1 : 1 + random.below(2);
    for(int i = 1; i <= count; ++i)
    {
      std::array<double, 3> position{};
      if(!symmetric)
        for(int d = 0; d < shape_dimension; ++d)
          position[d] = shape == "box" ? upper[d] * random.uniform(0.3, 0.7)
                                       : substance.length * random.uniform(-0.2, 0.2);
      const double sign = start_sign != 0 ? -start_sign : random_sign();
      const double power = sign * substance.conductivity() * substance.temperature_scale
                           * random.log_uniform(1, 10)
                           * (shape_dimension == 3 ? substance.length : 1);
      const std::string here = fmt::format("Scene/Source {}", i);
      const Course course = random_course(random, power, 0, duration, 0.2);
      draft.set(here, "position", list(position));
      draft.set(here, "power", course.expression, course.simpler);
      unbounded = true;
    }
  }

  void SceneMaker::move_sources()
  {
    for(int i = 1; i <= 2; ++i)
    {
      const std::string here = fmt::format("Scene/Source {}", i);
      if(shape != "box" || !draft.has(here) || !random.chance(0.3))
        continue;
      const std::string start = draft.value(here, "position");
      const std::size_t comma = start.find(',');
      const std::string x = start.substr(0, comma);
      draft.set(
          here, "position",
          fmt::format("{} + {}*t{}", x,
                      words(substance.length * random.uniform(-0.2, 0.2) / duration),
                      start.substr(comma)),
          {start});
    }
  }

  void SceneMaker::choose_volumetric_source()
  {
    const double length = substance.length;
    const double density = random_sign() * substance.solid_conductivity
                           * substance.temperature_scale / (length * length)
                           * random.log_uniform(0.5, 20);
    const Course course = over_time(density, 0);
    const std::string wave
        = random.chance(0.5) && symmetry != "cylindrical" && symmetry != "spherical"
              ? fmt::format("(1 + 0.5*sin({}*x))*", words(6 / length))
              : "";
    draft.set("Scene/Volumetric source", "power density",
              fmt::format("{}({})", wave, course.expression), course.simpler);
    unbounded = true;
  }
} // namespace meltfront::verification
