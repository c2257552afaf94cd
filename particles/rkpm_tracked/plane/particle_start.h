#ifndef meltfront_particles_rkpm_tracked_plane_particle_start_h
#define meltfront_particles_rkpm_tracked_plane_particle_start_h

#include <cases/method.h>
#include <cases/scene.h>
#include <particles/rkpm_tracked/plane/nodes.h>
#include <particles/rkpm_tracked/tracking_options.h>

#include <functional>

namespace meltfront::particles::rkpm_tracked
{
  /** Whether a front is yet to set out: one phase fills the domain, and no source is to
   * melt or freeze anything. */
  bool starts_from_one_phase(const cases::Scene &scene);

  /** Whether solid and liquid are there at the start, and temperatures that may jump as
   * those of bodies that touch do, as far as their expression tells; no source and no
   * undercooled or superheated phase, which `sph` does not take. */
  bool may_start_with_jumps(const cases::Scene &scene);

  /** Whether they do, between nodes. */
  bool starts_with_jumps(const cases::Scene &scene, const PlaneNodes &nodes);

  /**
   * The part of a run before its front is resolved, made by `sph` in the same domain:
   * from the scene's start until the phase that is new is so many nodes deep wherever it
   * is, or three times as deep somewhere; or until what jumps at the start is smooth over
   * so many nodes, 2 sqrt(alpha t) of the phase with the smaller diffusivity. Where that
   * takes longer than a quarter of the run, half as many are enough from then on.
   */
  class ParticleStart
  {
  public:
    using Visit = std::function<void(const cases::Snapshot &)>;

    /**
     * Finds out when a new phase is so deep, by runs of `sph` with as many particles as
     * nodes, whose ends are four times as late each time.
     * @param scene, effects, resolution, nodes outlive this
     * @throws cases::Refusal where `sph` does not take the scene, or where nothing gets
     * so deep or so smooth before its end
     */
    ParticleStart(const cases::Scene &scene, const cases::EffectSet &effects,
                  const cases::Resolution &resolution, const PlaneNodes &nodes,
                  const TrackingParameters &parameters);

    /** Run up to that time, calling visit() for every state, the last one included.
     * @return what it cost */
    cases::Cost run(const Visit &visit) const;

    double time = 0; ///< of the handing over (s)
    /** Of a new phase, then, as the last search saw it, or of what is smooth (spacings).
     */
    double least_depth = 0, most_depth = 0;
    int particles = 0;    ///< along the side
    long search_work = 0; ///< interactions that the search touched

  private:
    bool search(double end);
    int along_side(int refinement) const;
    cases::Cost run_until(double end, int n, int stages, const Visit &visit) const;

    const cases::Scene &scene;
    const cases::EffectSet &effects;
    const cases::Resolution &resolution;
    const PlaneNodes &nodes;
    const double wished; ///< depth (m)
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
