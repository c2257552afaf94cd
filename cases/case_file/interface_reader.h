#ifndef meltfront_cases_case_file_interface_reader_h
#define meltfront_cases_case_file_interface_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Keys of the subsections 'Region' and 'Velocity'. */
  void declare_interface(PrmFile &prm);

  /** Fill in Scene::interface where the problem is that. @throws InputError */
  void read_interface(const PrmFile &prm, Scene &scene);
} // namespace meltfront::cases

#endif
