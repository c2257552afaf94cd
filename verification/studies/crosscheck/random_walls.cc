#include <verification/studies/crosscheck/scene_maker.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  void SceneMaker::choose_walls()
  {
    std::string periodic;
    if(shape == "slab" && problem != Problem::steady && random.chance(0.03))
      periodic = "x";
    if(shape == "box" && random.chance(0.08))
      periodic = "y";
    held = false;
    for(const std::string &side : sides())
    {
      const std::string here = "Scene/Walls/" + side;
      if(!periodic.empty() && side.substr(0, 1) == periodic)
        draft.set(here, "kind", "periodic");
      else
        choose_wall(here, side);
    }
    // A steady temperature is known up to a constant unless a wall holds it.
    if(problem == Problem::steady && !held)
    {
      draft.remove("Scene/Walls/x_min");
      hold("Scene/Walls/x_min", "x_min");
    }
  }

  void SceneMaker::choose_wall(const std::string &here, const std::string &side)
  {
    switch(changes_phase() ? random.weighted({0.3, 0.46, 0.17, 0.07})
                           : random.weighted({0.25, 0.35, 0.2, 0.2}))
    {
    case 0:
      return;
    case 1:
      hold(here, side);
      return;
    case 2:
    {
      const double flux = random_sign() * substance.conductivity()
                          * substance.temperature_scale / substance.length
                          * random.log_uniform(0.3, 4);
      const Course course = over_time(flux, 0);
      draft.set(here, "kind", "flux");
      draft.set(here, "flux", course.expression, course.simpler);
      unbounded = true;
      return;
    }
    default:
      exchange_heat(here);
    }
  }

  void SceneMaker::exchange_heat(const std::string &here)
  {
    const Course course = over_time(wall_temperature(), wall_temperature());
    const double coefficient
        = substance.conductivity() / substance.length * random.log_uniform(0.3, 100);
    const bool radiates = problem != Problem::steady && random.chance(0.3);
    draft.set(here, "kind", radiates ? "radiation" : "heat transfer");
    draft.set(here, "ambient temperature", course.expression, course.simpler);
    held = unbounded = true;
    if(!radiates)
      draft.set(here, "heat transfer coefficient", words(coefficient));
    else
      radiate(here, coefficient);
  }

  void SceneMaker::surround_alloy()
  {
    if(shape == "outline" || draft.value("Scene/Domain", "shape") == "axisymmetric")
      return;
    for(const std::string &side : sides())
    {
      const std::string here = "Scene/Walls/" + side;
      if(draft.value(here, "kind") == "periodic" || !random.chance(0.35))
        continue;
      draft.remove(here);
      exchange_heat(here);
    }
  }

  /** As strongly as heat transfer at the melting temperature. */
  void SceneMaker::radiate(const std::string &here, double coefficient)
  {
    const double absolute = 4 * substance.temperature_scale;
    draft.set(here, "absolute zero", words(substance.melting_temperature - absolute));
    draft.set(here, "emissivity", "1");
    draft.set(here, "Stefan-Boltzmann constant",
              words(coefficient / (4 * absolute * absolute * absolute)));
  }

  void SceneMaker::hold(const std::string &here, const std::string &side)
  {
    held = true;
    draft.set(here, "kind", "fixed temperature");
    const double temperature = wall_temperature();
    Course course = over_time(temperature, wall_temperature());
    if(dimension >= 2 && shape != "outline" && random.chance(0.15))
    {
      const std::string along = side.starts_with("y") || round() ? "x" : "y";
      course = {fmt::format("{} + {}*cos({}*{})", words(temperature),
                            words(0.3 * substance.temperature_scale),
                            words(3.14159265 / substance.length), along),
                {words(temperature)}};
    }
    draft.set(here, "temperature", course.expression, course.simpler);
  }

  double SceneMaker::wall_temperature()
  {
    const bool opposite = start_sign != 0 && random.chance(0.7);
    return warmer((opposite ? -start_sign : random_sign()) * random.uniform(0.1, 1));
  }
} // namespace meltfront::verification
