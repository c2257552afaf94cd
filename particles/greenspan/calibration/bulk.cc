#include <cases/error.h>
#include <particles/greenspan/calibration/bulk.h>
#include <particles/greenspan/motion/bonds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Steps from one look at the pressure to the next. */
    constexpr long steps_between_looks = 100;

    /** The area goes to where the pressure is right within about this time... */
    constexpr double pressure_time = 1;
    /** ... with compressibilities above those of a solid (2e-4) and a liquid (up to
     * 2e-2). */
    constexpr double compressibility_of_solid = 1e-3, compressibility_of_liquid = 1e-2;

    constexpr double bath_rate = 0.5;

    /** A liquid is melted at so many times its temperature and that much of the lattice's
     * density, in this share of its equilibration. */
    constexpr double melting_heat = 2, melting_density = 0.85, melting_share = 0.2;

    double area(const Motion &motion)
    {
      return motion.period()[0] * motion.period()[1];
    }

    double pressure(const Motion &motion)
    {
      const std::array<double, 3> virial = motion.virial();
      return (virial[0] + virial[1]) / (2 * area(motion));
    }

    /** Scale the area a little towards the pressure. @return the pressure before */
    double relax_area(Motion &motion, const BulkSettings &settings)
    {
      const double compressibility
          = settings.liquid ? compressibility_of_liquid : compressibility_of_solid;
      const double now = pressure(motion);
      const double interval
          = static_cast<double>(steps_between_looks) * motion.parameters().time_step;
      const double change
          = interval / pressure_time * compressibility * (now - settings.pressure) / 2;
      motion.stretch(1 + std::clamp(change, -0.01, 0.01));
      return now;
    }

    void set_bath(Motion &motion, const BulkSettings &settings, double temperature)
    {
      Thermostat bath;
      bath.first_temperature = bath.last_temperature = temperature;
      bath.rate = bath_rate;
      bath.seed = settings.seed;
      motion.set_thermostat(bath);
    }

    long steps(const BulkSettings &settings, double duration)
    {
      return std::lround(duration / settings.time_step);
    }

    Motion equilibrated(const BulkSettings &settings)
    {
      MotionParameters parameters;
      parameters.force = settings.crystal.force;
      parameters.gravity = 0;
      parameters.time_step = settings.time_step;
      ParticleState start = settings.crystal.lattice();
      // Half of it becomes energy of the bonds.
      set_temperature(start, 2 * settings.temperature, settings.seed);
      Motion motion(parameters, start);
      double rest = settings.equilibration;
      if(settings.liquid)
      {
        motion.stretch(1 / std::sqrt(melting_density));
        set_bath(motion, settings, melting_heat * settings.temperature);
        motion.advance(steps(settings, melting_share * settings.equilibration));
        rest *= 1 - melting_share;
      }
      set_bath(motion, settings, settings.temperature);
      for(long step = 0; step < steps(settings, rest); step += steps_between_looks)
      {
        motion.advance(steps_between_looks);
        relax_area(motion, settings);
      }
      return motion;
    }

    /** Sums over looks at a motion. */
    class Averages
    {
    public:
      void look(const Motion &motion, double pressure)
      {
        const Energy energy = motion.energy();
        const ParticleState state = motion.state();
        const double n = static_cast<double>(motion.size());
        const BondGraph bonds(state, motion.parameters().force.cutoff);
        sum.temperature += energy.kinetic / n;
        sum.pressure += pressure;
        sum.area += area(motion) / n;
        sum.energy += energy.total() / n;
        sum.order += hexatic_order(state, bonds);
        for(const double order : lattice_order(state, bonds))
          sum.lattice_order += order / n;
        ++looks;
      }

      BulkProperties mean(double target) const
      {
        BulkProperties result;
        result.temperature = sum.temperature / looks;
        result.pressure = sum.pressure / looks;
        result.density = looks / sum.area;
        result.enthalpy = sum.energy / looks + target / result.density;
        result.order = sum.order / looks;
        result.lattice_order = sum.lattice_order / looks;
        return result;
      }

      double density() const
      {
        return looks / sum.area;
      }

    private:
      struct
      {
        double temperature = 0, pressure = 0, area = 0, energy = 0, order = 0,
               lattice_order = 0;
      } sum;
      int looks = 0;
    };

    Averages average(Motion &motion, const BulkSettings &settings)
    {
      Averages averages;
      for(long step = 0; step < steps(settings, settings.duration);
          step += steps_between_looks)
      {
        motion.advance(steps_between_looks);
        const double before = relax_area(motion, settings);
        averages.look(motion, before);
      }
      return averages;
    }
  } // namespace

  ParticleState PeriodicCrystal::lattice() const
  {
    if(columns < 4 || rows < 4 || rows % 2 != 0)
      throw cases::InputError(
          fmt::format("a periodic crystal of {} columns and {} rows is asked for; it "
                      "needs four or more of both, rows in pairs",
                      columns, rows));
    const double a = spacing > 0 ? spacing : force.equilibrium_distance();
    const double height = std::sqrt(0.75) * a;
    ParticleState state;
    for(int row = 0; row < rows; ++row)
      for(int column = 0; column < columns; ++column)
        state.add({(column + 0.25 + 0.5 * (row % 2)) * a, (row + 0.5) * height, 0});
    state.period = {columns * a, rows * height, 0};
    return state;
  }

  BulkProperties measure_bulk(const BulkSettings &settings)
  {
    Motion motion = equilibrated(settings);
    return average(motion, settings).mean(settings.pressure);
  }

  ParticleState equilibrated_bulk(const BulkSettings &settings)
  {
    Motion motion = equilibrated(settings);
    const double density = average(motion, settings).density();
    motion.stretch(
        std::sqrt(static_cast<double>(motion.size()) / density / area(motion)));
    return motion.state();
  }
} // namespace meltfront::particles::greenspan
