#ifndef meltfront_particles_rkpm_tracked_tests_tracked_run_h
#define meltfront_particles_rkpm_tracked_tests_tracked_run_h

#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>

namespace meltfront::particles::rkpm_tracked
{
  using cases::BoundaryKind;
  using cases::Side;
  using namespace test_support;

  inline Course run(const cases::Scene &scene, int n, const OptionTexts &options = {})
  {
    return course_of(*make_rkpm_tracked(), scene, n, options);
  }

  inline cases::Scene slab(const cases::Material &material, double start, double end)
  {
    cases::Scene scene;
    scene.name = "slab";
    scene.symmetry = cases::Symmetry::planar;
    scene.domain.upper[0] = 1;
    scene.material = material;
    scene.start_time = start;
    scene.end_time = end;
    return scene;
  }
} // namespace meltfront::particles::rkpm_tracked

#endif
