#include <cases/case_file/domain_reader.h>
#include <cases/case_file/key_builders.h>
#include <cases/case_file/thermal_particles_reader.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::cases
{
  namespace
  {
    /** Each stage may have a temperature at its begin and at its end. */
    constexpr int most_bath_times = 2 * most_stages;

    /** Up to so many numbers. */
    PrmEntry list_key(const std::string &key, int most, const std::string &description)
    {
      PrmEntry entry = numbers_key(key, "", description);
      entry.most_values = most;
      return entry;
    }

    const std::string heated_solid_keys = "Scene/Particle solid";
    const std::string bath_keys = "Scene/Particle solid/Bath";
    const std::string light_keys = "Scene/Particle solid/Light";

    void require_ascending(const PrmFile &prm, const std::string &subsection,
                           const std::string &key, const std::vector<double> &values,
                           double above)
    {
      for(const double value : values)
      {
        if(!(value > above && std::isfinite(value)))
          throw prm.error(
              subsection, key,
              fmt::format("must ascend from above {:g}; {:g} does not", above, value));
        above = value;
      }
    }

    HeatBath read_bath(const PrmFile &prm)
    {
      prm.require(bath_keys, "temperatures", "a bath has a temperature");
      HeatBath bath;
      bath.temperatures = prm.get_numbers(bath_keys, "temperatures");
      bath.times = prm.given(bath_keys, "times") ? prm.get_numbers(bath_keys, "times")
                                                 : std::vector<double>{0};
      if(bath.times.size() != bath.temperatures.size() || bath.times.empty())
        throw prm.error(bath_keys, "times",
                        fmt::format("must hold a time for each of the {} temperatures, "
                                    "not {}",
                                    bath.temperatures.size(), bath.times.size()));
      for(const double temperature : bath.temperatures)
        if(!(temperature >= 0 && std::isfinite(temperature)))
          throw prm.error(bath_keys, "temperatures", "must be zero or more");
      if(bath.times.front() != 0)
        throw prm.error(bath_keys, "times", "must begin with 0, the start of the run");
      require_ascending(prm, bath_keys, "times",
                        {bath.times.begin() + 1, bath.times.end()}, 0);
      bath.rate = prm.get_number(bath_keys, "rate");
      return bath;
    }

    Light read_light(const PrmFile &prm, const ParticleSolid &solid)
    {
      const bool parallel = prm.given(light_keys, "direction");
      if(parallel == prm.given(light_keys, "position"))
        throw prm.subsection_error(light_keys,
                                   "needs one of 'position' (a point that shines) and "
                                   "'direction' (of parallel rays)");
      prm.require(light_keys, "power", "light has a power");
      Light light;
      light.parallel = parallel;
      const std::string key = parallel ? "direction" : "position";
      light.at = read_position(prm, light_keys, key, solid.dimension());
      if(parallel && light.at == Position{})
        throw prm.error(light_keys, key, "has no length");
      if(!solid.cell.empty())
        throw prm.subsection_error(light_keys, "falls into open space only; 'cell' makes "
                                               "space repeat itself");
      light.power = prm.get_number(light_keys, "power");
      light.radius = prm.get_number(light_keys, "radius");
      return light;
    }

    std::vector<double> read_cell(const PrmFile &prm, const ParticleSolid &solid)
    {
      if(!prm.given(heated_solid_keys, "cell"))
        return {};
      std::vector<double> cell = prm.get_numbers(heated_solid_keys, "cell");
      const auto dimension = static_cast<std::size_t>(solid.dimension());
      if(cell.size() != dimension
         || !std::ranges::all_of(cell, [](double length) { return length >= 0; }))
        throw prm.error(heated_solid_keys, "cell",
                        fmt::format("needs {} lengths, 0 where space does not repeat "
                                    "itself",
                                    dimension));
      if(solid.base && cell[1] > 0)
        throw prm.error(heated_solid_keys, "cell",
                        "repeats itself along y, across the base");
      return cell;
    }

    std::vector<double> read_stages(const PrmFile &prm, const Scene &scene)
    {
      if(!prm.given(heated_solid_keys, "stages"))
        return {};
      std::vector<double> stages = prm.get_numbers(heated_solid_keys, "stages");
      require_ascending(prm, heated_solid_keys, "stages", stages, scene.start_time);
      if(stages.size() > static_cast<std::size_t>(most_stages))
        throw prm.error(heated_solid_keys, "stages",
                        fmt::format("holds more than {} times", most_stages));
      if(!stages.empty() && stages.back() > scene.end_time)
        throw prm.error(heated_solid_keys, "stages", "ends after the end time");
      return stages;
    }
  } // namespace

  void declare_thermal_particles(PrmFile &prm)
  {
    prm.declare(heated_solid_keys,
                number_key("initial temperature", "0", "",
                           "Temperature of velocities that the seed chooses, without "
                           "momentum; half of it soon becomes energy of the bonds.",
                           0));
    prm.declare(heated_solid_keys,
                numbers_key("cell", "",
                            "Lengths after which space repeats itself along x, y (and "
                            "z); 0 in a direction: it does not."));
    prm.declare(heated_solid_keys,
                number_key("drag", "0", "", "Velocities fade by exp(-drag t).", 0));
    prm.declare(heated_solid_keys,
                list_key("stages", most_stages,
                         "Times at which stages of the run end: over the second half "
                         "of each, means of temperature, energy and structure are "
                         "taken."));
    prm.declare(bath_keys, list_key("temperatures", most_bath_times,
                                    "Temperatures of a bath that all particles are "
                                    "in, linear between its times."));
    prm.declare(bath_keys,
                list_key("times", most_bath_times, "Times of these temperatures."));
    prm.declare(bath_keys,
                number_key("rate", "1", "",
                           "At which the bath makes velocities forget, per time.",
                           above_zero));
    prm.declare(light_keys, numbers_key("position", "", "Where a point shines."));
    prm.declare(light_keys, numbers_key("direction", "", "Direction of parallel rays."));
    prm.declare(light_keys,
                number_key("power", "1", "",
                           "Energy per time: of a point in all directions, of rays per "
                           "width of the plane or area of space.",
                           above_zero));
    prm.declare(light_keys,
                number_key("radius", "0", "",
                           "Of the particles in light; 0: half of the distance at which "
                           "they rest.",
                           0));
  }

  void read_thermal_particles(const PrmFile &prm, const Scene &scene,
                              ParticleSolid &solid)
  {
    if(solid.arrangement == SolidArrangement::bar)
    {
      for(const char *key : {"initial temperature", "cell", "drag", "stages"})
        prm.forbid(heated_solid_keys, key, "the arrangement is a bar");
      for(const std::string &keys : {bath_keys, light_keys})
        if(prm.opened(keys))
          throw prm.subsection_error(keys,
                                     "has no meaning for a bar, whose walls heat it");
      return;
    }
    solid.initial_temperature = prm.get_number(heated_solid_keys, "initial temperature");
    if(solid.initial_temperature > 0 && solid.arrangement == SolidArrangement::table)
      throw prm.error(heated_solid_keys, "initial temperature",
                      "has no meaning where a table holds the velocities");
    solid.cell = read_cell(prm, solid);
    solid.drag = prm.get_number(heated_solid_keys, "drag");
    solid.stages = read_stages(prm, scene);
    if(prm.opened(bath_keys))
      solid.bath = read_bath(prm);
    if(prm.opened(light_keys))
      solid.light = read_light(prm, solid);
  }
} // namespace meltfront::cases
