#ifndef meltfront_cases_case_file_material_reader_h
#define meltfront_cases_case_file_material_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Declare the keys of `Scene/Material` but for those of alloys. */
  void declare_material(PrmFile &prm);

  /** The material of a scene that conducts heat; of a steady one its conductivity.
   * @throws InputError */
  Material read_material(const PrmFile &prm);

  /** Properties that vary with temperature must be known at all temperatures that the
   * scene itself names, and are for pure substances that are not steady. @throws
   * InputError */
  void check_material(const PrmFile &prm, const Scene &scene);
} // namespace meltfront::cases

#endif
