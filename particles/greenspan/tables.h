#ifndef meltfront_particles_greenspan_tables_h
#define meltfront_particles_greenspan_tables_h

#include <particles/greenspan/motion/particle_state.h>

#include <string>

namespace meltfront::particles::greenspan
{
  /** Of the four entries of table 2 that break its mirror symmetry. */
  enum class Errata
  {
    as_printed,
    applied
  };

  /**
   * Table 1 (triangle, 28 particles) or 2 (rectangle, 46 particles) of the report
   * (cases/data).
   * @throws cases::InputError for another number or a file with a faulty line
   * @throws cases::OutputError if the file cannot be read
   */
  ParticleState read_table(int table, Errata errata = Errata::as_printed);

  /** The same from a folder with the files of cases/data. */
  ParticleState read_table(const std::string &folder, int table, Errata errata);
} // namespace meltfront::particles::greenspan

#endif
