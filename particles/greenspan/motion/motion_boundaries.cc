// What bounds a bar: baths over parts of it, an elastic wall, a piston; and its pressure.

#include <cases/error.h>
#include <particles/greenspan/motion/motion.h>
#include <particles/greenspan/motion/step_noise.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::greenspan
{
  void Motion::check_boundaries() const
  {
    const double least = 2 * (given.force.cutoff + given.skin);
    for(int d = 0; d < dimension; ++d)
      if(repetition[d] != 0 && !(repetition[d] > least && std::isfinite(repetition[d])))
        throw cases::InputError(
            fmt::format("space repeats itself after {} in direction {}; it must be 0 (it "
                        "does not) or "
                        "more than {:.4g}, twice the reach of the lists of neighbours",
                        repetition[d], d, least));
    if(given.wall && repetition[0] > 0)
      throw cases::InputError("a wall at x = 0 makes no sense where space repeats itself "
                              "along x");
    if(given.wall)
      for(std::size_t i = 0; i < names.size(); ++i)
        if(position[0][i] < 0)
          throw cases::InputError(
              fmt::format("particle {} lies at x = {:.6g}, beyond the wall x = 0",
                          names[i] + 1, position[0][i]));
    if(given.piston)
      for(const std::uint32_t particle : given.piston->particles)
        if(particle >= names.size())
          throw cases::InputError(fmt::format("the piston pushes particle {} of {}",
                                              particle + 1, names.size()));
  }

  void Motion::stretch(double factor)
  {
    if(!(factor > 0.5 && factor < 2))
      throw cases::InputError(fmt::format(
          "space is to be stretched by {}; the factor must lie between 1/2 and 2",
          factor));
    for(int d = 0; d < dimension; ++d)
    {
      for(std::size_t i = 0; i < names.size(); ++i)
        position[d][i] *= factor;
      repetition[d] *= factor;
    }
    check_boundaries();
    forces = make_force_sweep(given.force, dimension, repetition);
    build_lists();
  }

  void Motion::find_pushed_particles()
  {
    if(!given.piston)
      return;
    std::vector<std::uint32_t> place(names.size());
    for(std::size_t i = 0; i < names.size(); ++i)
      place[names[i]] = static_cast<std::uint32_t>(i);
    pushed.clear();
    for(const std::uint32_t particle : given.piston->particles)
      pushed.push_back(place[particle]);
  }

  void Motion::reflect_at_wall(std::size_t begin, std::size_t end)
  {
    double *x = position[0].data(), *v = velocity[0].data();
#pragma omp simd
    for(std::size_t i = begin; i < end; ++i)
    {
      v[i] = x[i] < 0 ? -v[i] : v[i];
      x[i] = std::abs(x[i]);
    }
  }

  void Motion::push(double duration)
  {
    for(const std::uint32_t i : pushed)
      velocity[0][i] -= duration * given.piston->force;
  }

  /** The bath acts in the middle of the coming move: half of it is taken back with the
   * old velocity and given with the new one. Without that a bath would heat by rate (dt
   * a)^2 / 4 more than the kinetic energy that it gives. */
  void Motion::exchange_with_zones()
  {
    double largest = 0;
    for(std::size_t z = 0; z < given.zones.size(); ++z)
    {
      const BathZone &zone = given.zones[z];
      const double kept = std::exp(-zone.bath.rate * given.time_step);
      const double noise
          = std::sqrt(zone.bath.temperature(steps_taken) * (1 - kept) * (1 + kept));
      const StepNoise random(zone.bath.seed, steps_taken);
      double gain = 0;
      for(std::size_t i = 0; i < names.size(); ++i)
      {
        const double x = wrapped(position[0][i], repetition[0]);
        if(x < zone.begin || x >= zone.end)
          continue;
        const std::array<double, 3> normal = random(names[i], dimension);
        for(int d = 0; d < dimension; ++d)
        {
          const double before = velocity[d][i];
          const double after = kept * before + noise * normal[d];
          velocity[d][i] = after;
          gain += (after - before) * (after + before) / 2;
          const double shift = given.time_step / 2 * (after - before);
          position[d][i] -= shift;
          largest = std::max(largest, std::abs(shift));
        }
      }
      heat_of_zones[z] += gain;
    }
    travelled += 2 * largest;
  }

  std::array<double, 3> Motion::virial() const
  {
    const Coordinates acceleration = raw_accelerations();
    std::array<double, 3> sum{};
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      for(int d = 0; d < dimension; ++d)
      {
        const double v = velocity[d][i] - given.time_step / 2 * acceleration[d][i];
        sum[d] += v * v;
      }
      for(const std::uint32_t j : rows.row(i))
      {
        const std::array<double, 3> apart = way(i, j);
        const double distance = std::hypot(apart[0], apart[1], apart[2]);
        if(distance > given.force.cutoff)
          continue;
        const double share = given.force.magnitude(distance) / (2 * distance);
        for(int d = 0; d < dimension; ++d)
          sum[d] += share * apart[d] * apart[d];
      }
    }
    return sum;
  }

  std::array<double, 3> Motion::way(std::size_t from, std::size_t to) const
  {
    std::array<double, 3> result{};
    for(int d = 0; d < dimension; ++d)
      result[d] = NearestImage(repetition[d])(position[d][from] - position[d][to]);
    return result;
  }
} // namespace meltfront::particles::greenspan
