#include <cases/capabilities.h>
#include <cases/error.h>
#include <particles/sph/conduction_spectrum.h>
#include <particles/sph/effective_conductivity.h>
#include <particles/sph/heat_flow.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace meltfront::particles
{
  using cases::Effect;

  namespace
  {
    /** Particles below which handing out a pass to threads costs more than it gains. */
    constexpr std::size_t worth_sharing = 8192;

    /** Latent heat that is exchanged at one temperature (J/kg). */
    double sharp_latent_heat(const cases::Material &material)
    {
      return material.curves ? material.curves->jump() : material.latent_heat;
    }

    /** A material that exchanges this alone at fronts. */
    cases::Material at_fronts(cases::Material material)
    {
      material.latent_heat = sharp_latent_heat(material);
      return material;
    }

    /** Whether FrontPlanes finds fronts among these particles and steps. */
    bool follows_lines(const Discretisation &dis, const SphParameters &p)
    {
      constexpr double to_nearest = 2 * (1 + 1e-9); // spacings; none at 2 themselves
      return dis.dimension >= 2 && p.layout == LatticeLayout::cell_centred
             && p.jitter == 0 && p.arrangement < Arrangement::random
             && dis.kernel.support() <= to_nearest * dis.spacing
             && !is_implicit(p.time_scheme);
    }

    /** Whether fronts are lines between a solid and a liquid: matter that is partly
     * melted throughout shows none, nor do the steps of an outline. */
    bool has_sharp_fronts(const cases::Scene &scene)
    {
      return !scene.domain.outline
             && std::ranges::count(cases::front_origins(scene),
                                   cases::FrontOrigin::partly_melted)
                    == 0;
    }

    /** Widest band along a line that is solved for directly: a periodic line's has all
     * of its particles. */
    constexpr std::size_t widest_band = 8;

    std::size_t half_bandwidth_along_line(const Discretisation &dis,
                                          const ParticleOperator &rows)
    {
      if(dis.dimension > 1)
        return 0;
      std::size_t widest = 1;
      for(std::size_t a = 0; a < rows.rows(); ++a)
        rows.visit_row(a, [&](std::size_t b, double)
                       { widest = std::max(widest, a < b ? b - a : a - b); });
      return widest <= widest_band ? widest : 0;
    }
  } // namespace

  FrontRule resolve_front_rule(const Discretisation &dis, const SphParameters &p)
  {
    const bool curves = bool(dis.scene.material.curves);
    const bool lines = follows_lines(dis, p) && !curves;
    if(p.front == FrontRule::automatic)
      return lines && has_sharp_fronts(dis.scene) ? FrontRule::plane
                                                  : FrontRule::sub_particle;
    if(curves && p.front != FrontRule::sub_particle)
      throw cases::Refusal("where properties depend on temperature, or the material "
                           "melts over a range, sph needs front = sub_particle");
    if(p.front == FrontRule::plane && !lines)
      throw cases::Refusal(
          "sph follows fronts as lines or planes (front = plane) in two and three "
          "dimensions, on a lattice (layout = cell, jitter = 0) whose kernel reaches "
          "the nearest particles alone, and with explicit steps");
    return p.front;
  }

  HeatFlow::HeatFlow(const Discretisation &dis, const cases::EffectSet &effects,
                     const SphParameters &parameters, const MassCoordinates *moving)
    : effects(effects)
    , scene(dis.scene)
    , material(scene.material)
    , own(dis.own)
    , n(dis.particles.size())
    , thread_count(n < worth_sharing ? 1 : parameters.threads)
    , conduction(dis, parameters.moment_correction)
    , variable(material, effects)
    , front_rule(resolve_front_rule(dis, parameters))
    , exchange_effect(Effect::phase_conductivity)
  {
    require_true_conductivity(dis, conduction.rows);
    find_own_slices();
    bandwidth = half_bandwidth_along_line(dis, conduction.rows);
    const bool melts_gradually = sharp_latent_heat(material) > 0;
    // Without latent heat no particle melts gradually: fronts lie between particles.
    if(lies_within_particles(front_rule))
    {
      if(effects.contains(Effect::phase_change) && melts_gradually)
        exchange_effect = Effect::phase_change;
      else
        front_rule = FrontRule::partner;
    }
    // The phases conduct differently in mass coordinates if not in space.
    if(moving && !exchange_at_fronts())
      exchange_effect = Effect::liquid_motion;
    // Without a jump u_b - u_a holds whatever u's slope is between the particles.
    if(exchange_at_fronts() && (melts_gradually || !material.curves))
      front_exchange.emplace(at_fronts(material), front_rule, conduction.rows);
    if(front_rule == FrontRule::plane && front_exchange)
      front_exchange->follow_planes(dis);
    if(variable.mapped())
      mapped.resize(padded_size());
    if(effects.contains(Effect::heat_sources))
      heat_sources.emplace(dis);
    if(effects.contains(Effect::moving_source))
      moving_sources.emplace(dis);
    if(effects.contains(Effect::volumetric_source))
      volumetric_source.emplace(dis);
    if(effects.contains(Effect::wall_temperature))
      wall_temperature.emplace(dis, conduction, variable);
    if(effects.contains(Effect::wall_flux))
      wall_flux.emplace(dis, conduction);
    if(effects.contains(Effect::robin_wall) || effects.contains(Effect::radiating_wall))
      wall_exchange.emplace(dis, conduction);
    if(moving)
    {
      liquid_end.emplace(*moving, dis);
      follow_end(static_cast<std::uint32_t>(n - 1));
    }
  }

  /** Processes own whole slices, but for the last particles. */
  void HeatFlow::find_own_slices()
  {
    constexpr std::size_t lanes = ParticleOperator::lanes;
    interactions = conduction.rows.interactions();
    if(!own.shared())
      return;
    interactions = 0;
    for(std::size_t slice = own.begin / lanes; slice * lanes < own.end; ++slice)
    {
      own_slices.push_back(static_cast<std::uint32_t>(slice));
      interactions += conduction.rows.interactions(slice);
    }
  }

  /** Make the last particle's share and its exchange with the wall at the open end those
   * of where the end is. */
  void HeatFlow::follow_end(std::uint32_t previous)
  {
    const std::uint32_t last = liquid_end->last();
    conduction.wall_cells = {{last, liquid_end->share()}};
    if(wall_temperature)
      wall_temperature->relink(previous, last, 1 / liquid_end->depth());
    if(wall_flux)
      wall_flux->relink(previous, last);
    if(wall_exchange)
      wall_exchange->relink(previous, last, liquid_end->depth());
  }

  void HeatFlow::let_liquid_flow(const LiquidBalance &balance, const Discretisation &dis,
                                 std::span<const double> enthalpy, double explicit_step)
  {
    liquid_flow.emplace(balance, dis, enthalpy, explicit_step, thread_count);
  }

  double HeatFlow::displace(double begin, double end, std::span<double> enthalpy)
  {
    if(liquid_flow)
      return liquid_flow->displace(begin, end, enthalpy);
    const std::uint32_t previous = liquid_end->last();
    const double heat = liquid_end->move(enthalpy, begin, end);
    follow_end(previous);
    follow(enthalpy);
    return heat;
  }

  void HeatFlow::prepare_step(double begin, double end)
  {
    if(heat_sources)
      heat_sources->prepare_step(begin, end);
    if(moving_sources)
      moving_sources->prepare_step(begin, end);
    if(volumetric_source)
      volumetric_source->prepare_step(begin, end);
    if(wall_temperature)
      wall_temperature->prepare_step(begin, end);
    if(wall_flux)
      wall_flux->prepare_step(begin, end);
    if(wall_exchange)
      wall_exchange->prepare_step(begin, end);
  }

  double HeatFlow::hold_walls(double fraction, std::span<double> enthalpy)
  {
    return wall_temperature ? wall_temperature->hold(fraction, enthalpy) : 0.;
  }

  void HeatFlow::follow(std::span<const double> enthalpy)
  {
    if(!variable.mapped())
      return;
    extremes = variable.map(enthalpy.first(n), std::span(mapped).first(n), thread_count);
    if(liquid_end)
      liquid_end->hide(mapped);
    // Padding has the phase of its slice, so as not to look like a front.
    std::fill(mapped.begin() + static_cast<std::ptrdiff_t>(n), mapped.end(),
              mapped[n - 1]);
  }

  Extremes HeatFlow::temperatures(std::span<const double> enthalpy) const
  {
    Extremes w
        = variable.mapped() ? extremes : find_extremes(enthalpy.first(n), thread_count);
    if(own.shared())
    {
      std::array<double, 3> most{-w.lowest, w.highest, w.finite ? 0. : 1.};
      own.take_largest(most);
      w = {-most[0], most[1], most[2] == 0};
    }
    return {variable.temperature(w.lowest), variable.temperature(w.highest), w.finite};
  }

  void HeatFlow::conduct(std::span<const double> w, std::span<double> flow) const
  {
    if(!own.shared())
      return conduction.rows.apply(w, flow, thread_count);
    const double *value = w.data();
    conduction.rows.apply_to_slices(
        own_slices, [value](std::size_t a, std::size_t b) { return value[b] - value[a]; },
        flow);
  }

  double HeatFlow::wall_flow(FrontState state, double fraction, std::span<double> flow)
  {
    if(!front_exchange)
      return wall_temperature->add([state](std::size_t row, double wall)
                                   { return wall - state.u[row]; },
                                   fraction, flow);
    return front_exchange->with_pair(state,
                                     [&](const auto &pair)
                                     {
                                       return wall_temperature->add(
                                           [&pair](std::size_t row, double wall)
                                           { return pair.from_wall(row, wall); },
                                           fraction, flow);
                                     });
  }

  double HeatFlow::evaluate(std::span<const double> enthalpy, double fraction,
                            std::span<double> flow)
  {
    const std::span<const double> w = conduction_variable(enthalpy);
    const FrontState state{w.data(), enthalpy.data()};
    conduct(w, flow);
    ++evaluations;
    if(front_exchange)
      front_exchange->apply(conduction.rows, state, flow);
    if(liquid_end)
      liquid_end->correct(front_exchange->with_pair(state,
                                                    [this](const auto &pair) {
                                                      return pair(liquid_end->last(),
                                                                  liquid_end->last() - 1);
                                                    }),
                          flow);
    if(heat_sources)
      heat_sources->add(flow, scale());
    if(moving_sources)
      moving_sources->add(flow, scale());
    if(volumetric_source)
      volumetric_source->add(flow, scale());
    double through_walls = 0;
    if(liquid_flow)
      through_walls += liquid_flow->add(enthalpy, flow);
    if(wall_flux)
      through_walls += wall_flux->add(fraction, flow, scale());
    if(wall_exchange)
      through_walls += wall_exchange->add(fraction, enthalpy, flow, scale());
    if(wall_temperature)
      through_walls += wall_flow(state, fraction, flow);
    conduction.take_per_cell(flow);
    return through_walls;
  }

  double HeatFlow::source_heat(double time) const
  {
    return (heat_sources ? heat_sources->heat(time) : 0.)
           + (volumetric_source ? volumetric_source->heat(time) : 0.);
  }

  StepLimits HeatFlow::step_limits(double particle_mass, StepLimit asked,
                                   std::span<const std::uint32_t> held) const
  {
    StepLimits limits{
        monotone_step(scene, particle_mass, conduction.largest_row_sum,
                      front_exchange ? FrontExchange::largest_factor(front_rule) : 1.)};
    if(asked == StepLimit::stability)
      limits.stable
          = stable_step(scene, particle_mass, largest_eigenvalue(conduction, held));
    return limits;
  }

  std::vector<cases::Parameter> HeatFlow::describe() const
  {
    std::vector<cases::Parameter> result{
        {"interactions per particle",
         fmt::format("{:.4g}", own.total(double(interactions)) / double(own.all)), "1"},
        {"second moment divided out", fmt::format("{:.10g}", conduction.second_moment),
         "1"}};
    if(front_exchange)
      result.push_back({"exchange at fronts",
                        front_rule == FrontRule::plane
                            ? "front as a line or a plane through the particles about it"
                        : front_rule == FrontRule::sub_particle
                            ? "front within the melting particle"
                        : front_rule == FrontRule::partner
                            ? "melting particles conduct as their partners"
                            : "melting particles conduct as the liquid",
                        ""});
    if(liquid_end)
      result.push_back(
          {"displaced liquid", "leaves at x_max; particles move with the matter", ""});
    if(liquid_flow)
      result.push_back({"displaced liquid", "flows past particles that stay", ""});
    return result;
  }

  long HeatFlow::work() const
  {
    std::size_t per_evaluation = interactions;
    if(wall_temperature)
      per_evaluation += wall_temperature->size();
    if(wall_flux)
      per_evaluation += wall_flux->size();
    if(wall_exchange)
      per_evaluation += wall_exchange->size();
    return evaluations * static_cast<long>(per_evaluation)
           + (front_exchange ? front_exchange->work() : 0)
           + (liquid_flow ? liquid_flow->work() : 0);
  }

  std::vector<cases::EffectCost> HeatFlow::effect_costs() const
  {
    std::vector<cases::EffectCost> costs
        = variable.costs(effects, mapped.size() * sizeof(double));
    const auto add = [&costs](const cases::EffectCost &cost)
    {
      for(cases::EffectCost &known : costs)
        if(known.effect == cost.effect)
        {
          known.calls += cost.calls;
          known.bytes += cost.bytes;
          known.seconds += cost.seconds;
          return;
        }
      costs.push_back(cost);
    };
    if(front_exchange)
      add(front_exchange->cost(exchange_effect));
    if(heat_sources)
      add(heat_sources->cost());
    if(moving_sources)
      add(moving_sources->cost());
    if(volumetric_source)
      add(volumetric_source->cost());
    if(effects.contains(Effect::inclusion))
      add(conduction.inclusion_cost);
    if(wall_temperature)
      add(wall_temperature->cost());
    if(wall_flux)
      add(wall_flux->cost());
    if(liquid_end)
      add(liquid_end->cost());
    if(liquid_flow)
      add(liquid_flow->cost());
    for(const Effect effect : {Effect::robin_wall, Effect::radiating_wall})
      if(effects.contains(effect))
        add(wall_exchange->cost(effect));
    return costs;
  }
} // namespace meltfront::particles
