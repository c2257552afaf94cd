#include <cases/error.h>
#include <particles/greenspan/bar/bar.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/bonds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Between the order of solids near their melting point (0.74) and liquids (0). */
    constexpr double middle_order = 0.37;

    /** Columns on each side of the front that count for its place. */
    constexpr int window_columns = 20;

    /** The cold bath has no other end. */
    constexpr double far_away = 1e6;

    double spacing(const BarSettings &settings)
    {
      return settings.spacing > 0 ? settings.spacing
                                  : settings.force.equilibrium_distance();
    }

    /** Column by column, so that the last particles make up the piston. */
    ParticleState lattice(const BarSettings &settings)
    {
      const double a = spacing(settings), height = std::sqrt(0.75) * a;
      ParticleState state;
      for(int column = 0; column < settings.columns; ++column)
        for(int row = 0; row < settings.rows; ++row)
          state.add({(column + 0.25 + 0.5 * (row % 2)) * a, (row + 0.5) * height, 0});
      state.period = {0, settings.rows * height, 0};
      // Half of it becomes energy of the bonds.
      set_temperature(state, 2 * settings.cold_temperature, settings.seed);
      return state;
    }

    Thermostat bath(const BarSettings &settings, double temperature, std::uint64_t salt)
    {
      Thermostat result;
      result.first_temperature = result.last_temperature = temperature;
      result.rate = settings.bath_rate;
      result.seed = 3 * settings.seed + salt;
      return result;
    }

    MotionParameters parameters(const BarSettings &settings)
    {
      settings.validate();
      MotionParameters result;
      result.force = settings.force;
      result.gravity = 0;
      result.time_step = settings.time_step;
      result.threads = settings.threads;
      result.wall = true;
      result.thermostat = bath(settings, settings.cold_temperature, 0);
      result.thermostat->rate = 1;
      Piston piston;
      const int n = settings.columns * settings.rows;
      const int pushed = settings.piston_columns * settings.rows;
      for(int i = n - pushed; i < n; ++i)
        piston.particles.push_back(static_cast<std::uint32_t>(i));
      const double width = settings.rows * std::sqrt(0.75) * spacing(settings);
      piston.force = settings.pressure * width / pushed;
      result.piston = piston;
      return result;
    }

    /** Particles from the wall on. */
    std::vector<std::uint32_t> along_x(const ParticleState &state)
    {
      std::vector<std::uint32_t> order(state.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(),
                [&x = state.position[0]](std::uint32_t a, std::uint32_t b)
                { return x[a] < x[b] || (x[a] == x[b] && a < b); });
      return order;
    }

    /** A layer of the particles sequence[begin] to sequence[end - 1]. */
    BarLayer layer(const ParticleState &state, const BondGraph &bonds,
                   const std::vector<double> &order,
                   const std::vector<std::uint32_t> &sequence, std::size_t begin,
                   std::size_t end)
    {
      const auto &x = state.position[0];
      const double n = static_cast<double>(end - begin);
      const double width = state.period[1];
      BarLayer result;
      std::array<double, 2> mean{};
      for(std::size_t k = begin; k < end; ++k)
      {
        const std::uint32_t i = sequence[k];
        result.position += x[i] / n;
        result.order += order[i] / n;
        result.coordination += static_cast<double>(bonds[i].size()) / n;
        for(int d = 0; d < 2; ++d)
          mean[d] += state.velocity[d][i] / n;
      }
      // The motion of the layer as a whole is not heat.
      for(std::size_t k = begin; k < end; ++k)
        for(int d = 0; d < 2; ++d)
        {
          const double v = state.velocity[d][sequence[k]] - mean[d];
          result.temperature += v * v / (2 * (n - 1));
        }
      const auto border = [&](std::size_t k)
      {
        if(k == 0)
          return 0.;
        const std::size_t next = std::min(k, sequence.size() - 1);
        return (x[sequence[k - 1]] + x[sequence[next]]) / 2;
      };
      result.density = n / (width * (border(end) - border(begin)));
      result.mass = static_cast<double>(begin + end) / (2 * width);
      return result;
    }
  } // namespace

  void BarSettings::validate() const
  {
    if(rows < 4 || rows % 2 != 0 || columns < 10 || piston_columns < 1
       || piston_columns > columns / 6)
      throw cases::InputError(fmt::format(
          "a bar of {} columns and {} rows with a piston of {} columns is asked for; it "
          "needs ten columns or more, four rows or more, rows in pairs, and a piston of "
          "a sixth of its columns at most",
          columns, rows, piston_columns));
    const double length = columns * greenspan::spacing(*this);
    if(!(hot_length > 0 && cold_length > 0 && hot_length + cold_length < length))
      throw cases::InputError(
          fmt::format("baths over lengths of {} and {} do not fit into a bar of {:.4g}",
                      hot_length, cold_length, length));
    if(!(pressure >= 0 && std::isfinite(pressure) && equilibration >= 0
         && std::isfinite(equilibration)))
      throw cases::InputError(
          fmt::format("the pressure {} on a bar and its time of equilibration {} must be "
                      "zero or more",
                      pressure, equilibration));
  }

  Bar::Bar(const BarSettings &settings)
    : given(settings)
    , motion(parameters(settings), lattice(settings))
  {
    motion.advance(std::lround(given.equilibration / given.time_step));
    motion.set_thermostat({});
    const double length = look().length;
    motion.set_zones(
        {{0, given.hot_length, bath(given, given.hot_temperature, 1)},
         {length - given.cold_length, far_away, bath(given, given.cold_temperature, 2)}});
    first_step = motion.step();
  }

  void Bar::advance_to(double time)
  {
    motion.advance(first_step + std::lround(time / given.time_step) - motion.step());
  }

  BarLook Bar::look(int layer_columns) const
  {
    const ParticleState state = motion.state();
    const BondGraph bonds(state, given.force.cutoff);
    const std::vector<double> order = lattice_order(state, bonds);
    const std::vector<std::uint32_t> sequence = along_x(state);
    std::vector<double> in_sequence;
    BarLook result;
    for(const std::uint32_t i : sequence)
    {
      in_sequence.push_back(order[i]);
      result.edge += state.position[0][i] < given.hot_length ? 1 / width() : 0;
    }
    // The piston's columns are disordered by their load.
    const std::size_t solid
        = in_sequence.size()
          - static_cast<std::size_t>(3 * given.piston_columns * given.rows);
    result.front = dividing_surface({in_sequence.data(), solid}, middle_order,
                                    static_cast<std::size_t>(window_columns * given.rows))
                   / width();
    result.time = static_cast<double>(motion.step() - first_step) * given.time_step;
    if(motion.zone_heat().size() == 2)
    {
      result.hot_heat = motion.zone_heat()[0] / width();
      result.cold_heat = motion.zone_heat()[1] / width();
    }
    result.enthalpy = motion.energy().total() / width();
    const auto &piston = motion.parameters().piston->particles;
    for(const std::uint32_t i : piston)
      result.length += state.position[0][i] / static_cast<double>(piston.size());
    const std::size_t size = static_cast<std::size_t>(layer_columns) * given.rows;
    for(std::size_t begin = 0; begin + size <= sequence.size(); begin += size)
      result.layers.push_back(layer(state, bonds, order, sequence, begin, begin + size));
    return result;
  }

  std::size_t order_step(std::span<const double> order, double middle)
  {
    double sum = 0, best = 0;
    std::size_t step = 0;
    for(std::size_t k = 0; k < order.size(); ++k)
    {
      sum += middle - order[k];
      if(sum > best)
      {
        best = sum;
        step = k + 1;
      }
    }
    return step;
  }

  double dividing_surface(std::span<const double> order, double middle,
                          std::size_t window)
  {
    const std::size_t step = order_step(order, middle);
    const std::size_t begin = step - std::min(step, window);
    const std::size_t end = std::min(order.size(), step + window);
    const std::size_t last = std::min(order.size(), end + 4 * window);
    const double of_solid
        = last > end + window / 2
              ? std::accumulate(order.begin() + end, order.begin() + last, 0.)
                    / static_cast<double>(last - end)
              : 2 * middle;
    double molten = static_cast<double>(begin);
    for(std::size_t k = begin; k < end; ++k)
      molten += 1 - order[k] / of_solid;
    return molten;
  }

  std::vector<BarLook> run_bar(const BarSettings &settings, const BarSchedule &schedule,
                               const std::function<void(double)> &progress)
  {
    if(!(schedule.interval > 0 && schedule.duration > 0
         && std::isfinite(schedule.duration)))
      throw cases::InputError(fmt::format(
          "a bar is to be looked at each {} during {}; both times must be positive",
          schedule.interval, schedule.duration));
    Bar bar(settings);
    const double all = static_cast<double>(bar.particles().size()) / bar.width();
    std::vector<BarLook> looks{bar.look()};
    for(int k = 1; k * schedule.interval <= schedule.duration * (1 + 1e-12); ++k)
    {
      bar.advance_to(k * schedule.interval);
      looks.push_back(bar.look());
      if(progress)
        progress(looks.back().time / schedule.duration);
      if(looks.back().front > schedule.largest_share * all)
        break;
    }
    return looks;
  }
} // namespace meltfront::particles::greenspan
