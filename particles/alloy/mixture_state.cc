#include <cases/error.h>
#include <particles/alloy/mixture_state.h>
#include <particles/sph/initial_state.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::particles
{
  namespace
  {
    std::vector<double> concentrations(const Discretisation &dis, std::size_t solute)
    {
      const cases::Field &field = dis.scene.initial.concentration[solute];
      std::vector<double> result(dis.particles.size());
      for(std::size_t a = 0; a < result.size(); ++a)
        result[a] = field(dis.particles.point(a), dis.scene.start_time);
      return result;
    }

    void check_concentrations(const Discretisation &dis,
                              const std::vector<std::vector<double>> &concentration)
    {
      for(std::size_t a = 0; a < dis.particles.size(); ++a)
      {
        double sum = 0;
        for(const std::vector<double> &solute : concentration)
        {
          if(!(solute[a] >= 0))
            throw cases::InputError(fmt::format(
                "the initial concentration is {:.6g} at x = {:.6g} m; it must not be "
                "negative",
                solute[a], dis.particles.position[0][a]));
          sum += solute[a];
        }
        if(!(sum <= 1))
          throw cases::InputError(fmt::format(
              "the initial mass fraction of solutes is {:.6g} at x = {:.6g} m; it must "
              "not exceed 1",
              sum, dis.particles.position[0][a]));
      }
    }

    /** Mean enthalpy of a cell of a planar scene, from the exact heat within it. */
    double planar_mean(const Discretisation &dis, double density, double x)
    {
      const cases::Scene &scene = dis.scene;
      const double lower = std::max(x - 0.5 * dis.cell[0], scene.domain.lower[0]);
      const double upper = std::min(x + 0.5 * dis.cell[0], scene.domain.upper[0]);
      return scene.initial.exact->heat_content(lower, upper, scene.start_time)
             / ((upper - lower) * density);
    }
  } // namespace

  MixtureState::MixtureState(const Discretisation &dis, const AlloySubstance &substance)
    : enthalpy(dis.particles.size())
  {
    const cases::Scene &scene = dis.scene;
    for(const std::size_t solute : substance.numbers)
      concentration.push_back(concentrations(dis, solute));
    check_concentrations(dis, concentration);
    const bool exact_means
        = scene.initial.exact
          && scene.initial.exact->symmetry() == cases::Symmetry::planar;
    if(concentration.empty())
    {
      enthalpy = initial_enthalpy(dis);
      return;
    }
    for(std::size_t a = 0; a < enthalpy.size(); ++a)
    {
      const cases::Position position = dis.particles.point(a);
      const double temperature = scene.initial.temperature(position, scene.start_time);
      double content[cases::most_solutes] = {};
      for(std::size_t s = 0; s < concentration.size(); ++s)
        content[s] = concentration[s][a];
      if(exact_means)
        enthalpy[a] = planar_mean(dis, substance.density, position[0]);
      else
        enthalpy[a] = substance.diagram.enthalpy(temperature, content[0], content[1]);
    }
  }

  cases::TemperatureBounds MixtureState::bounds(const cases::Scene &scene,
                                                const AlloySubstance &substance) const
  {
    cases::TemperatureBounds result = cases::temperature_bounds(scene);
    double highest[cases::most_solutes] = {};
    for(std::size_t a = 0; a < enthalpy.size(); ++a)
    {
      double content[cases::most_solutes] = {};
      for(std::size_t s = 0; s < concentration.size(); ++s)
        content[s] = concentration[s][a];
      const auto [temperature, liquid]
          = substance.diagram.equilibrium(enthalpy[a], content[0], content[1]);
      // The scene's bounds are sampled: its extremes may lie at a particle in between.
      result.lower = std::min(result.lower, temperature);
      result.upper = std::max(result.upper, temperature);
      for(std::size_t s = 0; s < concentration.size() && liquid > 0; ++s)
        highest[s] = std::max(highest[s], content[s] / liquid);
    }
    if(substance.diffuses())
      result.lower = std::min(result.lower,
                              std::max(substance.diagram.liquidus(highest[0], highest[1]),
                                       substance.alloy.eutectic_temperature));
    return result;
  }

  bool MixtureState::uniform() const
  {
    return std::all_of(concentration.begin(), concentration.end(),
                       [](const std::vector<double> &solute)
                       {
                         return std::all_of(solute.begin(), solute.end(),
                                            [&](double c) { return c == solute[0]; });
                       });
  }
} // namespace meltfront::particles
