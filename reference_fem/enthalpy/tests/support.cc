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
    const cases::Scene simulated = cases::simulated_scene(scene, effects);
    const cases::Resolution resolution = resolution_of(*make_fem_enthalpy(), n, options);
    const cases::Stopwatch watch;
    EnthalpyRun solver(simulated, effects, resolution);
    course.cost = solver.carry_out(simulated, watch, course);
    record.statistics = solver.worst_of_steps();
    static_cast<FrontCourse &>(record) = FrontCourse(std::move(course), scene, exact);
    return record;
  }
} // namespace meltfront::reference_fem::tests
