#include <particles/sph/run_report.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace meltfront::particles
{
  cases::RunDescription describe_particles(const Discretisation &dis,
                                           const SphParameters &parameters,
                                           double time_step, long unknowns)
  {
    cases::RunDescription description;
    description.dimension = dis.dimension;
    description.spacing = dis.spacing;
    description.smoothing_length = dis.kernel.smoothing_length();
    description.time_step = time_step;
    description.unknowns = unknowns;
    description.parameters = {
        {"kernel", kernel_names()[static_cast<std::size_t>(parameters.kernel)], ""},
        {"smoothing length / spacing", fmt::format("{:.6g}", parameters.smoothing_length),
         "1"},
        {"layout",
         dis.layout == LatticeLayout::on_edge ? "particles on the edge" : "cell-centred",
         ""}};
    if(dis.stretched())
      description.parameters.push_back(
          {"sides of a cell",
           fmt::format("{:.6g}", fmt::join(dis.cell.begin(),
                                           dis.cell.begin() + dis.dimension, ", ")),
           "m"});
    if(dis.displaced)
      description.parameters.push_back(
          {"jitter", fmt::format("{:.6g}", parameters.jitter), "spacings"});
    if(const Relaxation &done = dis.relaxation; done.sweeps > 0)
      description.parameters.push_back(
          {"relaxation",
           fmt::format("{} sweeps, spread of the second moment from {:.3g} to {:.3g}",
                       done.sweeps, done.spread_before, done.spread_after),
           ""});
    if(const Descent &done = dis.descent; done.iterations > 0)
      description.parameters.push_back(
          {"Lennard-Jones energy",
           fmt::format("from {:.3g} to {:.6g} in {} iterations", done.energy_before,
                       done.energy, done.iterations),
           ""});
    return description;
  }

  cases::RunDescription describe_run(const Discretisation &dis,
                                     const SphParameters &parameters,
                                     const StepPlan &plan, long unknowns,
                                     const std::vector<cases::Parameter> &of_flow)
  {
    cases::RunDescription description
        = describe_particles(dis, parameters, plan.step, unknowns);
    std::vector<cases::Parameter> &list = description.parameters;
    list.push_back({"particles", fmt::format("{}", dis.own.all), "1"});
    list.insert(list.end(), of_flow.begin(), of_flow.end());
    list.push_back(
        {"time scheme", describe_scheme(parameters.time_scheme, plan.stages), ""});
    if(parameters.step_error > 0)
      list.push_back(
          {"wanted error of a step", fmt::format("{:.6g}", parameters.step_error), "1"});
    list.push_back({"largest explicit step that keeps the maximum principle",
                    fmt::format("{:.6g}", plan.limits.monotone), "s"});
    if(plan.limits.stable > 0)
      list.push_back({"linear stability limit of explicit Euler steps",
                      fmt::format("{:.6g}", plan.limits.stable), "s"});
    return description;
  }

  std::string describe_scheme(TimeScheme scheme, int stages)
  {
    switch(scheme)
    {
    case TimeScheme::backward_euler:
      return "backward Euler";
    case TimeScheme::automatic:
      return "RKL2 or two implicit stages";
    case TimeScheme::crank_nicolson:
      return "Crank-Nicolson after two steps of backward Euler";
    default:
      return stages > 1 ? fmt::format("RKL2, {} stages", stages) : "explicit Euler";
    }
  }

  cases::Snapshot particle_snapshot(const Discretisation &dis, long step, double time,
                                    std::span<const double> temperature,
                                    std::span<const double> solid_fraction)
  {
    cases::Snapshot snapshot;
    snapshot.step = step;
    snapshot.time = time;
    snapshot.dimension = dis.dimension;
    for(int d = 0; d < dis.dimension; ++d)
      snapshot.positions[d]
          = dis.own.part(std::span<const double>(dis.particles.position[d]));
    snapshot.weights = dis.own.part(std::span<const double>(dis.weights));
    snapshot.temperature = dis.own.part(temperature);
    snapshot.solid_fraction = dis.own.part(solid_fraction);
    return snapshot;
  }
} // namespace meltfront::particles
