#ifndef meltfront_cases_case_file_thermal_particles_reader_h
#define meltfront_cases_case_file_thermal_particles_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

namespace meltfront::cases
{
  /** Keys of what heats and cools a solid of particles as a whole: its first temperature,
   * bath, light and drag; the cell that it repeats itself in; stages. */
  void declare_thermal_particles(PrmFile &prm);

  /** @throws InputError, and for all of them where the particles are a bar */
  void read_thermal_particles(const PrmFile &prm, const Scene &scene,
                              ParticleSolid &solid);
} // namespace meltfront::cases

#endif
