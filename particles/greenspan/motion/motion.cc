#include <cases/error.h>
#include <particles/core/particle_storage.h>
#include <particles/greenspan/motion/motion.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::particles::greenspan
{
  namespace
  {
    /** From here on particles are kept in the order of a curve through space. */
    constexpr std::size_t worth_sorting = 2000;

    /** They are sorted again each time that many lists were made. */
    constexpr long builds_between_sorts = 10;

    /** Share of a bond's length that a particle may move in one step. */
    constexpr double longest_move = 0.1;

    /** Share of a bond's length within which two places are the same. */
    constexpr double same_place = 1e-3;

    /** Coordinates beyond it are as wrong as those that are not finite. */
    constexpr double end_of_space = 1e6;

    void permute(std::vector<double> &values, std::span<const std::uint32_t> order)
    {
      std::vector<double> sorted(values);
      for(std::size_t i = 0; i < order.size(); ++i)
        sorted[i] = values[order[i]];
      values.swap(sorted);
    }
  } // namespace

  Motion::Motion(const MotionParameters &parameters, const ParticleState &start)
    : given(parameters)
    , dimension(start.dimension)
    , repetition(start.period)
    , steps_taken(start.step)
  {
    if(dimension != 2 && dimension != 3)
      throw cases::InputError(
          fmt::format("particle solids live in 2 or 3 dimensions, not in {}", dimension));
    given.validate(dimension);
    check_start(start);
    forces = make_force_sweep(given.force, dimension, repetition);
    furthest_in_a_step = longest_move * given.force.equilibrium_distance();
    all_bonds = (dimension == 3 ? 6. : 3.) * static_cast<double>(start.size())
                * given.force.bond_work();
    load(start);
    check_boundaries();
    heat_of_zones.assign(given.zones.size(), 0);
    if(names.size() >= worth_sorting)
    {
      ParticleStorage storage{dimension, start.position};
      reorder(order_along_curve(storage, given.force.cutoff));
    }
    build_lists();
    require_distinct_places();
    find_pushed_particles();
    if(!start.staggered)
    {
      forces->kick(rows, position, velocity, {given.time_step / 2, given.gravity, 1},
                   given.threads);
      push(given.time_step / 2);
    }
  }

  void Motion::check_start(const ParticleState &start) const
  {
    const std::size_t n = start.size();
    if(n == 0)
      throw cases::InputError("a particle solid needs one particle at least");
    if(given.temperatures && start.step > 0 && start.kinetic_sum.size() != n)
      throw cases::InputError("a run that keeps temperatures cannot go on from a state "
                              "that lacks their sums");
    for(int d = 0; d < dimension; ++d)
    {
      if(start.position[d].size() != n || start.velocity[d].size() != n)
        throw cases::InputError(
            fmt::format("{} particles have {} coordinates and {} velocities in direction "
                        "{}; there must be as many of each",
                        n, start.position[d].size(), start.velocity[d].size(), d));
      for(std::size_t i = 0; i < n; ++i)
        if(!(std::abs(start.position[d][i]) < end_of_space
             && std::isfinite(start.velocity[d][i])))
          throw cases::InputError(fmt::format(
              "particle {} has the coordinate {} and the velocity {} in direction {}; "
              "they must be finite, the coordinate within {:g}",
              i + 1, start.position[d][i], start.velocity[d][i], d, end_of_space));
    }
    if(given.base)
      for(std::size_t i = 0; i < n; ++i)
        if(start.position[1][i] < 0)
          throw cases::InputError(
              fmt::format("particle {} lies at y = {:.6g}, below the base y = 0", i + 1,
                          start.position[1][i]));
  }

  void Motion::require_distinct_places() const
  {
    const double least = same_place * given.force.equilibrium_distance();
    const auto distance_to_source = [this](std::size_t i)
    {
      double squared = 0;
      for(int d = 0; d < dimension; ++d)
        squared += (position[d][i] - given.source->position[d])
                   * (position[d][i] - given.source->position[d]);
      return std::sqrt(squared);
    };
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      for(const std::uint32_t j : rows.row(i))
      {
        const std::array<double, 3> apart = way(i, j);
        if(std::hypot(apart[0], apart[1], apart[2]) < least)
          throw cases::InputError(fmt::format(
              "particles {} and {} lie at the same place ({:.6g}, {:.6g})",
              std::min(names[i], names[j]) + 1, std::max(names[i], names[j]) + 1,
              position[0][i], position[1][i]));
      }
      if(given.source && distance_to_source(i) < least)
        throw cases::InputError(
            fmt::format("the heat source lies inside particle {}", names[i] + 1));
    }
  }

  void Motion::load(const ParticleState &start)
  {
    const std::size_t n = start.size(), all = padded(n);
    names.resize(n);
    std::iota(names.begin(), names.end(), 0);
    for(int d = 0; d < dimension; ++d)
    {
      position[d] = start.position[d];
      for(std::size_t i = n; i < all; ++i)
        position[d].push_back(lone_coordinate(i - n));
      velocity[d] = start.velocity[d];
      velocity[d].resize(all, 0);
    }
    for(int d = 0; d < dimension; ++d)
      for(const double v : velocity[d])
        kinetic_before += v * v / 2;
    if(given.temperatures)
    {
      kinetic_sum = start.step > 0 ? start.kinetic_sum : std::vector<double>(n, 0);
      kinetic_sum.resize(all, 0);
    }
  }

  void Motion::reorder(std::span<const std::uint32_t> order)
  {
    for(int d = 0; d < dimension; ++d)
    {
      permute(position[d], order);
      permute(velocity[d], order);
    }
    if(!kinetic_sum.empty())
      permute(kinetic_sum, order);
    std::vector<std::uint32_t> sorted(names.size());
    for(std::size_t i = 0; i < order.size(); ++i)
      sorted[i] = names[order[i]];
    names.swap(sorted);
  }

  void Motion::build_lists()
  {
    const std::size_t n = names.size();
    if(n >= worth_sorting && builds % builds_between_sorts == builds_between_sorts - 1)
    {
      ParticleStorage storage{dimension, {}};
      for(int d = 0; d < dimension; ++d)
        storage.position[d].assign(position[d].begin(), position[d].begin() + n);
      reorder(order_along_curve(storage, given.force.cutoff));
    }
    for(int d = 0; d < dimension; ++d)
      for(std::size_t i = n; i < position[d].size(); ++i)
        position[d][i] = lone_coordinate(i - n);
    rows.build(dimension, position, names, given.force.cutoff + given.skin, given.search,
               repetition);
    find_pushed_particles();
    listed = position;
    travelled = 0;
    ++builds;
  }

  /** Look how far particles really are from where they were listed, and make new lists
   * where that is too far. */
  void Motion::update_lists()
  {
    double furthest = 0;
    for(std::size_t i = 0; i < names.size(); ++i)
    {
      double squared = 0;
      for(int d = 0; d < dimension; ++d)
      {
        const double moved = position[d][i] - listed[d][i];
        squared += moved * moved;
      }
      furthest = std::max(furthest, squared);
    }
    travelled = std::sqrt(furthest);
    if(2 * travelled > 0.8 * given.skin)
      build_lists();
  }

  void Motion::advance(long steps)
  {
    for(long s = 0; s < steps; ++s)
      take_step();
  }

  void Motion::take_step()
  {
    ++steps_taken;
    move();
    if(given.radiation && steps_taken % given.radiation->interval == 0)
      light_meter.measure([this] { irradiate(); });
    if(2 * travelled > given.skin)
      update_lists();
    const double left = std::exp(-given.drag * given.time_step);
    forces->kick(rows, position, velocity, {given.time_step, given.gravity, left},
                 given.threads);
    push(given.time_step);
    if(given.thermostat)
      exchange_with_bath();
    if(!given.zones.empty())
      zone_meter.measure([this] { exchange_with_zones(); });
  }

  void Motion::set_thermostat(const std::optional<Thermostat> &thermostat)
  {
    given.thermostat = thermostat;
    given.validate(dimension);
  }

  void Motion::set_zones(const std::vector<BathZone> &zones)
  {
    given.zones = zones;
    given.validate(dimension);
    heat_of_zones.assign(zones.size(), 0);
  }

  ParticleState Motion::state() const
  {
    ParticleState result;
    result.dimension = dimension;
    result.step = steps_taken;
    result.staggered = true;
    result.period = repetition;
    const auto given_order = [this](const std::vector<double> &values)
    {
      std::vector<double> ordered(names.size());
      for(std::size_t i = 0; i < names.size(); ++i)
        ordered[names[i]] = values[i];
      return ordered;
    };
    for(int d = 0; d < dimension; ++d)
    {
      result.position[d] = given_order(position[d]);
      result.velocity[d] = given_order(velocity[d]);
    }
    if(!kinetic_sum.empty())
      result.kinetic_sum = given_order(kinetic_sum);
    return result;
  }

  Coordinates Motion::raw_accelerations() const
  {
    Coordinates result;
    for(int d = 0; d < dimension; ++d)
      result[d].assign(position[d].size(), 0);
    forces->kick(rows, position, result, {1, given.gravity, 1}, given.threads);
    for(const std::uint32_t i : pushed)
      result[0][i] -= given.piston->force;
    return result;
  }

  Coordinates Motion::accelerations() const
  {
    const Coordinates raw = raw_accelerations();
    Coordinates result;
    for(int d = 0; d < dimension; ++d)
    {
      result[d].resize(names.size());
      for(std::size_t i = 0; i < names.size(); ++i)
        result[d][names[i]] = raw[d][i];
    }
    return result;
  }

  void Motion::fail(const std::string &quantity, const std::string &problem) const
  {
    throw cases::NumericalError("greenspan", steps_taken, time(), quantity, problem);
  }
} // namespace meltfront::particles::greenspan
