#include <cases/error.h>
#include <particles/sph/liquid_flow.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meltfront::particles
{
  using cases::Boundary, cases::BoundaryKind;

  namespace
  {
    /** What may be left over of a step's volumes, of all volume. */
    constexpr double volume_tolerance = 1e-14;
    /** What an enclosed particle may fail to displace, of its own volume. */
    constexpr double enclosed_tolerance = 1e-12;

    /** The laws of the potential: nothing passes a wall but through the outlet, where it
     * is zero. */
    const Boundary closed{};
    const Boundary opened{.kind = BoundaryKind::fixed_temperature,
                          .value = cases::Field::uniform(0)};

    /** The same particles between walls with these laws. */
    Discretisation for_potential(const Discretisation &dis, cases::Side outlet)
    {
      Discretisation result = dis;
      const Boundary *open = &dis.scene.boundary(outlet);
      result.ghosts = {dis.dimension, {}};
      for(PlaneWall &wall : result.walls)
        wall.boundary = wall.boundary == open ? &opened : &closed;
      for(RoundWall &wall : result.round_walls)
      {
        const bool is_open = wall.boundary == open;
        if(is_open)
          dis.add_points_beyond(wall, result.ghosts);
        wall.boundary = is_open ? &opened : &closed;
      }
      return result;
    }

    /** What liquid carries into the first particle of a pair. */
    struct CarryingPair
    {
      double operator()(std::size_t a, std::size_t b) const
      {
        return liquid[a] * liquid[b] * (potential[b] - potential[a])
               * (0.5 * (carried[a] + carried[b]));
      }

      const double *liquid;
      const double *potential;
      const double *carried;
    };
  } // namespace

  LiquidFlow::LiquidFlow(const LiquidBalance &balance, const Discretisation &dis,
                         std::span<const double> enthalpy, int threads)
    : balance(balance)
    , material(balance.at_rest.material)
    , thread_count(threads)
    , spacing(dis.spacing)
    , cross_section(dis.cross_section)
    , conduction(for_potential(dis, balance.outlet), true)
    , outlet(balance, dis, conduction)
    , solver(conduction.rows, outlet.strengths(conduction.rows.padded_rows()), threads)
    , volume(dis.weights)
    , due(dis.particles.size(), 0.)
  {
    for(double &part : volume)
      part *= cross_section;
    total_volume = std::accumulate(volume.begin(), volume.end(), 0.);
    for(auto *array : {&liquid, &potential, &carried, &passed})
      array->resize(conduction.rows.padded_rows(), 0.);
    for(std::size_t a = 0; a < volume.size(); ++a)
      fraction.push_back(material.solid_fraction(enthalpy[a]));
  }

  double LiquidFlow::add(std::span<const double> enthalpy, std::span<double> flow)
  {
    if(duration == 0)
      return 0;
    return meter.measure(
        [&]
        {
          ++evaluations;
          const double density = material.solid.density, latent = material.latent_heat;
          for(std::size_t a = 0; a < volume.size(); ++a)
            carried[a] = density * std::max(enthalpy[a] - latent, 0.);
          conduction.rows.apply_pairs(
              CarryingPair{liquid.data(), potential.data(), carried.data()}, passed,
              thread_count);
          double through_outlet = 0;
          for(const LiquidOutlet::Opening &opening : outlet.openings())
          {
            const std::uint32_t a = opening.particle;
            const double heat = -liquid[a] * opening.strength * potential[a]
                                * opening.sensible_heat(carried[a]);
            passed[a] += heat;
            through_outlet += heat;
          }
          for(std::size_t a = 0; a < volume.size(); ++a)
            flow[a] += passed[a] / duration;
          return through_outlet / duration;
        });
  }

  /** What has changed phase since the last step; particles that held liquid before or
   * after it let pass. */
  void LiquidFlow::free_volumes(std::span<const double> enthalpy)
  {
    for(std::size_t a = 0; a < volume.size(); ++a)
    {
      const double now = material.solid_fraction(enthalpy[a]);
      liquid[a] = std::min(now, fraction[a]) < 1;
      due[a] += balance.expansion * volume[a] * (now - fraction[a]);
      fraction[a] = now;
    }
  }

  /** @throws cases::Refusal where something is due that cannot reach the outlet */
  void LiquidFlow::leave_out_enclosed(double time)
  {
    std::vector<std::uint32_t> reached;
    std::vector<bool> open(volume.size(), false);
    const auto reach = [&](std::uint32_t a)
    {
      if(liquid[a] == 0 || open[a])
        return;
      open[a] = true;
      reached.push_back(a);
    };
    for(const LiquidOutlet::Opening &opening : outlet.openings())
      reach(opening.particle);
    for(std::size_t i = 0; i < reached.size(); ++i)
      conduction.rows.visit_row(reached[i], [&](std::uint32_t b, double) { reach(b); });
    for(std::size_t a = 0; a < volume.size(); ++a)
    {
      if(liquid[a] == 0 || open[a])
        continue;
      if(std::abs(due[a]) > enclosed_tolerance * volume[a])
        throw cases::Refusal(fmt::format(
            "sph moves liquid that has a way to {}: at t = {:.6g} s solid and walls "
            "enclose liquid that has {:.3g} of a particle's volume to {}",
            cases::to_string(balance.outlet), time, std::abs(due[a]) / volume[a],
            due[a] > 0 ? "displace" : "draw in"));
      liquid[a] = 0;
    }
  }

  /** Means of two particles' heat keep the maximum principle as long as a pair conducts
   * at least half of what it carries. */
  void LiquidFlow::require_slow(double time) const
  {
    const double most = 2 * duration * material.liquid.conductivity
                        / material.liquid.volumetric_heat_capacity();
    const auto [low, high] = std::ranges::minmax(potential);
    if(high - low <= most)
      return;
    double largest = 0;
    for(std::size_t a = 0; a < volume.size(); ++a)
      conduction.rows.visit_row(a,
                                [&](std::uint32_t b, double) {
                                  largest = std::max(largest,
                                                     liquid[a] * liquid[b]
                                                         * (potential[a] - potential[b]));
                                });
    if(largest > most)
      throw cases::Refusal(
          fmt::format("sph moves liquid where heat spreads at least as fast as the "
                      "liquid: at t = {:.6g} s it flows {:.3g} times too fast for "
                      "particles {:.3g} m apart; more of them, or a smaller jump of the "
                      "density, would do",
                      time, largest / most, spacing));
  }

  double LiquidFlow::displace(double begin, double end, std::span<const double> enthalpy)
  {
    return meter.measure(
        [&]
        {
          ++steps;
          free_volumes(enthalpy);
          if(duration == 0 && std::ranges::all_of(due, [](double x) { return x == 0; }))
            return 0.;
          leave_out_enclosed(end);
          const double longer = duration > 0 ? (end - begin) / duration : 0;
          for(std::size_t a = 0; a < volume.size(); ++a)
            potential[a] *= longer * liquid[a];
          duration = end - begin;
          if(!solver.solve(liquid, due, potential, volume_tolerance * total_volume))
            throw cases::NumericalError("sph", steps, end, "the displaced liquid",
                                        "finds no way out to round-off");
          require_slow(end);
          outlet.follow(end, enthalpy);
          return leave();
        });
  }

  double LiquidFlow::leave()
  {
    double volume_out = 0;
    for(const LiquidOutlet::Opening &opening : outlet.openings())
      volume_out
          += liquid[opening.particle] * opening.strength * potential[opening.particle];
    left.add(volume_out);
    return -volume_out / cross_section * balance.density * material.latent_heat;
  }

  double LiquidFlow::mass() const
  {
    cases::CompensatedSum sum;
    const double solid = material.solid.density;
    for(std::size_t a = 0; a < volume.size(); ++a)
      sum.add(volume[a] * (fraction[a] * solid + (1 - fraction[a]) * balance.density));
    sum.add(balance.density * left.value());
    return sum.value() / cross_section;
  }

  cases::EffectCost LiquidFlow::cost() const
  {
    const std::size_t doubles = volume.size() + fraction.size() + due.size()
                                + liquid.size() + potential.size() + carried.size()
                                + passed.size();
    return meter.cost(cases::Effect::liquid_motion,
                      doubles * sizeof(double) + conduction.rows.bytes() + solver.bytes()
                          + outlet.openings().size() * sizeof(LiquidOutlet::Opening));
  }

  long LiquidFlow::work() const
  {
    return (evaluations + solver.iterations())
           * static_cast<long>(conduction.rows.interactions());
  }
} // namespace meltfront::particles
