#include <reference_fem/enthalpy/tests/support.h>

#include <reference_fem/enthalpy/enthalpy.h>

namespace meltfront::reference_fem::tests
{
  RunRecord run(const cases::Scene &scene, int n, const OptionTexts &options,
                const cases::ExactSolution *exact)
  {
    const cases::EffectSet effects = cases::effects_called_for(scene);
    Course course;
    RunRecord record;
    course.cost = run_enthalpy(cases::simulated_scene(scene, effects), effects,
                               resolution_of(*make_fem_enthalpy(), n, options), course,
                               record.statistics);
    static_cast<FrontCourse &>(record) = FrontCourse(std::move(course), scene, exact);
    return record;
  }
} // namespace meltfront::reference_fem::tests
