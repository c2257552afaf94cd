#include <particles/rkpm_tracked/line/measure.h>
#include <particles/rkpm_tracked/line/sites.h>

#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Integral of a straight line between two points. */
    double integral(cases::Symmetry symmetry, double a, double at_a, double b,
                    double at_b)
    {
      const auto [from_a, from_b] = end_volumes(symmetry, a, b);
      return from_a * at_a + from_b * at_b;
    }
  } // namespace

  LineHeat heat_of(const LineProblem &problem, const LineState &state)
  {
    const double melting = problem.material.melting_temperature;
    LineHeat heat;
    double from = problem.nodes.front(), excess = state.temperature.front() - melting;
    std::size_t number = 0;
    const auto advance = [&](double place, double value)
    {
      const bool solid = state.solid(number);
      const cases::PhaseProperties &phase = problem.phase(solid);
      heat.sensible += phase.volumetric_heat_capacity()
                       * integral(problem.symmetry, from, excess, place, value);
      if(!solid)
        heat.latent += phase.density * problem.material.latent_heat
                       * cases::volume_between(problem.symmetry, from, place);
      from = place;
      excess = value;
    };
    for(std::size_t i = 1; i < problem.nodes.size(); ++i)
    {
      for(; number < state.fronts.size() && state.fronts[number] <= problem.nodes[i];
          ++number)
        advance(state.fronts[number], 0.);
      advance(problem.nodes[i], state.temperature[i] - melting);
    }
    return heat;
  }

  double wall_heat(const LineProblem &problem, const LineState &state)
  {
    double sum = 0;
    for(const std::size_t side : {0, 1})
    {
      const double x = side == 0 ? problem.nodes.front() : problem.nodes.back();
      if(side == 0 && problem.axis)
        continue;
      // What is given is booked as given, not by a slope that meets it in the limit.
      const cases::BoundaryKind kind = problem.walls[side].kind;
      const bool given = kind == cases::BoundaryKind::insulated
                         || (problem.walls[side].mean_flux && !problem.balanced());
      double flux = given ? 0 : state.wall_flux[side];
      const bool solid = state.solid(side == 0 ? 0 : state.n_intervals() - 1);
      if(!state.fronts.empty() && problem.displacement(solid) != 0)
      {
        const std::size_t own = side == 0 ? 0 : state.fronts.size() - 1;
        double inward = problem.displacement(solid) * state.speed[own];
        for(int i = 0; i < problem.curvature_terms(); ++i)
          inward *= state.fronts[own] / x;
        const cases::PhaseProperties &phase = problem.phase(solid);
        const double wall
            = side == 0 ? state.temperature.front() : state.temperature.back();
        const double enthalpy
            = phase.density * (solid ? 0. : problem.material.latent_heat)
              + phase.volumetric_heat_capacity()
                    * (wall - problem.material.melting_temperature);
        flux += (side == 0 ? inward : -inward) * enthalpy;
      }
      sum += flux * area(problem.symmetry, x);
    }
    return sum;
  }

  double given_wall_heat(const LineProblem &problem, double begin, double end)
  {
    double sum = 0;
    for(const std::size_t side : {0, 1})
      if(problem.walls[side].mean_flux)
        sum += (end - begin) * problem.walls[side].mean_flux(begin, end)
               * area(problem.symmetry,
                      side == 0 ? problem.nodes.front() : problem.nodes.back());
    return sum;
  }

  void LineSites::add(double x, double volume, double value, bool solid)
  {
    place.push_back(x);
    weight.push_back(volume);
    temperature.push_back(value);
    solid_fraction.push_back(solid ? 1. : 0.);
  }

  void LineSites::read(const LineProblem &problem, const LineState &state,
                       cases::Snapshot &snapshot)
  {
    for(std::vector<double> *array : {&place, &weight, &temperature, &solid_fraction})
      array->clear();
    const double melting = problem.material.melting_temperature;
    const std::vector<double> &x = problem.nodes;
    double bound = x.front();
    for(std::size_t i = 0; i < x.size(); ++i)
    {
      const std::size_t number = state.interval_of(x[i]);
      const std::size_t next = i + 1 < x.size() ? state.interval_of(x[i + 1]) : number;
      const double end = i + 1 == x.size() ? x[i]
                         : next == number  ? (x[i] + x[i + 1]) / 2
                                           : state.fronts[number];
      add(x[i], cases::volume_between(problem.symmetry, bound, end), state.temperature[i],
          state.solid(number));
      bound = end;
      // A phase between two fronts without a node is its lower front's.
      for(std::size_t j = number; j < next; ++j)
      {
        const double past = j + 1 < next ? state.fronts[j + 1] : bound;
        add(state.fronts[j], cases::volume_between(problem.symmetry, bound, past),
            melting, state.solid(j + 1));
        bound = past;
      }
    }
    fronts = state.fronts;
    snapshot.time = state.time;
    snapshot.dimension = 1;
    snapshot.positions[0] = place;
    snapshot.weights = weight;
    snapshot.temperature = temperature;
    snapshot.solid_fraction = solid_fraction;
    snapshot.front[0] = fronts;
    snapshot.obeys_maximum_principle = false;
  }
} // namespace meltfront::particles::rkpm_tracked
