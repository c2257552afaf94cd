#ifndef meltfront_particles_sph_cell_sections_h
#define meltfront_particles_sph_cell_sections_h

#include <array>

/** Sections of a unit cell by straight fronts. */
namespace meltfront::particles
{
  /** Where a line with a unit normal cuts a unit square so that a given part of it lies
   * behind: signed distance from the square's centre along the normal (1). */
  double line_through_square(double part_behind, double normal_x, double normal_y);

  /** Length within a unit square of the line with a unit normal at a distance from its
   * centre; 0 for one that misses it. */
  double length_in_square(double distance, double normal_x, double normal_y);

  /** The same of a plane and a unit cube: signed distance from the cube's centre (1). */
  double plane_through_cube(double part_behind, const std::array<double, 3> &normal);

  /** Area within a unit cube of the plane with a unit normal at a distance from its
   * centre. */
  double area_in_cube(double distance, const std::array<double, 3> &normal);
} // namespace meltfront::particles

#endif
