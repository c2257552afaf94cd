#include <cases/error.h>
#include <particles/sph/liquid_flow.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meltfront::particles
{
  using cases::Boundary, cases::BoundaryKind;

  namespace
  {
    /** What may be left over of a step's volumes, of all volume. */
    constexpr double volume_tolerance = 1e-14;
    /** Of what a pair conducts: as much as it may carry by the mean of both particles'
     * heat and keep the maximum principle. At a front, where melting particles draw less
     * than their temperature would, it is about half. */
    constexpr double conducted = 0.5;
    /** What an enclosed particle may fail to displace, of all volume. */
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
        const double way = liquid[a] * liquid[b] * (potential[b] - potential[a]);
        const double upwind = std::max(0.5 * std::abs(way) - conducted * spread, 0.);
        return way * (0.5 * (carried[a] + carried[b]))
               + upwind * (carried[b] - carried[a]);
      }

      const double *liquid;
      const double *potential;
      const double *carried;
      double spread; ///< diffusivity of the liquid times the step
    };
  } // namespace

  LiquidFlow::LiquidFlow(const LiquidBalance &balance, const Discretisation &dis,
                         std::span<const double> enthalpy, double explicit_step,
                         int threads)
    : balance(balance)
    , material(balance.at_rest.material)
    , thread_count(threads)
    , cross_section(dis.cross_section)
    , explicit_step(explicit_step)
    , conduction(for_potential(dis, balance.outlet), true)
    , outlet(balance, dis, conduction)
    , solver(conduction.rows, outlet.strengths(conduction.rows.padded_rows()),
             dis.dimension, threads)
    , enclosed(conduction.rows, outlet.particles())
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
          const double spread = duration * material.liquid.diffusivity();
          for(std::size_t a = 0; a < volume.size(); ++a)
            carried[a] = density * std::max(enthalpy[a] - latent, 0.);
          conduction.rows.apply_pairs(
              CarryingPair{liquid.data(), potential.data(), carried.data(), spread},
              passed, thread_count);
          double through_outlet = 0;
          for(const LiquidOutlet::Opening &opening : outlet.openings())
          {
            const std::uint32_t a = opening.particle;
            const double passing = opening.sensible_heat(carried[a]);
            const double upwind = std::max(potential[a] - conducted * spread, 0.);
            const double heat
                = -liquid[a] * opening.strength
                  * (potential[a] * passing + upwind * (carried[a] - passing));
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

  void LiquidFlow::settle_enclosed(double time)
  {
    const EnclosedLiquid::Outcome outcome
        = enclosed.settle(std::span(liquid).first(volume.size()), due);
    if(outcome.stuck > enclosed_tolerance * total_volume)
      throw cases::Refusal(fmt::format("sph moves liquid that has a way to {}: at t = "
                                       "{:.6g} s solid and walls enclose "
                                       "liquid that has to make room",
                                       cases::to_string(balance.outlet), time));
    straight_out = outcome.straight_out;
  }

  /** New temperatures of liquid are convex combinations of old ones as long as a step
   * does not exchange more than there is. */
  void LiquidFlow::require_short_steps(double time) const
  {
    const double spread = duration * material.liquid.diffusivity();
    const auto [low, high] = std::ranges::minmax(potential);
    if(high - low <= 2 * conducted * spread)
      return;
    std::vector<double> exchanged(volume.size(), 0.);
    for(const LiquidOutlet::Opening &opening : outlet.openings())
      exchanged[opening.particle]
          = opening.strength * (spread + std::max(-potential[opening.particle], 0.));
    double most = 0;
    for(std::size_t a = 0; a < volume.size(); ++a)
    {
      if(liquid[a] == 0)
        continue;
      double sum = exchanged[a];
      conduction.rows.visit_row(
          a,
          [&](std::uint32_t b, double g)
          {
            const double way = liquid[b] * (potential[b] - potential[a]);
            sum += g
                   * (spread + 0.5 * way
                      + std::max(0.5 * std::abs(way) - conducted * spread, 0.));
          });
      most = std::max(most, sum / volume[a]);
    }
    most *= explicit_step / duration;
    if(most > 1)
      throw cases::Refusal(fmt::format("sph moves liquid in explicit steps that exchange "
                                       "no more than there is: at t = "
                                       "{:.6g} s it flows {:.3g} times too fast for "
                                       "that; {:.3g} times the step_factor "
                                       "would do, or more particles",
                                       time, most, 0.9 / most));
  }

  void LiquidFlow::solve(double time)
  {
    if(!solver.solve(liquid, due, potential, volume_tolerance * total_volume))
      throw cases::NumericalError("sph", steps, time, "the displaced liquid",
                                  "finds no way out to round-off");
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
          settle_enclosed(end);
          const double longer = duration > 0 ? (end - begin) / duration : 0;
          for(std::size_t a = 0; a < volume.size(); ++a)
            potential[a] *= longer * liquid[a];
          duration = end - begin;
          solve(end);
          require_short_steps(end);
          outlet.follow(end, enthalpy);
          return leave();
        });
  }

  double LiquidFlow::leave()
  {
    double volume_out = std::exchange(straight_out, 0.);
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
