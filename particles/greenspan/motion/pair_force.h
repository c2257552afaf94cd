#ifndef meltfront_particles_greenspan_motion_pair_force_h
#define meltfront_particles_greenspan_motion_pair_force_h

namespace meltfront::particles::greenspan
{
  /**
   * The force between two particles of unit mass, along the line that joins them,
   *
   *   f(r) = -G / r^beta + H / r^alpha   for r <= cutoff, and 0 beyond it,
   *
   * positive where they repel each other (D. Greenspan, University of Wisconsin, Computer
   * Sciences Technical Report 281, 1976, equations 2.5 and 2.6; the cutoff is in section
   * 3). All quantities are in the units of the report, in which masses are 1.
   */
  struct PairForce
  {
    double attraction = 2500;       ///< G
    double repulsion = 2900;        ///< H
    double attraction_exponent = 4; ///< beta
    double repulsion_exponent = 6;  ///< alpha > beta > 1
    double cutoff = 1.5;            ///< a pair acts up to this distance, inclusive
    bool shifted = false;           ///< f less its value at the cutoff: no jump there
    bool compiled_exponents = true; ///< false: always take the general powers

    bool operator==(const PairForce &) const = default;

    /** Of the triangular solid of the report. */
    static PairForce triangle();

    /** Of the rectangular solid of the report. */
    static PairForce rectangle();

    /** @throws cases::InputError for parameters that bind no pair. */
    void validate() const;

    /** What is taken from the force: its value at the cutoff if it is shifted, else 0. */
    double shift() const;

    /** f(r), whatever the cutoff. */
    double magnitude(double distance) const;

    /**
     * The potential that the truncated force conserves: U(r) - U(cutoff) up to the
     * cutoff, 0 beyond it, with U' = -f.
     */
    double potential(double distance) const;

    /** Where f = 0: at (H/G)^(1/(alpha - beta)), and farther out if it is shifted. */
    double equilibrium_distance() const;

    /** -f'(r) at the equilibrium distance. */
    double stiffness() const;

    /** U(cutoff) - U(equilibrium distance): the work that breaks a bond. */
    double bond_work() const;

    /**
     * The time step above which leapfrog lets a crystal's fastest vibration grow,
     * 2 / omega: omega^2 = 6 k in the plane, where six neighbours of a particle move
     * against it, and 8 k in a cubic close packing of space.
     */
    double stable_time_step(int dimension) const;
  };
} // namespace meltfront::particles::greenspan

#endif
