#include <cases/exact/planar_neumann.h>
#include <particles/rkpm_tracked/line/similarity_start.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** The solution holds while the far wall does not matter. */
    constexpr double far_tolerance = 1e-8;
    /** It is used for this share of a run at most. */
    constexpr double longest_start = 0.05;
    constexpr double equal_temperatures = 1e-12;

    bool uniform_but_for(const LineState &state, std::size_t side, double value,
                         double span)
    {
      const std::size_t exception = side == 0 ? 0 : state.temperature.size() - 1;
      for(std::size_t i = 0; i < state.temperature.size(); ++i)
        if(i != exception
           && std::abs(state.temperature[i] - value) > equal_temperatures * span)
          return false;
      return true;
    }
  } // namespace

  LineState exact_state(const cases::ExactSolution &exact, const LineProblem &problem,
                        double time, bool mirrored)
  {
    const double end = problem.nodes.back();
    LineState state;
    state.time = time;
    state.solid_first = mirrored != exact.solid_at_origin();
    state.fronts = {mirrored ? end - exact.front(time) : exact.front(time)};
    for(const double x : problem.nodes)
      state.temperature.push_back(exact.temperature(mirrored ? end - x : x, time));
    return state;
  }

  SimilarityStart::SimilarityStart(const LineProblem &problem, const LineState &initial,
                                   double duration)
    : problem(problem)
    , begin(initial.time)
    , duration(duration)
    , far(initial.temperature[initial.temperature.size() / 2])
  {
    if(problem.symmetry != cases::Symmetry::planar || !initial.fronts.empty()
       || problem.metastable || problem.volumetric_source)
      return;
    const double melting = problem.material.melting_temperature;
    int walls = 0;
    for(std::size_t s = 0; s < 2; ++s)
    {
      const double value = problem.walls[s].fixed() ? problem.walls[s].value(begin) : far;
      if((value - melting) * (initial.solid_first ? 1 : -1) > 0)
      {
        ++walls;
        side = s;
        wall = value;
      }
    }
    // The phase at the wall must be the one at rest.
    const bool at_rest = problem.displacement(!initial.solid_first) == 0;
    if(walls == 1 && at_rest && uniform_but_for(initial, side, far, std::abs(wall - far)))
      solution = std::make_shared<cases::PlanarNeumann>(problem.material, wall, far);
    if(!solution)
      return;
    const LineWall &at_other = other_wall();
    if(at_other.kind == cases::BoundaryKind::flux)
      other.slope
          = at_other.value_after(begin) / problem.phase(initial.solid_first).conductivity;
    else if(at_other.fixed())
      other.jump = at_other.value_after(begin) - far;
    if(std::abs(other.jump) <= far_tolerance * std::abs(wall - far))
      other.jump = 0;
  }

  const LineWall &SimilarityStart::other_wall() const
  {
    return problem.walls[1 - side];
  }

  double SimilarityStart::other_layer(double distance, double since) const
  {
    const double diffusivity = problem.phase(!solution->solid_at_origin()).diffusivity();
    return other.temperature(distance, 2 * std::sqrt(diffusivity * since));
  }

  bool SimilarityStart::other_holds(double since) const
  {
    const LineWall &at_other = other_wall();
    const double span = std::abs(wall - far);
    if(at_other.kind == cases::BoundaryKind::insulated)
      return true;
    const bool as_the_phase = !(at_other.kind == cases::BoundaryKind::flux);
    const double expected = as_the_phase ? far + other.jump : at_other.value_after(begin);
    for(const double t : {since / 2, since})
      if(std::abs(at_other.value(begin + t) - expected)
         > (as_the_phase ? far_tolerance * span
                         : equal_temperatures * std::abs(expected)))
        return false;
    if(!other.forms())
      return true;
    // It neither reaches the other layer nor what would start a front.
    const double half = (problem.nodes.back() - problem.nodes.front()) / 2;
    const double sign = solution->solid_at_origin() ? -1 : 1;
    const bool rests = problem.displacement(!solution->solid_at_origin()) == 0;
    return rests && std::abs(other_layer(half, since)) <= far_tolerance * span
           && std::abs(solution->temperature(half, since) - far) <= far_tolerance * span
           && (far + other_layer(0, since) - problem.material.melting_temperature) * sign
                  <= 0;
  }

  double SimilarityStart::time_of(double thickness) const
  {
    const double share = thickness / solution->front(1.);
    return share * share;
  }

  bool SimilarityStart::holds(double since) const
  {
    const double length = problem.nodes.back() - problem.nodes.front();
    const double span = std::abs(wall - far);
    for(const double t : {since / 2, since})
      if(std::abs(problem.walls[side].value(begin + t) - wall)
         > equal_temperatures * span)
        return false;
    return since <= longest_start * duration
           && std::abs(solution->temperature(length, since) - far) <= far_tolerance * span
           && other_holds(since);
  }

  LineState SimilarityStart::state(double since) const
  {
    LineState result = exact_state(*solution, problem, since, side == 1);
    result.time = begin + since;
    if(other.forms())
      for(std::size_t i = 0; i < problem.nodes.size(); ++i)
        result.temperature[i] += other_layer(
            std::abs(problem.nodes[i]
                     - (side == 0 ? problem.nodes.back() : problem.nodes.front())),
            since);
    return result;
  }
} // namespace meltfront::particles::rkpm_tracked
