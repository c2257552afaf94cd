#include <reference_fem/cut/conservative/conservative_run.h>

#include <cases/error.h>
#include <cases/step_ends.h>
#include <cases/time_integral.h>
#include <reference_fem/cut/conservative/appearance.h>
#include <reference_fem/cut/conservative/initial_front.h>
#include <reference_fem/cut/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    /** Of the two-stage, L-stable method of order 2 (Alexander 1977). */
    constexpr double gamma = 1 - 1 / std::numbers::sqrt2;

    /** Of the longest step: the first one, before the front's speed is known. */
    constexpr double first_step_share = 1. / 8;
    constexpr double largest_growth = 2;

    /** A step that moves the front by more spacings is halved, so many times. */
    constexpr double farthest_move = 0.9;
    constexpr int most_halvings = 8;

    /** So many steps in a row that are halved so often get nowhere: the front of what has
     * appeared runs about in cells that it does not fill. */
    constexpr int hard_halvings = 5, most_hard_steps = 10;

    /** Squares of the spacing: a smaller body is turned into the other phase. Its latent
     * heat goes to the hats about it, which are forty times as large or more: what that
     * undercools or superheats them by is what elements of this size overshoot by anyway.
     */
    constexpr double least_area = 0.1;

    /** Slope of the level set, or its reciprocal, from which on it is restored: a
     * triangle that the front has crossed within a step then still lies in the band. */
    constexpr double steepest = 2;

    /** Of a stage after a jump: the first has the parabolas of before it, the second
     * those of what the first found. */
    constexpr int damped_passes = 3;

    /** Of the run: shorter steps are not made. */
    constexpr double shortest_step = 1e-8;

    RunOptions checked(RunOptions options)
    {
      if(const std::string name = option_of_extension(options); !name.empty())
        throw cases::Refusal(
            fmt::format("fem-cut: scheme = conservative has linear elements on a uniform "
                        "mesh and no option {}: leave it as it stands",
                        name));
      return options;
    }
  } // namespace

  /** Both stages of a step. */
  struct ConservativeRun::Step
  {
    StageResult first, second;
    std::vector<double> powers;
    bool limited = false; ///< a pass was cut
  };

  ConservativeRun::ConservativeRun(const cases::Scene &scene,
                                   const cases::EffectSet &effects,
                                   const cases::Resolution &resolution)
    : scene(scene)
    , effects(effects)
    , resolution(resolution)
    , options(checked(options_for(scene, resolution)))
    , mesh(scene.domain, resolution.n)
    , sources(scene, 1e-3 * mesh.spacing)
    , assembly(scene, mesh, sources,
               {options.stabilisation.penalty, options.stabilisation.ghost})
    , bounds(cases::temperature_bounds(scene))
    , step_ends(cases::step_ends(scene, resolution.n,
                                 (scene.end_time - scene.start_time)
                                     / static_cast<double>(options.fewest_steps)))
    , appearance(mesh, scene, reach_of_distance * mesh.spacing)
    , time(scene.start_time)
  {
    start();
  }

  double ConservativeRun::latent_heat_of_volume() const
  {
    return scene.material.solid.density * scene.material.latent_heat;
  }

  void ConservativeRun::take_steps()
  {
    if(before)
      run_enthalpy();
    else if(step_number > 0)
      report_uniform_start();
    reached(step_number, time);
    while(time < scene.end_time)
    {
      step();
      reached(step_number, time);
    }
  }

  double ConservativeRun::next_step() const
  {
    const double whole = scene.end_time - scene.start_time;
    const double longest = whole / static_cast<double>(options.fewest_steps);
    double step = last_step > 0 ? std::min(longest, largest_growth * last_step)
                                : first_step_share * longest;
    if(damped_steps > 0)
      step = std::max(step, damping_step());
    if(front_speed > 0)
      step = std::min(step, options.cfl * mesh.spacing / front_speed);
    if(!(step > shortest_step * whole))
      throw cases::NumericalError(
          method_name, step_number + 1, time, "front",
          fmt::format("moves at {:.3g} m/s, for which steps would be shorter than {:g} "
                      "of the run",
                      front_speed, shortest_step));
    const double rest = cases::end_of_piece(step_ends, time, scene.end_time) - time;
    if(step >= rest * (1 - 1e-10))
      return rest;
    return step > rest / 2 ? rest / 2 : step;
  }

  /** What a stage from the state on sets out from. */
  StageData ConservativeRun::from_state(const StepFrame &frame, StageTime stage,
                                        double duration) const
  {
    StageData data{std::move(stage),
                   duration,
                   state.heat,
                   state.debt,
                   increment,
                   {temperatures, state.level_set, segments_of(frame.front), powers}};
    for(double &value : data.increment)
      value *= last_step > 0 ? duration / last_step : 0;
    return data;
  }

  StageResult ConservativeRun::solve(const StepFrame &frame, const StageData &data)
  {
    StageResult result = solve_stage(assembly, scene, mesh, frame, data, options.passes);
    solves += result.solves;
    entries += result.entries;
    return result;
  }

  void ConservativeRun::make_stages(const StepFrame &frame, double duration, double end,
                                    Step &step)
  {
    StageData data = from_state(
        frame, {time, time + gamma * duration, sources.powers(time + gamma * duration)},
        gamma * duration);
    step.first = solve(frame, data);
    data.time
        = {time, end, sources.remaining_powers(data.time.powers, 1 - gamma, time, end)};
    step.powers = data.time.powers;
    const double per_area = (1 - gamma) * duration / latent_heat_of_volume();
    for(std::size_t node = 0; node < mesh.nodes.size(); ++node)
    {
      for(std::size_t p = 0; p < 2; ++p)
        data.heat[p][node]
            += (1 - gamma) / gamma * (step.first.heat[p][node] - state.heat[p][node]);
      data.change[node] += per_area * step.first.flux[node];
      data.increment[node] = step.first.increment[node] / gamma;
    }
    data.guess = step.first.guess;
    step.second = solve(frame, data);
    most_solves = std::max(most_solves, step.first.solves + step.second.solves);
  }

  /** Backward Euler's stage in place of both. */
  void ConservativeRun::make_damped_stage(const StepFrame &frame, double duration,
                                          double end, Step &step)
  {
    step.powers = sources.remaining_powers(powers, 0, time, end);
    StageData data = from_state(frame, {time, end, step.powers}, duration);
    data.fewest_passes = damped_passes;
    step.second = solve(frame, data);
    step.first = step.second;
    most_solves = std::max(most_solves, step.second.solves);
  }

  /** @return false if the front moves too far */
  bool ConservativeRun::attempt(double duration, double end, Step &step)
  {
    const StepFrame frame(mesh, state.level_set, Constants().smoothing);
    most_unknowns = std::max(most_unknowns, long(frame.unknowns));
    if(damped_steps > 0)
      make_damped_stage(frame, duration, end, step);
    else
      make_stages(frame, duration, end, step);
    double farthest = 0;
    for(const CutTriangle &cut : frame.front.cut)
      for(const unsigned int node : cut.place->nodes)
        farthest = std::max(farthest, std::abs(step.second.increment[node]));
    front_speed = farthest / duration;
    step.limited = step.first.limited || step.second.limited;
    return farthest <= farthest_move * mesh.spacing;
  }

  void ConservativeRun::step()
  {
    try
    {
      make_step();
    }
    catch(const cases::Refusal &)
    {
      throw;
    }
    catch(const cases::NumericalError &error)
    {
      refuse_if_unresolved(error);
      throw;
    }
    catch(const std::runtime_error &error)
    {
      const cases::NumericalError named(
          method_name, step_number, time, "front",
          fmt::format("cannot be followed: {}", error.what()));
      refuse_if_unresolved(named);
      throw named;
    }
  }

  void ConservativeRun::make_step()
  {
    double duration = next_step();
    const double stop = cases::end_of_piece(step_ends, time, scene.end_time);
    const auto end = [&] { return duration == stop - time ? stop : time + duration; };
    Step step;
    int halvings = 0;
    for(;; ++halvings)
    {
      const bool last_chance = halvings == most_halvings;
      try
      {
        const bool near = attempt(duration, end(), step);
        // However short the step, moves are cut where a debt is due that no area is left
        // for: it stays debt.
        if(near && (last_chance || (!step.limited && !misses_a_phase(step))))
          break;
        if(last_chance)
          throw std::runtime_error(fmt::format(
              "the front moves by more than {} spacings even in a {}th of the "
              "step; what is solid or liquid there is thinner than this n "
              "resolves, take a larger one",
              farthest_move, 1 << most_halvings));
      }
      catch(const cases::Refusal &)
      {
        throw;
      }
      catch(const std::runtime_error &error)
      {
        if(last_chance)
          throw cases::NumericalError(
              method_name, step_number + 1, time + duration, "temperature",
              fmt::format("cannot be solved for: {}", error.what()));
      }
      duration /= 2;
      ++halved_steps;
    }
    hard_steps = halvings < hard_halvings ? 0 : hard_steps + 1;
    if(hard_steps > most_hard_steps)
      throw cases::NumericalError(
          method_name, step_number + 1, time + duration, "front",
          fmt::format("moves too far in {} steps in a row, each made in 1/{} of its "
                      "length or less; what is solid or liquid there is thinner than "
                      "this n resolves, take a larger one",
                      hard_steps, 1 << hard_halvings));
    accept(step, duration, end());
  }

  void ConservativeRun::accept(Step &step, double duration, double end)
  {
    const double first = (1 - gamma) * duration, second = gamma * duration;
    unsettled_stages += !step.first.settled + !step.second.settled;
    boundary_heat += first * step.first.wall_power + second * step.second.wall_power;
    source_heat += first * (step.first.released_power + step.first.source_power)
                   + second * (step.second.released_power + step.second.source_power);
    const double began = std::exchange(time, end);
    if(damped_steps > 0)
    {
      --damped_steps;
      ++euler_steps;
    }
    state.heat = std::move(step.second.heat);
    state.debt = std::move(step.second.debt);
    temperatures = std::move(step.second.guess.temperatures);
    increment = std::move(step.second.increment);
    powers = std::move(step.powers);
    last_step = duration;
    ++step_number;
    state.level_set = std::move(step.second.guess.level_set);
    turn_small_bodies();
    restore_slopes();
    state.level_set = with_distances(mesh, Front(mesh, state.level_set), state.level_set,
                                     reach_of_distance * mesh.spacing);
    settle_hats();
    const Values before = state.level_set;
    let_phases_appear();
    melt_what_appeared(before);
    check();
    if(std::ranges::binary_search(step_ends, time))
      damp_jump_after_step(began);
  }

  void ConservativeRun::turn_small_bodies()
  {
    const Front front(mesh, state.level_set);
    for(const Body &body : bodies(mesh, front, state.level_set))
    {
      if(!(body.area < least_area * mesh.spacing * mesh.spacing)
         || lies_along_wall(appearance, body.nodes))
        continue;
      turn(mesh, front, body, latent_heat_of_volume(), state);
      ++turned_bodies;
      note(time, fmt::format("a body of {} of {:.3g} m^2 was booked as {}",
                             body.phase == Phase::solid ? "solid" : "liquid", body.area,
                             body.phase == Phase::solid ? "liquid" : "solid"));
    }
  }

  /** Nodes of cut triangles keep their values, step by step; where their slope is no
   * longer a distance's, which the band and the smoothing of the front's law count on,
   * they get distances again, and these are fitted to the solid's area in each hat. */
  void ConservativeRun::restore_slopes()
  {
    const Front front(mesh, state.level_set);
    if(std::ranges::none_of(front.cut,
                            [](const CutTriangle &cut)
                            {
                              const double slope = cut.level_set.gradient.norm();
                              return cut.crossed
                                     && !(slope * steepest >= 1 && slope <= steepest);
                            }))
      return;
    const double reach = reach_of_distance * mesh.spacing;
    const StepFrame frame(mesh,
                          distances(mesh, segments_of(front), state.level_set, reach),
                          Constants().smoothing);
    const FrontState fitted = fitted_front(mesh, frame, front.solid_area, reach);
    state.level_set = fitted.level_set;
    for(std::size_t node = 0; node < fitted.debt.size(); ++node)
      state.debt[node] += fitted.debt[node];
    ++restored_slopes;
  }

  /** Whether a phase that should have appeared within a step is beyond the melting
   * temperature at its end. */
  bool ConservativeRun::misses_a_phase(const Step &step) const
  {
    constexpr double begins = 0.5;
    const std::array<double, 2> tolerated = tolerated_heat();
    return largest_excess(appearance, tolerated, step.second.guess.level_set,
                          step.second.heat)
               > 1
           && largest_excess(appearance, tolerated, state.level_set, state.heat) < begins;
  }

  /** A state whose heat varies from hat to hat: the next step is as long as heat takes to
   * even out across a cell, h^2/(3 alpha) in its first stage, or shorter where the front
   * then moves too far. */
  void ConservativeRun::begin_anew()
  {
    const double slowest = std::min(scene.material.solid.diffusivity(),
                                    scene.material.liquid.diffusivity());
    last_step = mesh.spacing * mesh.spacing / (3 * slowest * gamma * largest_growth);
    front_speed = 0;
    increment.assign(mesh.nodes.size(), 0);
  }

  /** What is left at hats that a phase or the front has gone from, as where a thin layer
   * vanishes at once: heat of a phase that is no longer near goes to the other's in the
   * same hat, debt of the front to the heat of the phase that is there. */
  void ConservativeRun::settle_hats()
  {
    largest_debt = std::max(largest_debt, std::abs(sum(state.debt)));
    const StepFrame frame(mesh, state.level_set, Constants().smoothing);
    for(std::size_t node = 0; node < state.debt.size(); ++node)
    {
      const Phase here = state.level_set[node] < 0 ? Phase::solid : Phase::liquid,
                  other = here == Phase::solid ? Phase::liquid : Phase::solid;
      double &heat = state.heat[index(here)][node];
      if(frame.temperature[index(other)][node] < 0)
        heat += std::exchange(state.heat[index(other)][node], 0);
      if(frame.displacement[node] < 0)
        heat -= latent_heat_of_volume() * std::exchange(state.debt[node], 0);
    }
  }
} // namespace meltfront::reference_fem::cut::conservative
