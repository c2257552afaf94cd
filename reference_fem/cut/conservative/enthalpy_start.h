#ifndef meltfront_reference_fem_cut_conservative_enthalpy_start_h
#define meltfront_reference_fem_cut_conservative_enthalpy_start_h

#include <cases/method.h>
#include <cases/scene.h>
#include <reference_fem/cut/conservative/bodies.h>

#include <functional>

namespace meltfront::reference_fem::cut::conservative
{
  /** How far and how finely `fem-enthalpy` goes before it hands a scene over. */
  struct EnthalpyStartOptions
  {
    double depth = 3;   ///< of the new phase wherever it is, or of what jumps (cells)
    int refinement = 2; ///< its cells in one of the sharp mesh, along a side
  };

  /** What the hat functions of a mesh hold of a state of the enthalpy method. */
  struct HatContents
  {
    Values volume, solid_area;  ///< by hat (m^2)
    std::array<Values, 2> heat; ///< by phase and hat, over the melting temperature (J/m)
  };

  /**
   * A state of the enthalpy method by hats: every node stands for the quarters of its
   * cells that lie next to it, over which the hats are integrated. Sums over the hats are
   * those over the nodes.
   * @param material whose heat capacities the heat is counted with
   */
  HatContents contents_of_hats(const TriangleMesh &mesh, const cases::Domain &domain,
                               const cases::Material &material,
                               const cases::Snapshot &snapshot);

  /**
   * Distance to the front as far as shares of solid tell: where the share of solid
   * averaged over the triangles about a node is a half. Up to a reach.
   */
  Values distances_by_shares(const TriangleMesh &mesh, const HatContents &contents,
                             double reach);

  /**
   * The front whose solid has given areas by hat, but for what the smoothing of its law
   * moves along the front and between neighbours; their sum is kept. What the areas miss
   * beside a rim is debt of the front, for its law to make good; what has melted or
   * frozen two spacings from it and farther, where no phase is to be seen yet, is heat of
   * the phase that is there.
   * @param latent_heat of the volume (J/m^3)
   * @param reach of the distance (m)
   * @throws std::runtime_error where there is none
   */
  FrontState front_of_areas(const TriangleMesh &mesh, const HatContents &contents,
                            double latent_heat, double reach);

  /**
   * The part of a run before its fronts are resolved, made by `fem-enthalpy` in the same
   * domain: from the scene's start until what has changed its phase is so many cells deep
   * wherever it is, or three times as deep somewhere; or until temperatures that jump at
   * the start are smooth over so many cells.
   */
  class EnthalpyStart
  {
  public:
    /** @param scene, effects, resolution, mesh outlive this */
    EnthalpyStart(const cases::Scene &scene, const cases::EffectSet &effects,
                  const cases::Resolution &resolution, const TriangleMesh &mesh,
                  const EnthalpyStartOptions &options);

    /**
     * Find out when a new phase is so deep, by runs of `fem-enthalpy` whose ends are four
     * times as late each time.
     * @param at_start the level set by node, where there are both phases at the start;
     * else empty
     * @throws cases::Refusal where no front gets so deep before the scene's end
     */
    void until_deep(Values at_start);

    /** Until 2 sqrt(alpha t) of the phase with the smaller diffusivity is so many cells.
     * @throws cases::Refusal where that is later than the scene's end */
    void until_smooth();

    /** Run up to that time, calling visit() for every state, the last one included.
     * @return what it cost */
    cases::Cost run(const std::function<void(const cases::Snapshot &)> &visit) const;

    double time = 0;                        ///< of the handing over (s)
    double least_depth = 0, most_depth = 0; ///< cells, then, as until_deep() saw it
    int cells = 0;                          ///< along the side
    long search_work = 0;                   ///< matrix entries that the search touched

  private:
    bool search(double end, double &appeared);
    cases::Cost
    run_until(double end, int cells, long steps,
              const std::function<void(const cases::Snapshot &)> &visit) const;

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const cases::Resolution &resolution;
    const TriangleMesh &mesh;
    const EnthalpyStartOptions options;
    Values at_start;
    long steps = 0;
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
