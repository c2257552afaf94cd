#include <cases/temperature_slack.h>
#include <particles/sph_two_population/two_population_stepper.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    /** So many first steps of Crank-Nicolson are replaced by backward Euler, which damps
     * what a discontinuous start excites (Rannacher 1984). */
    constexpr long damped_steps = 2;
  } // namespace

  TwoPopulationStepper::TwoPopulationStepper(const TwoPopulationParameters &parameters,
                                             const StepPlan &plan,
                                             const cases::TemperatureBounds &bounds,
                                             TwoPopulationFlow &flows, Sites &sites)
    : plan(plan)
    , scheme(parameters.sph.time_scheme)
    , bounds(bounds)
    , flows(flows)
    , sites(sites)
  {
    const std::size_t size = sites.liquid.mass.size();
    for(auto *array : {&to_liquid, &to_ice})
      array->resize(size);
    if(flows.diffuses())
      solute_flow.resize(size);
    if(is_implicit(scheme))
    {
      implicit.emplace(flows, sites);
      this->plan.euler_substeps = std::max(
          1, static_cast<int>(std::ceil(plan.step / plan.limits.monotone * (1 - 1e-12))));
    }
    else if(plan.stages > 1)
      super_scheme.emplace(plan, sites.n_fields() * size, sites.n_fields() * size, 1);
    if(implicit || super_scheme)
      state.resize(sites.n_fields() * size);
  }

  double TwoPopulationStepper::advance(long step, double begin, double end)
  {
    flows.prepare_step(begin, end);
    if(!implicit && (!super_scheme || step <= plan.resolved_steps))
      return take_euler_steps(begin, end, plan.euler_substeps);
    double wall_heat = 0;
    bool done = true;
    if(implicit)
      done = take_implicit_step(step, begin, end, wall_heat);
    else
      wall_heat = take_super_step(end - begin);
    flows.hold_walls(1);
    if(done && !breaks_bounds())
      return wall_heat;
    if(super_scheme)
      super_scheme->restore(state);
    sites.load(state);
    flows.prepare_step(begin, end);
    flows.hold_walls(0);
    ++repeated;
    return take_euler_steps(begin, end, plan.euler_substeps);
  }

  double TwoPopulationStepper::take_euler_steps(double begin, double end, int steps)
  {
    const double duration = (end - begin) / steps;
    double wall_heat = 0;
    for(int i = 0; i < steps; ++i)
    {
      wall_heat += duration * flows.heat(double(i) / steps, to_liquid, to_ice);
      diffuse(duration);
      sites.add_heat(to_liquid, to_ice, duration);
      sites.change_phase();
      flows.hold_walls(double(i + 1) / steps);
    }
    return wall_heat;
  }

  void TwoPopulationStepper::diffuse(double duration)
  {
    if(!flows.diffuses())
      return;
    flows.follow();
    for(std::size_t s = 0; s < sites.concentration.size(); ++s)
    {
      flows.solute(s, solute_flow);
      sites.add_solute(s, solute_flow, duration);
    }
  }

  double TwoPopulationStepper::evaluate(double fraction, std::vector<double> &rates)
  {
    const std::size_t size = to_liquid.size();
    const std::span<double> all(rates);
    const double walls
        = flows.heat(fraction, all.subspan(size, size), all.subspan(3 * size, size));
    if(flows.diffuses())
      flows.follow();
    for(std::size_t s = 0; s < sites.concentration.size(); ++s)
    {
      const std::span<double> solute = all.subspan((4 + s) * size, size);
      if(flows.diffuses())
        flows.solute(s, solute);
      else
        std::fill(solute.begin(), solute.end(), 0.);
    }
    sites.make_rates(rates);
    return walls;
  }

  double TwoPopulationStepper::take_super_step(double duration)
  {
    sites.store(state);
    const double wall_heat = super_scheme->take_super_step(
        state, duration, 1., 1.,
        [this]
        {
          sites.load(state);
          sites.store(state);
        },
        [this](double fraction, std::vector<double> &rates)
        { return evaluate(fraction, rates); });
    sites.load(state);
    return wall_heat;
  }

  bool TwoPopulationStepper::take_implicit_step(long step, double begin, double end,
                                                double &wall_heat)
  {
    sites.store(state);
    const double duration = end - begin;
    if(flows.diffuses())
    {
      const int substeps
          = std::max(1, static_cast<int>(std::ceil(duration / flows.solute_step())));
      for(int i = 0; i < substeps; ++i)
      {
        diffuse(duration / substeps);
        sites.change_phase();
      }
    }
    if(scheme == TimeScheme::crank_nicolson && step > damped_steps)
      return implicit->take_step(duration, 0.5, 0., 1., wall_heat);
    if(scheme == TimeScheme::backward_euler)
      return implicit->take_step(duration, 1., 0., 1., wall_heat);
    return implicit->take_step(0.5 * duration, 1., 0., 0.5, wall_heat)
           && implicit->take_step(0.5 * duration, 1., 0.5, 1., wall_heat);
  }

  bool TwoPopulationStepper::breaks_bounds() const
  {
    const double slack = 0.5 * cases::temperature_slack(bounds, 1e-9);
    const double lowest = bounds.lower - slack, highest = bounds.upper + slack;
    for(const Population *population : {&sites.liquid, &sites.ice})
      for(std::size_t a = 0; a < sites.is_dirichlet.size(); ++a)
      {
        const double value = flows.melting_temperature() + population->excess[a];
        if(!(value >= lowest && value <= highest))
          return true;
      }
    for(const auto &solute : sites.concentration)
      for(const double c : solute)
        if(!(c >= 0))
          return true;
    return sites.beyond_liquidus().has_value();
  }
} // namespace meltfront::particles
