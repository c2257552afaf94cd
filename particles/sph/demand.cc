#include <cases/demand.h>
#include <particles/core/kernels.h>
#include <particles/sph/demand.h>
#include <particles/sph/time/time_stepping.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles
{
  namespace
  {
    double particles_of(const SphParameters &p, const cases::Scene &scene, double reach)
    {
      const double along = cases::lattice_points(scene.domain, p.dimension, p.n);
      if(scene.domain.shape != cases::DomainShape::slab)
        return along;
      const double across = p.columns > 0 ? p.columns : std::ceil(2 * reach);
      return along * std::pow(across, p.dimension - 1);
    }

    /**
     * The largest explicit step that keeps the maximum principle on a lattice, where the
     * conductances of a particle add up to about 2 d k dp^(d-2) far from fronts and to
     * more at them: by 3, 1.7 and 1.4 in one, two and three dimensions, measured. The
     * linear stability limit is that of eigenvalues of twice these sums.
     */
    double explicit_step_of(const SphParameters &p, const cases::Scene &scene,
                            double spacing)
    {
      const double mass = scene.material.solid.density * spacing * spacing;
      return p.step_limit == StepLimit::stability
                 ? stable_step(scene, mass, 4. * p.dimension)
                 : monotone_step(scene, mass, 2. * p.dimension, 2);
    }

    double steps_of(const SphParameters &p, const cases::Scene &scene, double spacing)
    {
      if(p.steps > 0)
        return p.steps;
      if(p.step_error > 0)
        return 0;
      const double step
          = p.step_factor > 0
                ? p.step_factor * explicit_step_of(p, scene, spacing)
                : published_step(scene.material, p.smoothing_length * spacing);
      const double steps = (scene.end_time - scene.start_time) / step;
      const double super_steps = steps / super_step_reach(p.stages);
      // Along a line steps chosen by their error are up to twelve to a particle,
      // measured.
      if(p.time_scheme == TimeScheme::automatic)
        return p.dimension > 1 ? super_steps : std::min(super_steps, 200. + 12. * p.n);
      return p.time_scheme == TimeScheme::rkl2 ? super_steps : steps;
    }
  } // namespace

  cases::Demand sph_demand(const SphParameters &p, const cases::Scene &scene,
                           const SphMemory &memory)
  {
    const double spacing = lattice_spacing(scene.domain.side(), p.n, p.layout);
    const double reach
        = SmoothingKernel(p.kernel, p.dimension, p.smoothing_length * spacing).support()
          / spacing;
    const double neighbours = cases::points_within(p.dimension, reach);
    return {cases::program_bytes
                + particles_of(p, scene, reach)
                      * (memory.per_particle + memory.per_neighbour * neighbours),
            steps_of(p, scene, spacing)};
  }
} // namespace meltfront::particles
