#ifndef meltfront_cases_case_file_particle_solid_reader_h
#define meltfront_cases_case_file_particle_solid_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Keys of subsection 'Particle solid'. */
  void declare_particle_solid(PrmFile &prm);

  /**
   * Fill in Scene::particle_solid where the scene is one of particles, or conducts heat
   * through a bar of them; the domain of the first kind becomes a box about the solid.
   * @throws InputError
   */
  void read_particle_solid(const PrmFile &prm, Scene &scene);
} // namespace meltfront::cases

#endif
