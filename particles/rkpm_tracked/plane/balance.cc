#include <particles/rkpm_tracked/plane/measure.h>
#include <particles/rkpm_tracked/plane/run.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Of the heat balance, over the largest heat in it, and trials to reach that. */
    constexpr double balanced = 1e-13;
    constexpr int most_trials = 12;
  } // namespace

  /** Heat that has come in and is not there (J/m). */
  double PlaneRun::lost_heat(const PlaneState &of) const
  {
    const PlaneMeasure found = measure(scene, nodes, heat, of);
    return initial_heat + of.wall_heat + of.flux_heat + of.released_heat
           + heat.sinks.energy(of.time) - unbooked_heat - found.sensible - found.latent;
  }

  /**
   * The equation of the multiplier: no heat is lost up to the end of the step, that of
   * the state as it will be accepted, with the front moved. It is solved to round-off,
   * by the secant method, in the last pass, before that by one secant.
   * @param next is what the pass has found, its front moved
   * @param response of the heat found, over what the multiplier puts in: nothing yet, or
   * that of the pass before
   * @param last_pass of those allowed: it may be kept with some way left
   * @param largest way that was left, in spacings
   * @return whether particles stay within their limits and the balance holds
   */
  bool PlaneRun::balance(const PlaneStep &times, const PlaneSolution &solution,
                         PlaneState &next, std::optional<double> &response,
                         bool last_pass, double &largest)
  {
    const PlaneFront front = next.front;
    const auto take = [&](double multiplier)
    {
      next.front = front;
      return !move(heat.apply(times, solution, multiplier, next), next, largest);
    };
    double multiplier = next.multiplier;
    if(!take(multiplier))
      return false;
    double lost = lost_heat(next);
    for(int trial = 0; trial < most_trials; ++trial)
    {
      const double scale = std::max(
          {std::abs(initial_heat), std::abs(next.wall_heat + next.flux_heat),
           scene.material.solid.density * scene.material.latent_heat * nodes.area});
      if(std::abs(lost) <= balanced * scale)
        return true;
      const double change = lost / (response.value_or(1) * solution.heat);
      if(!std::isfinite(change) || !take(multiplier + change))
        return false;
      if(largest > done && response && !last_pass)
        return true;
      const double left = lost_heat(next);
      response = (lost - left) / (change * solution.heat);
      multiplier += change;
      lost = left;
    }
    return false;
  }

  /** The similarity solution gives a seed its shape and temperatures; its front stands
   * where it holds the heat that there is, by the secant method. What nodes that change
   * their phase leave of that all nodes share. */
  void PlaneRun::balance_seed()
  {
    const double latent = scene.material.solid.density * scene.material.latent_heat;
    PlaneFront &front = state.front;
    double missing = lost_heat(state), response = latent;
    for(int trial = 0; trial < most_trials; ++trial)
    {
      double length = 0;
      for(std::size_t c = 0; c < front.curves(); ++c)
        length += curve_length(front, c);
      const double way = missing / (response * length);
      for(std::size_t p = 0; p < front.size(); ++p)
        front.position[p] += way * front.normal[p];
      update_geometry(front);
      settle_nodes();
      heat.expand(state);
      const double left = lost_heat(state);
      if(std::abs(left) <= balanced * latent * nodes.area)
        break;
      response = std::max((missing - left) / (way * length), latent / 2);
      missing = left;
    }
    const PlaneMeasure found = measure(scene, nodes, heat, state);
    unbooked_heat = book_heat(state, scene, nodes, heat, {},
                              found.sensible + found.latent + lost_heat(state));
    marked.seed(front, heat.settings.solid_beyond);
  }
} // namespace meltfront::particles::rkpm_tracked
