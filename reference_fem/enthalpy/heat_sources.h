#ifndef meltfront_reference_fem_enthalpy_heat_sources_h
#define meltfront_reference_fem_enthalpy_heat_sources_h

#include <cases/method.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/mesh.h>
#include <reference_fem/enthalpy/time_scheme.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace meltfront::reference_fem
{
  /**
   * The effects heat_sources and moving_source: point and line sources as exact Dirac
   * loads, shared by a cell's nodes by the values of their shape functions at the source.
   * Of a source that moves, the shares are averaged over the step along its path, each
   * with the heat given off there.
   *
   * The power of a step is the time scheme's own difference quotient of the energy, so
   * that the heat that has entered is PointSource::energy exactly.
   */
  class HeatSources
  {
  public:
    /**
     * @param mesh is to live as long as this where a source moves
     * @throws cases::Refusal where the discretisation's symmetry does not allow for the
     * source: away from the centre of a radial mesh, in a slab meshed in 2D or 3D
     */
    HeatSources(const cases::Scene &scene, Mesh &mesh,
                const Discretisation &discretisation);

    /** Add the heat of a step to the load vector (J). */
    void add_load(const StepFormula &step, std::vector<double> &load);

    /** Heat from all sources since the start (J). */
    double energy(double time) const;

    /** Whether a source moves. */
    bool move() const
    {
      return !moving.empty();
    }

    const cases::EffectCost &cost() const
    {
      return effect_cost;
    }

    const cases::EffectCost &cost_of_moving() const
    {
      return moving_cost;
    }

  private:
    struct Source
    {
      std::function<double(double)> energy;
      Shares shares;
    };

    /** What a step gave to the nodes (J). */
    struct Given
    {
      double begin = 0, end = 0;
      Shares heat;
    };

    struct MovingSource
    {
      cases::PointSource source;
      std::array<Given, 2> steps; ///< the latest are kept: a formula of two needs both
      std::size_t latest = 0;
    };

    const Shares &given(MovingSource &moving, double begin, double end);
    void follow(const cases::PointSource &source, double begin, double end, int depth,
                Shares &heat) const;

    const Mesh &mesh;
    double longest_way; ///< of a source between points at which it gives off heat (m)
    std::vector<Source> sources;
    std::vector<MovingSource> moving;
    cases::EffectCost effect_cost{cases::Effect::heat_sources};
    cases::EffectCost moving_cost{cases::Effect::moving_source};
  };
} // namespace meltfront::reference_fem

#endif
