#include <reference_fem/fitted/run.h>

#include <cases/error.h>

#include <deal.II/base/multithread_info.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    constexpr const char *method_name = "fem-fitted";

    /** Elements of higher degree obey no maximum principle: what they may exceed the
     * bounds by, of the bounds' span. */
    constexpr double slack_of_bounds = 0.01;
  } // namespace

  FittedRun::FittedRun(const cases::Scene &scene, const cases::EffectSet &effects,
                       const cases::Resolution &resolution)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , options(scene, resolution)
    , bounds(cases::temperature_bounds(scene))
  {
    // With threads, deal.II rounds sums over vectors differently.
    dealii::MultithreadInfo::set_thread_limit(1);
    const RayScene rays = rays_of(scene, options);
    const InitialFront front = initial_front(scene, rays);
    if(front.coordinate.empty())
      throw cases::Refusal("fem-fitted needs a front to start from; this scene starts in "
                           "one phase");
    problem = std::make_unique<FittedProblem>(
        two_phase_mesh(rays, options.grading),
        physics_of(scene, effects, options, front.solid_inside));
    initial_state
        = problem->state(scene.start_time, front.coordinate,
                         [&](const cases::Position &p)
                         { return scene.initial.temperature(p, scene.start_time); });
    const std::string objection = problem->objection(initial_state);
    if(!objection.empty())
      throw cases::NumericalError(method_name, 0, scene.start_time, "the initial state",
                                  "is impossible: " + objection);
    const HeatContent heat = problem->heat(scene.start_time, initial_state);
    initial_heat = heat.sensible + heat.latent;
    sites = std::make_unique<Sites>(*problem);
  }

  IntegrationOptions FittedRun::integration_options() const
  {
    IntegrationOptions result;
    result.scheme = options.scheme;
    result.tolerance = options.tolerance;
    result.method = method_name;
    result.time
        = [clock = problem->physics().clock](double value) { return clock.time(value); };
    return result;
  }

  double FittedRun::clock_step() const
  {
    const Clock &clock = problem->physics().clock;
    return (clock.clock(scene.end_time) - clock.clock(scene.start_time)) / options.steps;
  }

  void FittedRun::check_temperatures(long step, double time,
                                     const dealii::Vector<double> &u) const
  {
    const RayMesh &mesh = problem->mesh();
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for(unsigned int ray = 0; ray < mesh.surface.n_rays(); ++ray)
      for(unsigned int level = 0; level < mesh.n_levels(); ++level)
      {
        const double r = problem->coordinate(ray, level, u);
        if(level == mesh.front_level() || (r == 0 && problem->physics().power))
          continue;
        const int phase = mesh.has_front() && level > mesh.front_level() ? 1 : 0;
        const double value = problem->physics().melting_temperature
                             + u[mesh.node(ray, level)]
                             + problem->source(phase, time).value(r);
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
    cases::check_temperature(bounds, lowest, highest, method_name, step, time,
                             slack_of_bounds);
  }

  cases::Cost FittedRun::run(cases::Observer &observer)
  {
    const cases::Stopwatch::Seconds setup = watch.elapsed();
    const cases::RunDescription run_description = description();
    observer.begin(run_description);
    watch.restart();
    report(observer, 0, scene.start_time, initial_state, true);

    const Clock &clock = problem->physics().clock;
    const double end = clock.clock(scene.end_time);
    Integrator integrator(*problem, integration_options());
    integrator.start(clock.clock(scene.start_time), initial_state);
    integrator.advance_to(end, clock_step(),
                          [&](const AcceptedStep &step)
                          {
                            const bool last = step.clock == end;
                            const double time
                                = last ? scene.end_time : clock.time(step.clock);
                            check_temperatures(step.number, time, step.u);
                            report(observer, step.number, time, step.u, last);
                            return true;
                          });

    const cases::Stopwatch::Seconds stepping = watch.elapsed();
    const IntegrationCost &integration = integrator.cost();
    cases::Cost cost;
    cost.setup_wall = setup.wall;
    cost.setup_cpu = setup.cpu;
    cost.stepping_wall = stepping.wall;
    cost.stepping_cpu = stepping.cpu;
    cost.steps = integration.steps;
    cost.unknowns = run_description.unknowns;
    cost.work = integration.work;
    cost.solver_iterations = integration.iterations;
    cost.most_iterations = integration.most_iterations;
    cost.effects = effect_costs(integration);
    return cost;
  }
} // namespace meltfront::reference_fem::fitted
