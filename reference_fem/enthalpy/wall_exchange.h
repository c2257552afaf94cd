#ifndef meltfront_reference_fem_enthalpy_wall_exchange_h
#define meltfront_reference_fem_enthalpy_wall_exchange_h

#include <cases/method.h>
#include <cases/time_integral.h>
#include <cases/wall_law.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * The effects robin_wall and radiating_wall: heat that walls exchange with their
   * surroundings, taken at the walls' nodes, at their temperatures at the end of a step.
   * The ambient temperature is the time scheme's own mean over the step, so that of a
   * linear law what its pulses bring in is what they are worth.
   *
   * The law enters Newton's method by its tangent q = supply/area - transfer/area (T -
   * T_m), which of a linear law is the law itself.
   */
  class WallExchange
  {
  public:
    /** @param free of each node: 0 where another wall prescribes its temperature */
    WallExchange(const cases::Scene &scene, const Discretisation &discretisation,
                 const std::vector<char> &free);

    /** Take the ambient temperatures of a step. */
    void begin(const StepFormula &step);

    /** Take the tangents at a state. @param excess gives T - T_m of a node (K) */
    template <typename Excess>
    void follow(const Excess &excess)
    {
      for(Place &place : places)
        transfer[place.node] = supply[place.node] = 0;
      for(Place &place : places)
      {
        const double own = excess(place.node);
        const cases::HeatThroughWall through
            = cases::heat_through(*place.boundary, place.ambient, melting + own);
        transfer[place.node] -= place.area * through.slope;
        supply[place.node] += place.area * (through.flux - through.slope * own);
      }
      ++calls;
    }

    /** Visit the nodes once each. */
    template <typename Visit>
    void visit(const Visit &visit) const
    {
      for(const unsigned int node : nodes)
        visit(node);
    }

    /** The power that comes in at a state (W), by the tangents taken last. */
    template <typename Excess>
    double power(const Excess &excess) const
    {
      double sum = 0;
      for(const unsigned int node : nodes)
        sum += supply[node] - transfer[node] * excess(node);
      return sum;
    }

    cases::EffectCost cost(cases::Effect effect) const;

    std::vector<double> transfer; ///< by node (W/K), >= 0
    std::vector<double> supply;   ///< by node (W)

  private:
    struct Wall
    {
      cases::StepIntegrals ambient;
      std::size_t first, last; ///< of its places
    };
    struct Place
    {
      unsigned int node;
      double area;
      const cases::Boundary *boundary;
      double ambient = 0;
    };
    std::vector<Wall> walls;
    std::vector<Place> places;
    std::vector<unsigned int> nodes; ///< of the places, each once
    double melting;
    long calls = 0;
  };
} // namespace meltfront::reference_fem

#endif
