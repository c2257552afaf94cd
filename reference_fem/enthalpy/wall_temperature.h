#ifndef meltfront_reference_fem_enthalpy_wall_temperature_h
#define meltfront_reference_fem_enthalpy_wall_temperature_h

#include <cases/method.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/compensated_vector.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/time_scheme.h>
#include <reference_fem/enthalpy/truncated_newton.h>

#include <functional>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * The effect wall_temperature: nodes whose temperature is prescribed. A node where two
   * walls meet takes the temperature of the first in the order of cases::Side.
   *
   * Such a node holds heat like any other: what it stores and what it conducts to its
   * neighbours is the wall's reaction, the heat that enters through the wall.
   */
  class WallTemperature
  {
  public:
    WallTemperature(const cases::Scene &scene, const Discretisation &discretisation);

    /** Clear the mark of the nodes that are prescribed. */
    void mark(std::vector<char> &free) const;

    /** Prescribe Kirchhoff's variable at the end of a step. */
    void prescribe(const StepFormula &step, const NonlinearSolver &solver,
                   CompensatedVector &u);

    /** Enthalpy (J/m^3) of a node at a temperature, where it was `last`. */
    using EnthalpyAt
        = std::function<double(unsigned int node, double temperature, double last)>;

    /**
     * Set the enthalpy (J/m^3) of the prescribed nodes after a step; returns the heat
     * that entered through the walls in it (J), load and c (K u) included. A wall at
     * exactly the melting temperature keeps the phase that it has.
     */
    double react(const StepFormula &step, const StepProblem &problem,
                 const CompensatedVector &u, const std::vector<double> &rhs,
                 std::vector<double> &enthalpy, const EnthalpyAt &enthalpy_at);

    const cases::EffectCost &cost() const
    {
      return effect_cost;
    }

  private:
    struct Node
    {
      WallNode place;
      std::size_t wall;
      double temperature = 0; ///< prescribed last
    };
    std::vector<cases::Field> temperatures; ///< by wall
    std::vector<Node> nodes;
    double melting_temperature;
    cases::EffectCost effect_cost{cases::Effect::wall_temperature};
  };
} // namespace meltfront::reference_fem

#endif
