#include <cases/error.h>
#include <particles/greenspan/motion/motion_parameters.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    void require(bool holds, const char *what, double value, const char *right)
    {
      if(!holds)
        throw cases::InputError(
            fmt::format("{} is {}; it must be {}", what, value, right));
    }

    void validate(const Base &base)
    {
      require(base.restitution >= 0 && std::isfinite(base.restitution),
              "gamma of the base", base.restitution, "zero or more");
      require(base.hot_half_width >= 0, "the half width of the base's heated part",
              base.hot_half_width, "zero or more");
      require(base.hot_left >= 0 && std::isfinite(base.hot_left),
              "gamma of the heated base", base.hot_left, "zero or more");
      const double right = base.hot_left - 2 * base.hot_slope * base.hot_half_width;
      require(right >= 0 && std::isfinite(right),
              "gamma at the right end of the heated base", right, "zero or more");
    }

    void validate(const HeatSource &source)
    {
      require(source.reach > 0 && std::isfinite(source.reach),
              "the reach of the heat source", source.reach, "positive");
      require(std::abs(source.power) <= 10, "the power of the heat source", source.power,
              "between -10 and 10");
      require(!source.stages.empty(), "the number of stages of the heat source", 0,
              "one or more");
      for(const HeatStage &stage : source.stages)
      {
        require(stage.steps > 0, "the length of a stage of heating", double(stage.steps),
                "one step or more");
        require(std::isfinite(stage.strength), "the strength of the heat source",
                stage.strength, "finite");
      }
    }

    void validate(const Radiation &radiation)
    {
      require(std::isfinite(radiation.power) && radiation.power >= 0,
              "the power of radiation", radiation.power, "zero or more");
      require(radiation.radius >= 0 && std::isfinite(radiation.radius),
              "the radius of particles in light", radiation.radius, "zero or more");
      require(radiation.interval >= 1, "the interval of radiation",
              double(radiation.interval), "one step or more");
    }

    void validate(const Thermostat &thermostat)
    {
      for(const double temperature :
          {thermostat.first_temperature, thermostat.last_temperature})
        require(temperature >= 0 && std::isfinite(temperature),
                "a temperature of the thermostat", temperature, "zero or more");
      require(thermostat.steps >= 1, "the duration of the thermostat's ramp",
              double(thermostat.steps), "one step or more");
      require(thermostat.rate > 0 && std::isfinite(thermostat.rate),
              "the rate of the thermostat", thermostat.rate, "positive");
      long before = -1;
      for(const Thermostat::Moment &moment : thermostat.course)
      {
        require(moment.temperature >= 0 && std::isfinite(moment.temperature),
                "a temperature of the thermostat", moment.temperature, "zero or more");
        require(moment.step > before, "a step of the thermostat's course",
                double(moment.step), "later than the one before");
        before = moment.step;
      }
    }
  } // namespace

  double Thermostat::temperature(long step) const
  {
    if(!course.empty())
    {
      const auto next = std::ranges::find_if(course, [step](const Moment &moment)
                                             { return moment.step > step; });
      if(next == course.begin())
        return course.front().temperature;
      if(next == course.end())
        return course.back().temperature;
      const Moment &last = *std::prev(next);
      return last.temperature
             + (next->temperature - last.temperature)
                   * static_cast<double>(step - last.step)
                   / static_cast<double>(next->step - last.step);
    }
    const double share
        = std::clamp(static_cast<double>(step) / static_cast<double>(steps), 0., 1.);
    return first_temperature + share * (last_temperature - first_temperature);
  }

  double HeatSource::strength(long step) const
  {
    long end = 0;
    for(const HeatStage &stage : stages)
    {
      end += stage.steps;
      if(step <= end)
        return stage.strength;
    }
    return stages.back().strength;
  }

  void MotionParameters::validate(int dimension) const
  {
    force.validate();
    const double stable = force.stable_time_step(dimension);
    if(!(time_step > 0 && time_step < stable))
      throw cases::InputError(
          fmt::format("the time step is {}; it must be positive and below {:.4g}, where "
                      "the vibrations of these bonds begin to grow",
                      time_step, stable));
    require(std::isfinite(gravity), "gravity", gravity, "finite");
    require(drag >= 0 && std::isfinite(drag), "the drag", drag, "zero or more");
    require(skin > 0 && skin <= 10, "the skin of the lists of neighbours", skin,
            "positive, 10 at most");
    require(threads >= 1 && threads <= 1024, "the number of threads", threads,
            "1 to 1024");
    if(base)
      greenspan::validate(*base);
    if(source)
      greenspan::validate(*source);
    if(radiation)
      greenspan::validate(*radiation);
    if(thermostat)
      greenspan::validate(*thermostat);
    for(const BathZone &zone : zones)
    {
      require(zone.end > zone.begin, "the end of a bath's zone", zone.end,
              "beyond its beginning");
      greenspan::validate(zone.bath);
    }
    if(piston)
      require(std::isfinite(piston->force), "the force of the piston on a particle",
              piston->force, "finite");
  }
} // namespace meltfront::particles::greenspan
