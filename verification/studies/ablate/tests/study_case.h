#ifndef meltfront_verification_studies_ablate_tests_study_case_h
#define meltfront_verification_studies_ablate_tests_study_case_h

#include <cases/case_file/case_file.h>
#include <cases/exact/planar_neumann.h>
#include <cases/tests/support/scenes.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <verification/record/temporary_directory.h>
#include <verification/studies/ablate/scene_study.h>

#include <string>

namespace meltfront::verification::tests
{
  /** A slab so short of time that its far end does not matter: Neumann's solution holds.
   */
  inline const std::string neumann_slab = R"(
set title = A slab that freezes
set units = normalised
subsection Scene
  set symmetry = planar
  set end time = 0.01
  subsection Domain
    set shape = slab
    set length = 0.5
  end
  subsection Material
    set melting temperature = 0
    set latent heat = 2
    subsection Solid
      set conductivity = 2
      set specific heat capacity = 1
      set density = 1
    end
    subsection Liquid
      set conductivity = 1
      set specific heat capacity = 1.5
    end
  end
  subsection Initial state
    set temperature = 0.5
  end
  subsection Walls
    subsection x_min
      set kind = fixed temperature
      set temperature = -1
    end
  end
end
)";

  inline cases::Material neumann_material()
  {
    cases::Material material = test_support::unit_material(0);
    material.latent_heat = 2;
    material.solid.conductivity = 2;
    material.liquid.specific_heat_capacity = 1.5;
    return material;
  }

  /** A study of a case by fem-enthalpy in a directory of its own. */
  struct ScratchStudy
  {
    TemporaryDirectory directory;
    std::unique_ptr<cases::Method> method = reference_fem::make_fem_enthalpy();
    StudySettings settings;

    ScratchStudy(const std::string &text, int n)
    {
      settings.case_name = "slab";
      settings.n = n;
      settings.runner.directory = directory.path("results");
      settings.runner.repeats.most = 1;
      settings.methods = {method.get()};
      settings.load_case = [text](const std::string &name)
      { return cases::read_case_text(text, name + ".prm"); };
    }
  };
} // namespace meltfront::verification::tests

#endif
