// The sweeps of a step over all particles but for the pair forces, and sums over them.

#include <cases/error.h>
#include <particles/greenspan/motion/motion.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** Sums are taken block by block, whatever the number of threads. */
    constexpr std::size_t block_size = 4096;

    /** Call something for each block of particles. */
    template <typename Body>
    void for_each_block(std::size_t n, int threads, const Body &body)
    {
      const auto blocks = static_cast<std::ptrdiff_t>((n + block_size - 1) / block_size);
      const auto run = [&](std::ptrdiff_t block)
      {
        const std::size_t begin = block * block_size;
        body(block, begin, std::min(n, begin + block_size));
      };
      if(threads == 1 || blocks == 1)
        for(std::ptrdiff_t block = 0; block < blocks; ++block)
          run(block);
      else
      {
#pragma omp parallel for schedule(static) num_threads(threads)
        for(std::ptrdiff_t block = 0; block < blocks; ++block)
          run(block);
      }
    }

    template <int dimension>
    SpeedSums drift_block(Coordinates &position, const Coordinates &velocity,
                          double time_step, std::size_t begin, std::size_t end)
    {
      double *x[dimension];
      const double *v[dimension];
      for(int d = 0; d < dimension; ++d)
      {
        x[d] = position[d].data();
        v[d] = velocity[d].data();
      }
      double sum = 0, largest = 0;
#pragma omp simd reduction(+ : sum) reduction(max : largest)
      for(std::size_t i = begin; i < end; ++i)
      {
        double squared = 0;
        for(int d = 0; d < dimension; ++d)
        {
          squared += v[d][i] * v[d][i];
          x[d][i] += time_step * v[d][i];
        }
        sum += squared;
        largest = std::max(largest, squared);
      }
      return {sum, largest};
    }

    /** v += factor(R^2) (r - s) within the source's reach. */
    template <int dimension, typename Factor>
    void heat_block(const Coordinates &position, Coordinates &velocity,
                    const HeatSource &source, std::size_t begin, std::size_t end,
                    const Factor &factor)
    {
      const double reach = source.reach * source.reach;
      const double *x[dimension];
      double *v[dimension], centre[dimension];
      for(int d = 0; d < dimension; ++d)
      {
        x[d] = position[d].data();
        v[d] = velocity[d].data();
        centre[d] = source.position[d];
      }
#pragma omp simd
      for(std::size_t i = begin; i < end; ++i)
      {
        double apart[dimension], squared = 0;
        for(int d = 0; d < dimension; ++d)
        {
          apart[d] = x[d][i] - centre[d];
          squared += apart[d] * apart[d];
        }
        const double f = squared < reach ? factor(squared) : 0;
        for(int d = 0; d < dimension; ++d)
          v[d][i] += f * apart[d];
      }
    }
  } // namespace

  void Motion::move()
  {
    block_speeds.resize((names.size() + block_size - 1) / block_size);
    for_each_block(names.size(), given.threads,
                   [this](std::size_t block, std::size_t begin, std::size_t end)
                   { move_block(block, begin, end); });
    check_speeds();
  }

  void Motion::move_block(std::size_t block, std::size_t begin, std::size_t end)
  {
    const double dt = given.time_step;
    block_speeds[block] = dimension == 2
                              ? drift_block<2>(position, velocity, dt, begin, end)
                              : drift_block<3>(position, velocity, dt, begin, end);
    const auto measured = [block](cases::EffectMeter &meter, const auto &sweep)
    { block == 0 ? meter.measure(sweep) : sweep(); };
    if(given.base)
      measured(base_meter, [&] { reflect(begin, end); });
    if(given.wall)
      reflect_at_wall(begin, end);
    if(given.source)
      measured(source_meter, [&] { heat(begin, end); });
    if(given.temperatures)
      add_temperatures(begin, end);
  }

  cases::EffectCost Motion::cost(cases::Effect effect) const
  {
    const auto of_all = [&](const cases::EffectMeter &meter)
    {
      cases::EffectCost result = meter.cost(effect, 0);
      result.seconds
          *= std::max(1., static_cast<double>(size()) / block_size / given.threads);
      return result;
    };
    switch(effect)
    {
    case cases::Effect::base:
      return of_all(base_meter);
    case cases::Effect::point_heating:
      return of_all(source_meter);
    case cases::Effect::light:
      return light_meter.cost(effect, 0);
    case cases::Effect::wall_temperature:
    case cases::Effect::heat_bath:
      return zone_meter.cost(effect, heat_of_zones.size() * sizeof(double));
    default:
      return {effect, steps_taken, 0, 0};
    }
  }

  void Motion::check_speeds()
  {
    SpeedSums all;
    for(const SpeedSums &block : block_speeds)
    {
      all.sum += block.sum;
      all.largest = std::max(all.largest, block.largest);
    }
    const double move = given.time_step * std::sqrt(all.largest);
    const double kinetic = all.sum / 2;
    if(!std::isfinite(all.sum) || move > furthest_in_a_step
       || kinetic > 2 * kinetic_before + all_bonds)
      explain_broken_motion(kinetic, move);
    kinetic_before = kinetic;
    travelled += move;
  }

  void Motion::explain_broken_motion(double kinetic, double move) const
  {
    const auto speed = [this](std::size_t i)
    { return std::hypot(velocity[0][i], velocity[1][i], velocity[dimension - 1][i]); };
    std::size_t fastest = 0;
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      if(!std::isfinite(speed(i)))
        fail(fmt::format("the velocity of particle {}", names[i] + 1),
             "is not finite; it met another particle or the heat source");
      if(speed(i) > speed(fastest))
        fastest = i;
    }
    if(given.source)
    {
      double squared = 0;
      for(int d = 0; d < dimension; ++d)
      {
        const double before
            = position[d][fastest] - given.time_step * velocity[d][fastest];
        squared += (before - given.source->position[d])
                   * (before - given.source->position[d]);
      }
      if(std::sqrt(squared) < furthest_in_a_step)
        fail(
            fmt::format("particle {}", names[fastest] + 1),
            fmt::format("is thrown out with velocity {:.4g} by the heat source that lies "
                        "inside it; move the source",
                        speed(fastest)));
    }
    if(move > furthest_in_a_step)
      fail(fmt::format("particle {}", names[fastest] + 1),
           fmt::format(
               "moves by {:.3g} in one step, more than a tenth of a bond; the time "
               "step {:g} is too large for this motion",
               move, given.time_step));
    fail("kinetic energy",
         fmt::format(
             "grows from {:.6g} to {:.6g} in one step, by more than itself and all "
             "bonds; the time step {:g} is too large for this motion",
             kinetic_before, kinetic, given.time_step));
  }

  void Motion::reflect(std::size_t begin, std::size_t end)
  {
    const Base base = *given.base;
    const double *x = position[0].data();
    double *y = position[1].data(), *v = velocity[1].data();
    // Along the base nothing moves on.
    for(int d = 0; d < dimension; d += 2)
    {
      double *along = velocity[d].data();
#pragma omp simd
      for(std::size_t i = begin; i < end; ++i)
        along[i] = y[i] < 0 ? 0 : along[i];
    }
#pragma omp simd
    for(std::size_t i = begin; i < end; ++i)
    {
      const double hot = base.hot_left - base.hot_slope * (x[i] + base.hot_half_width);
      const double gamma = std::abs(x[i]) < base.hot_half_width ? hot : base.restitution;
      const double thrown_back = -gamma * v[i];
      v[i] = y[i] < 0 ? thrown_back : v[i];
      y[i] = std::abs(y[i]);
    }
  }

  void Motion::heat(std::size_t begin, std::size_t end)
  {
    const HeatSource &source = *given.source;
    const double strength = source.strength(steps_taken);
    const double exponent = -(source.power + 1) / 2;
    const auto sweep = [&](const auto &factor)
    {
      if(dimension == 2)
        heat_block<2>(position, velocity, source, begin, end, factor);
      else
        heat_block<3>(position, velocity, source, begin, end, factor);
    };
    if(source.power == 2)
      sweep([strength](double squared)
            { return strength / (squared * std::sqrt(squared)); });
    else if(source.power == -2)
      sweep([strength](double squared) { return strength * std::sqrt(squared); });
    else
      sweep([strength, exponent](double squared)
            { return strength * std::pow(squared, exponent); });
  }

  void Motion::add_temperatures(std::size_t begin, std::size_t end)
  {
    double *sum = kinetic_sum.data();
    for(int d = 0; d < dimension; ++d)
    {
      const double *v = velocity[d].data();
      for(std::size_t i = begin; i < end; ++i)
        sum[i] += v[i] * v[i] / 2;
    }
  }

  Energy Motion::energy() const
  {
    const Coordinates acceleration = raw_accelerations();
    Energy result;
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      for(int d = 0; d < dimension; ++d)
      {
        const double v = velocity[d][i] - given.time_step / 2 * acceleration[d][i];
        result.kinetic += v * v / 2;
      }
      result.height += given.gravity * position[1][i];
      for(const std::uint32_t j : rows.row(i))
      {
        const std::array<double, 3> apart = way(i, j);
        result.bonds
            += given.force.potential(std::hypot(apart[0], apart[1], apart[2])) / 2;
      }
    }
    for(const std::uint32_t i : pushed)
      result.piston += given.piston->force * position[0][i];
    return result;
  }

  double Motion::temperature() const
  {
    double sum = 0;
    for(int d = 0; d < dimension; ++d)
      for(std::size_t i = 0; i < names.size(); ++i)
        sum += velocity[d][i] * velocity[d][i];
    return sum / (dimension * static_cast<double>(names.size()));
  }

  std::array<double, 3> Motion::momentum() const
  {
    const Coordinates acceleration = raw_accelerations();
    std::array<double, 3> sum{};
    for(int d = 0; d < dimension; ++d)
      for(std::size_t i = 0; i < names.size(); ++i)
        sum[d] += velocity[d][i] - given.time_step / 2 * acceleration[d][i];
    return sum;
  }
} // namespace meltfront::particles::greenspan
