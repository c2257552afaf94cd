#include <cases/error.h>
#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/alloy_solver.h>
#include <reference_fem/enthalpy/liquidus.h>
#include <reference_fem/enthalpy/sum_over.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  using cases::Effect;

  namespace
  {
    /** Passes after which a step is given up and halved. */
    constexpr int most_passes = 40;

    /** Passes that the concentrations to start the next from are combined of. */
    constexpr int mixing_depth = 5;

    /** Less liquid than this share of a node's mass is round-off. */
    constexpr double least_liquid = 1e-14;

    template <typename Value>
    long bytes_of(const std::vector<Value> &values)
    {
      return static_cast<long>(values.size() * sizeof(Value));
    }

    double extrapolate(const StepFormula &step, double now, double before)
    {
      return step.now > step.before
                 ? now
                       + (step.next - step.now) / (step.now - step.before)
                             * (now - before)
                 : now;
    }
  } // namespace

  bool holds_solute(const cases::Scene &scene, const cases::EffectSet &effects)
  {
    if(!effects.contains(Effect::solute) || !scene.alloy)
      return false;
    for(std::size_t s = 0; s < scene.alloy->solutes.size(); ++s)
      if(cases::initially_present(scene, s))
        return true;
    return false;
  }

  AlloySolver::AlloySolver(const cases::Scene &scene, const cases::EffectSet &effects,
                           const Discretisation &mesh, const std::vector<char> &free,
                           WallExchange *exchange,
                           const LinearSolverMaker &make_linear_solver)
    : scene(scene)
    , mesh(mesh)
    , free(free)
    , graph(scene.material, *scene.alloy)
    , density(scene.material.solid.density)
    , composition(mesh.volume.size())
  {
    const std::size_t n = mesh.volume.size();
    if(!(scene.material.latent_heat > 0))
      throw cases::Refusal("fem-enthalpy simulates solutes only together with the latent "
                           "heat of their solvent");
    {
      const cases::ScopedTimer timer(solute_cost.seconds);
      place_solutes();
      mix();
      solute_cost.bytes = bytes_of(composition);
      for(const Substance &substance : substances)
        solute_cost.bytes
            += bytes_of(substance.now) + bytes_of(substance.before)
               + bytes_of(substance.next)
               + static_cast<long>(mesh.node_of_site.size() * sizeof(double));
    }
    if(effects.contains(Effect::phase_conductivity))
      conduction.emplace(mesh.conduction, scene.material, *scene.alloy, composition);
    else
    {
      uniform_conduction = mesh.conduction;
      uniform_conduction.weigh(mesh.conduction,
                               [k = scene.material.solid.conductivity](
                                   std::size_t, std::size_t) { return k; });
    }
    if(std::any_of(substances.begin(), substances.end(),
                   [](const Substance &s) { return s.diffuses(); }))
    {
      diffusion.emplace(mesh, density, make_linear_solver);
      liquid.resize(n);
      supply.resize(n);
      fixed.resize(n);
      const auto diffusing
          = std::count_if(substances.begin(), substances.end(),
                          [](const Substance &s) { return s.diffuses(); });
      const auto unknowns = static_cast<Eigen::Index>(n) * diffusing;
      mixing.emplace(unknowns, mixing_depth);
      used.resize(unknowns);
      found.resize(unknowns);
    }
    linear_solver = make_linear_solver(conduction_matrix());
    newton = make_mush_solver({conduction_matrix(), mesh.volume, free, exchange}, graph,
                              composition, *linear_solver);
  }

  /** The concentrations at the start of the solutes of which there are some. */
  void AlloySolver::place_solutes()
  {
    const cases::Alloy &alloy = *scene.alloy;
    for(std::size_t s = 0; s < alloy.solutes.size(); ++s)
    {
      if(!cases::initially_present(scene, s))
        continue;
      const cases::Solute &solute = alloy.solutes[s];
      const double weight = graph.straight() ? solute.liquidus_slope : 1;
      substances.push_back({s, weight, solute.diffusivity, {}, {}, {}, 0, {}});
      Substance &substance = substances.back();
      for(const cases::Position &position : mesh.positions)
      {
        const double value = scene.initial.concentration[s](position, scene.start_time);
        if(!(value >= 0 && value < 1))
          throw cases::InputError(fmt::format(
              "the concentration of {} at ({:.6g}, {:.6g}, {:.6g}) is {}; it must be at "
              "least 0 and less than 1",
              solute.name, position[0], position[1], position[2], value));
        substance.now.push_back(value);
      }
      if(substance.diffuses())
        substance.before = substance.next = substance.now;
      substance.initial_mass = mass_of(substance);
    }
  }

  double AlloySolver::mass_of(const Substance &substance) const
  {
    return density
           * sum_over(mesh.volume, [&](std::size_t i) { return substance.now[i]; });
  }

  void AlloySolver::mix()
  {
    for(std::size_t i = 0; i < composition.size(); ++i)
    {
      double solute = 0;
      for(const Substance &substance : substances)
        solute += substance.weight * std::max(substance.in_use()[i], 0.);
      if(solute == composition[i].solute)
        continue;
      composition[i] = graph.composition(solute);
      if(composition[i].depression < least_depression)
        composition[i] = {0, 0};
    }
  }

  std::vector<double> AlloySolver::initial_enthalpy() const
  {
    std::vector<double> result(mesh.volume.size());
    for(std::size_t i = 0; i < result.size(); ++i)
    {
      const double excess = scene.initial.temperature(mesh.positions[i], scene.start_time)
                            - scene.material.melting_temperature;
      const double solid = graph.lower_enthalpy(excess);
      result[i] = graph.enthalpy(excess, composition[i]);
      if(graph.region(excess, composition[i]) == MushRegion::held)
        result[i] += scene.initial.solid_fraction_at_melting * (solid - result[i]);
    }
    return result;
  }

  void AlloySolver::begin(const StepFormula &formula, const std::vector<double> &enthalpy)
  {
    step = formula;
    last_enthalpy = &enthalpy;
    for(Substance &substance : substances)
      if(substance.diffuses())
        for(std::size_t i = 0; i < substance.next.size(); ++i)
          substance.next[i]
              = std::max(extrapolate(step, substance.now[i], substance.before[i]), 0.);
  }

  double AlloySolver::enthalpy_at(std::size_t node, double excess, double last) const
  {
    const double upper = graph.enthalpy(excess, composition[node]);
    if(graph.region(excess, composition[node]) != MushRegion::held)
      return upper;
    return std::clamp(last, graph.lower_enthalpy(excess), upper);
  }

  cases::PhaseState AlloySolver::state(std::size_t node, double enthalpy) const
  {
    cases::PhaseState result = graph.state(enthalpy, composition[node]);
    result.temperature += scene.material.melting_temperature;
    return result;
  }

  /** The liquid that a pass leaves. */
  void AlloySolver::melt(const CompensatedVector &u, const std::vector<double> &heat)
  {
    for(std::size_t i = 0; i < u.size(); ++i)
    {
      const double enthalpy = free[i] ? heat[i] / mesh.volume[i]
                                      : enthalpy_at(i, u[i], (*last_enthalpy)[i]);
      const double f = graph.state(enthalpy, composition[i]).liquid_fraction;
      liquid[i] = f > least_liquid ? f : 0;
    }
  }

  /** Take the conductances of the temperatures where they have changed, or are the first
   * of a step; returns their largest relative change. */
  double AlloySolver::renew_conduction(const CompensatedVector &u, bool first)
  {
    const double change = conduction->renew(u);
    if(first || change > coupling_tolerance)
    {
      conduction->adopt();
      linear_solver->conductances_changed();
    }
    return change;
  }

  void AlloySolver::gather(Eigen::VectorXd &amounts) const
  {
    Eigen::Index k = 0;
    for(const Substance &substance : substances)
      if(substance.diffuses())
        for(const double value : substance.next)
          amounts[k++] = substance.weight * value;
  }

  /** Solute spreads in the liquid that there is; returns the largest change that it makes
   * to a solute, over the largest amount of solute. */
  double AlloySolver::diffuse(double c)
  {
    gather(used);
    diffusion->set_liquid(liquid);
    for(Substance &substance : substances)
    {
      if(!substance.diffuses())
        continue;
      for(std::size_t i = 0; i < supply.size(); ++i)
      {
        // As an increment: the weights then sum to one to the last digit.
        const double start
            = substance.now[i]
              + step.weight_before * (substance.before[i] - substance.now[i]);
        supply[i] = density * mesh.volume[i] * start;
        const double whole = graph.eutectic_liquid_fraction(composition[i]);
        fixed[i] = liquid[i] < whole ? substance.next[i] * (1 - liquid[i] / whole) : 0;
      }
      diffusion->step(c, substance.diffusivity, supply, fixed, substance.next);
    }
    gather(found);
    mix();
    double largest = 0;
    for(const Composition &node : composition)
      largest = std::max(largest, node.solute);
    return largest > 0 ? (found - used).lpNorm<Eigen::Infinity>() / largest : 0;
  }

  /** Another pass is to come: choose the concentrations that it starts from. */
  void AlloySolver::accelerate()
  {
    mixing->advance(used, found);
    Eigen::Index k = 0;
    for(Substance &substance : substances)
      if(substance.diffuses())
        for(double &value : substance.next)
        {
          value += substance.weight > 0 ? (used[k] - found[k]) / substance.weight : 0;
          ++k;
        }
    mix();
  }

  void AlloySolver::check_known(const CompensatedVector &u) const
  {
    for(std::size_t i = 0; i < u.size(); ++i)
      if(!graph.known(u[i], composition[i]))
        throw cases::InputError(fmt::format("the mush is {:.6g}, colder than the "
                                            "liquidus is known: extend the liquidus or "
                                            "state the eutectic temperature",
                                            scene.material.melting_temperature + u[i]));
  }

  StepOutcome AlloySolver::solve(double c, const std::vector<double> &rhs,
                                 int iteration_limit, CompensatedVector &u,
                                 std::vector<double> &heat)
  {
    StepOutcome result;
    if(diffusion)
    {
      mix();
      mixing->restart();
    }
    if(conduction)
      renew_conduction(u, true);
    for(int pass = 0; pass < most_passes && !result.converged; ++pass)
    {
      const StepOutcome outcome = newton->solve(c, rhs, iteration_limit, u, heat);
      all_iterations += outcome.iterations;
      ++solute_cost.calls;
      result.iterations = std::max(result.iterations, outcome.iterations);
      result.graph_inconsistency = outcome.graph_inconsistency;
      if(!outcome.converged)
        return result;
      double change = 0;
      if(diffusion)
      {
        melt(u, heat);
        change = diffuse(c);
        if(change > coupling_tolerance)
          accelerate();
      }
      if(conduction)
        change = std::max(change, renew_conduction(u, false));
      result.converged = change <= coupling_tolerance;
      result.coupling_defect = change;
    }
    if(result.converged)
      check_known(u);
    return result;
  }

  void AlloySolver::accept()
  {
    for(Substance &substance : substances)
      if(substance.diffuses())
      {
        substance.before.swap(substance.now);
        substance.now = substance.next;
      }
  }
} // namespace meltfront::reference_fem
