#ifndef meltfront_particles_rkpm_tracked_tests_tracked_run_h
#define meltfront_particles_rkpm_tracked_tests_tracked_run_h

#include <cases/error.h>
#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>

#include <gtest/gtest.h>

#include <string>

namespace meltfront::particles::rkpm_tracked
{
  using cases::BoundaryKind;
  using cases::Side;
  using namespace test_support;

  inline Course run(const cases::Scene &scene, int n, const OptionTexts &options = {})
  {
    return course_of(*make_rkpm_tracked(), scene, n, options);
  }

  inline void expect_refusal(const cases::Scene &scene, int n, const std::string &reason)
  {
    try
    {
      run(scene, n);
      ADD_FAILURE() << "followed, not refused: " << reason;
    }
    catch(const cases::Refusal &refusal)
    {
      EXPECT_NE(std::string(refusal.what()).find(reason), std::string::npos)
          << refusal.what();
    }
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
