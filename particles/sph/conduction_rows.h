#ifndef meltfront_particles_sph_conduction_rows_h
#define meltfront_particles_sph_conduction_rows_h

#include <cases/method.h>
#include <particles/core/particle_operator.h>
#include <particles/sph/discretisation.h>

#include <vector>

namespace meltfront::particles
{
  /** A place on a wall, or a ghost, whose value acts on particles. */
  struct WallPoint
  {
    const cases::Boundary *boundary;
    cases::Position position;
  };

  /** What a particle exchanges with a wall point. */
  struct WallLink
  {
    std::uint32_t row;
    std::uint32_t point;
    /**
     * To a temperature: heat flow per difference of the Kirchhoff variable (m^(d-2)). To
     * a flux: area of the wall that the particle stands for (m^(d-1)).
     */
    double strength;
  };

  /**
   * SPH conduction as rows of a sparse operator (Monaghan et al. 2005, equation 2.7, with
   * the second moment corrected).
   *
   * With the Kirchhoff variable u = k (T - T_m), the heat flow into particle a is
   *
   *   sum_b g_ab (u_b - u_a),  g_ab = -2 V_a V_b F_ab (1/mu_a + 1/mu_b)/2,
   *
   * wherever both particles conduct alike. In the cell layout plane walls mirror the
   * particles, and the mirror images are folded into the rows: across an insulated wall
   * the image of b has u_b, so that its coefficient g' adds to g_ab; across a wall that
   * holds u_B it has 2 u_B - u_b, so that g' leaves g_ab and the row gains
   * 2 g' (u_B - u_a). Row and wall coefficients stay >= 0, so an explicit step obeys the
   * maximum principle whenever step * (sum of the row) <= heat capacity.
   *
   * About an axis x is the distance from it, particles are rings, and g_ab is multiplied
   * with the circumference at the middle of the pair, pi (x_a + x_b), or at the wall for
   * images in a wall about the axis. Among nearest neighbours on a lattice this is exact
   * for quadratics: the sum of g_ab (u_b - u_a) is (2 pi x u_x)_x + 2 pi x u_yy there. On
   * the axis the circumference is zero, and nothing flows through it.
   *
   * Where an inclusion conducts otherwise than the rest, g_ab is multiplied with the
   * harmonic mean 2 k_a k_b/(k_a + k_b) over the rest's k: that of two slabs in contact
   * half way between the particles (Cleary and Monaghan 1999). Images conduct as their
   * particles.
   */
  struct ConductionRows
  {
    explicit ConductionRows(const Discretisation &discretisation, bool moment_correction);

    /** Turn flows into particles into those into a cell of the lattice each: the
     * particles beside round walls hold more or less mass than that. */
    void take_per_cell(std::span<double> flow) const
    {
      for(const WallCell &cell : wall_cells)
        flow[cell.particle] /= cell.share;
    }

    ParticleOperator rows;
    double second_moment = 1; ///< mu on the lattice; 1 where it is not corrected
    /** Per cell, over particles that do not hold a wall's value. */
    double largest_row_sum = 0;
    std::vector<WallCell> wall_cells; ///< see Discretisation
    std::vector<WallPoint> temperature_points;
    std::vector<WallLink> temperature_links;
    std::vector<WallPoint> flux_points;
    std::vector<WallLink> flux_links;
    /** To walls that exchange heat with their surroundings: as to a flux, with the depth
     * of the particle behind the wall by link (m). */
    std::vector<WallPoint> exchange_points;
    std::vector<WallLink> exchange_links;
    std::vector<double> exchange_depths;
    /** Of an inclusion: its coefficients are part of the rows, and cost set-up only. */
    cases::EffectCost inclusion_cost{cases::Effect::inclusion};
  };
} // namespace meltfront::particles

#endif
