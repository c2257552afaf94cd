#ifndef meltfront_reference_fem_enthalpy_front_refinement_h
#define meltfront_reference_fem_enthalpy_front_refinement_h

#include <cases/effects.h>
#include <cases/scene.h>
#include <reference_fem/enthalpy/graph.h>
#include <reference_fem/enthalpy/refinable_mesh.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Where a mesh is to be finest (option `refinement`): in some layers of cells around
   * the front and around sources; and elsewhere so fine that a cell's jump of gradients
   * times its size (RefinableMesh::jumps), of the sensible heat per volume, is no more
   * than the share `smoothness` of what that changes by across the smallest cells on
   * average: its span over the domain's side times the smallest spacing. The error of a
   * fixed mesh at the front is of that order, so that the larger cells add a share of it.
   * Heat, for what the larger cells are wrong by in it is what the front is wrong by.
   *
   * Cells near the front are never joined: what is solid and what is liquid is not mixed.
   */
  class FrontRefinement
  {
  public:
    /** Layers of smallest cells around the cells that the front lies in. */
    static constexpr int layers = 4;
    /** There are so many at least, or the mesh is adapted. */
    static constexpr int fewest_layers = 2;
    /** Cells within so many more are not joined. */
    static constexpr int layers_kept = 2;
    /** Steps after which the mesh is adapted at the latest. */
    static constexpr int most_steps = 10;
    static constexpr double smoothness = 0.4;
    /** Cells that are joined have four times the jump: they are to stay below. */
    static constexpr double joined_below = 1. / 8;

    /** @throws cases::Refusal where the scene calls for what is not simulated so. */
    FrontRefinement(const cases::Scene &scene, const cases::EffectSet &effects,
                    const RefinableMesh &mesh);

    /** Whether all cells within so many layers of the front are the smallest.
     * @param enthalpy by node (J/m^3) */
    bool finest_at_front(const Discretisation &discretisation,
                         const std::vector<double> &enthalpy, int within) const;

    /** What else wishes take into account. */
    struct Scope
    {
      bool everywhere = true; ///< halve for smoothness too
      bool join = true;
    };
    std::vector<Wish> wishes(const Discretisation &discretisation,
                             const std::vector<double> &enthalpy,
                             const Scope &scope) const;

    /** Whether a wish is to halve a cell. */
    static bool halves(const std::vector<Wish> &wishes);

  private:
    std::vector<double> by_site(const Discretisation &discretisation,
                                std::vector<double> by_node) const;
    std::vector<int> layers_from_front(const Discretisation &discretisation,
                                       const std::vector<double> &enthalpy,
                                       int up_to) const;
    void spread(const Discretisation &discretisation, int up_to,
                std::vector<int> &layer) const;

    const cases::Scene &scene;
    const RefinableMesh &mesh;
    EnthalpyGraph<true, true> graph;
  };
} // namespace meltfront::reference_fem

#endif
