#ifndef meltfront_cases_demand_h
#define meltfront_cases_demand_h

namespace meltfront::cases
{
  struct Domain;

  /** What the program takes before it has allocated anything for a scene (bytes). */
  inline constexpr double program_bytes = 6e7;

  /**
   * About how many points of a square or cubic lattice, n spacings along Domain::side(),
   * a domain holds. Nothing is laid out.
   * @param dimension in which it is simulated: of a slab and of what is simulated along a
   * radius the points along the line count
   */
  double lattice_points(const Domain &domain, int dimension, double n);

  /** About how many points of a lattice lie within a distance of one of them (1).
   * @param distance in spacings */
  double points_within(int dimension, double distance);

  /**
   * About how many entries the triangular factors of a matrix on a lattice have for each
   * unknown, over the entries of its row: after nested dissection log2 N in the plane and
   * N^(1/3) in space, of which the factors are measured.
   */
  double fill_of_factors(int dimension, double unknowns);
} // namespace meltfront::cases

#endif
